#include "oracle/emitters.h"

#include <algorithm>
#include <cmath>

#include "oracle/random.h"
#include "oracle/surface.h"

namespace diptych::core::oracle {

namespace {

double brightness(const Material& material, EmitterChoice choice) {
    if (!emits(material)) {
        return 0;
    }
    const dvec3 light = material.unlit ? dvec3(material.base_color) : dvec3(material.emission);
    return choice == EmitterChoice::area ? 1 : light.x + light.y + light.z;
}

}  // namespace

Emitters::Emitters(const World& world, EmitterChoice choice) {
    double sum = 0;
    for (std::size_t i = 0; i < world.triangles.size(); ++i) {
        brightness_.push_back(brightness(*world.triangles[i].material, choice));
        if (brightness_.back() > 0) {
            triangles_.push_back(i);
            weight_up_to_.push_back(sum += brightness_.back() * area(world.triangles[i]));
        }
    }
}

Emitters::Point Emitters::sample(Random& random) const {
    const double place = random.uniform() * total();
    const auto found = std::upper_bound(weight_up_to_.begin(), weight_up_to_.end(), place);
    const auto index = std::min<std::size_t>(std::size_t(found - weight_up_to_.begin()), triangles_.size() - 1);
    const double root = std::sqrt(random.uniform());
    const double share = random.uniform();
    return {triangles_[index], dvec2(root * (1 - share), root * share), density(triangles_[index])};
}

}  // namespace diptych::core::oracle
