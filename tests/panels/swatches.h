// A sheet of small plates, one a tile of the picture: each shows one thing a material may say, and is judged alone.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "panels_fixture.h"

namespace diptych::core::tests {

struct Swatch {
    std::string name;
    Material material;
    glm::dmat4 placement{1};  // of a plate between (-1/2, -1/2, 0) and (1/2, 1/2, 0), seen from +z
    glm::vec4 tangent{1, 0, 0, 1};
    glm::vec3 lean{0};  // the vertex normals are (0, 0, 1) + lean
    /// Both sets of texture coordinates, corner by corner.
    std::array<glm::vec4, 4> uvs = {{{0, 1, 0, 1}, {1, 1, 1, 1}, {1, 0, 1, 0}, {0, 0, 0, 0}}};
    std::vector<glm::vec4> colors{};
};

using Texels = std::vector<std::array<std::uint8_t, 4>>;

/// Adds a texture of 2 x 2 texels and returns a slot that reads it.
TextureSlot add_texels(Scene& scene, const Texels& texels, Filter filter = Filter::nearest, Wrap wrap_u = Wrap::repeat,
                       Wrap wrap_v = Wrap::repeat);

/// The sheet under a dim sky and a point light at its side. `scene` brings the textures; at most 12 swatches.
Scene swatch_sheet(Scene scene, const std::vector<Swatch>& swatches);

/// Every swatch has the oracle's mean, judged as finely as `detectable`.
void check_swatches(const Scene& sheet, const std::vector<Swatch>& swatches, BrdfModel brdf, double detectable);

}  // namespace diptych::core::tests
