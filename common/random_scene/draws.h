// Random choices that are the same on every machine. One draw a statement or a braced list, so that their order is fixed.
#pragma once

#include <array>
#include <cmath>
#include <glm/glm.hpp>

#include "generate/random.h"

namespace diptych::core {

enum class Topic : std::uint64_t { meshes = 1, materials, textures, lights, camera, settings, motion };

class Draws {
public:
    /// Object `index` of a topic draws from numbers of its own.
    Draws(std::uint64_t seed, Topic topic, std::uint64_t index = 0) {
        for (const std::uint64_t part : {seed, std::uint64_t(topic), index}) {
            random_.state = random_.next() ^ part;
        }
    }

    double between(double low, double high) { return random_.between(low, high); }
    int below(int count) { return int(random_.below(std::uint64_t(count))); }
    bool chance(double probability) { return random_.uniform() < probability; }
    double sign() { return chance(0.5) ? -1 : 1; }

    template <typename T, std::size_t N>
    T pick(const T (&values)[N]) {
        return values[std::size_t(below(int(N)))];
    }

    /// Each component by itself.
    glm::dvec3 within(double low, double high) {
        return {between(low, high), between(low, high), between(low, high)};
    }

    glm::dvec3 direction() {
        for (;;) {
            const glm::dvec3 v = within(-1, 1);
            const double size = glm::dot(v, v);
            if (size > 0.01 && size <= 1) {
                return v / std::sqrt(size);
            }
        }
    }

    /// Columns are orthonormal, right-handed.
    glm::dmat3 rotation() {
        const glm::dvec3 x = direction();
        glm::dvec3 other = direction();
        while (std::abs(glm::dot(x, other)) > 0.99) {
            other = direction();
        }
        const glm::dvec3 y = glm::normalize(glm::cross(other, x));
        return {x, y, glm::cross(x, y)};
    }

private:
    GeneratorRandom random_;
};

}  // namespace diptych::core
