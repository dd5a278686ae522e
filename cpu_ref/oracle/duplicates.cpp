#include "oracle/duplicates.h"

#include <functional>
#include <map>

namespace diptych::core::oracle {

Duplicates::Duplicates(const Scene& scene) : scene_(scene) {
    std::map<std::array<double, 16>, std::size_t> standing;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        const Instance& instance = scene.instances[i];
        std::size_t first = i;
        if (instance.node == none) {
            std::array<double, 16> numbers;
            for (std::size_t k = 0; k < 16; ++k) {
                numbers[k] = instance.object_to_world[int(k / 4)][int(k % 4)];
            }
            first = standing.try_emplace(numbers, i).first->second;
        }
        places_.push_back(first);
    }
}

bool Duplicates::met_before(std::size_t instance, const Primitive& primitive, const glm::uvec3& triangle) {
    if (scene_.materials[std::size_t(primitive.material)].alpha_mode != AlphaMode::opaque) {
        return false;
    }
    // The rotation that comes first in order stands for all three. Equal numbers have equal hashes, -0 and 0 too.
    std::array<double, 9> least;
    for (int turn = 0; turn < 3; ++turn) {
        std::array<double, 9> turned;
        for (int k = 0; k < 9; ++k) {
            turned[std::size_t(k)] = double(primitive.positions[triangle[(turn + k / 3) % 3]][k % 3]);
        }
        least = turn == 0 || turned < least ? turned : least;
    }
    return !met_[places_[instance]].insert(least).second;
}

std::size_t Duplicates::Hash::operator()(const std::array<double, 9>& numbers) const {
    std::size_t mixed = 0;
    for (const double number : numbers) {
        mixed = mixed * 0x100000001b3U + std::hash<double>()(number);
    }
    return mixed;
}

}  // namespace diptych::core::oracle
