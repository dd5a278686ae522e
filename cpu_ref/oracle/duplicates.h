// Which triangles lie exactly on one before them, and so are not there.
#pragma once

#include <array>
#include <cstddef>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "scene/scene.h"

namespace diptych::core::oracle {

/// Asked of every triangle in the file's order: instances, primitives, triangles.
class Duplicates {
public:
    explicit Duplicates(const Scene& scene);

    /// Whether an opaque triangle with the same vertices in the same cyclic order was there before, under the same
    /// transform: in the same instance, or where both stand still.
    bool met_before(std::size_t instance, const Primitive& primitive, const glm::uvec3& triangle);

private:
    struct Hash {
        std::size_t operator()(const std::array<double, 9>& numbers) const;
    };
    using Met = std::unordered_set<std::array<double, 9>, Hash>;

    const Scene& scene_;
    std::vector<std::size_t> places_;            // for each instance the first one that stands where it does
    std::unordered_map<std::size_t, Met> met_;  // by place
};

}  // namespace diptych::core::oracle
