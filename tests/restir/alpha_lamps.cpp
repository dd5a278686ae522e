// Lamps with alpha, which rays pass in places: the target has their coverage, and sampling the material does not find
// them.
#include "../cpu/agreement_scenes.h"
#include "chain_cases.h"

namespace diptych::core::tests {
namespace {

struct AlphaLamp {
    const char* name;
    AlphaMode mode;
    bool textured;
};

/// A glossy floor under a lamp so close that material sampling looks for lamps there, and another one farther off.
Scene under_alpha_lamp(const AlphaLamp& kind, float roughness) {
    Scene scene = lamp_overhead(0.3F);
    scene.name = kind.name;
    scene.materials[0] = make_material("floor", {0.9F, 0.8F, 0.7F}, 1, roughness);
    Material lamp = make_emitter("alpha lamp", glm::vec3(5));
    lamp.alpha_mode = kind.mode;
    lamp.base_color.a = kind.textured ? 1 : 0.6F;
    if (kind.textured) {
        lamp.base_color_texture.texture = add_checker_texture(scene, 4, Filter::linear);
    }
    Primitive square = horizontal_square({-0.2F, 0.25F, 0.05F}, 0.15F, false, add_material(scene, lamp));
    square.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    add_object(scene, "alpha lamp", {square});
    return scene;
}

}  // namespace

TEST_CASE("ris and restir are unbiased where a lamp with alpha is within reach of a glossy floor") {
    for (const AlphaLamp& kind : {AlphaLamp{"MASK", AlphaMode::mask, true}, AlphaLamp{"BLEND", AlphaMode::blend, false},
                                  AlphaLamp{"textured BLEND", AlphaMode::blend, true}}) {
        for (const float roughness : {0.3F, 0.6F}) {
            for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
                ChainCase c = chain_case(std::string(kind.name) + (roughness < 0.5F ? ", smooth" : ", rough") + ", " +
                                             name_of(integrator),
                                         under_alpha_lamp(kind, roughness));
                c.settings.integrator = integrator;
                c.settings.resampling.light_candidates = 2;
                std::vector<std::uint32_t> frames = {0};
                if (integrator == Integrator::restir) {
                    frames.push_back(2);
                }
                check_frames(c, frames, 4, {16, 12});
            }
        }
    }
}

}  // namespace diptych::core::tests
