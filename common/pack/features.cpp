#include "pack/features.h"

#include <utility>

#include "bsdf/bsdf.h"
#include "language/scene_features.h"

namespace diptych::core {
namespace {

/// Whether a microfacet lobe has any weight; textures only scale these factors.
bool reflects_specularly(const Material& m) {
    return !m.unlit && (m.specular > 0 || m.metallic > 0);
}

std::uint32_t material_features(const Material& m, const RenderSettings& settings) {
    std::uint32_t bits = 0;
    for (const auto slot : texture_slots) {
        if ((m.*slot).texture != none) {
            bits |= shared::FEATURE_TEXTURES;
            bits |= (m.*slot).uv_set == 1 ? shared::FEATURE_SECOND_UV : 0U;
        }
    }
    if (m.normal_texture.texture != none) {
        bits |= shared::FEATURE_NORMAL_MAPS;
        bits |= settings.normal_maps == NormalMaps::microfacet ? shared::FEATURE_MICROFACET_NORMAL_MAPS : 0U;
    }
    bits |= m.alpha_mode != AlphaMode::opaque ? shared::FEATURE_ALPHA : 0U;
    if (emits(m)) {
        bits |= shared::FEATURE_EMISSIVE;
        const TextureSlot& emission = m.unlit ? m.base_color_texture : m.emission_texture;
        const bool varies = emission.texture != none || m.alpha_mode != AlphaMode::opaque;
        bits |= varies ? shared::FEATURE_EMISSIVE_TEXTURES : 0U;
    }
    // A texture can bring any roughness down to that of a mirror.
    const bool can_be_mirror =
        m.metallic_roughness_texture.texture != none || m.roughness * m.roughness < shared::ALPHA_MIRROR;
    if (reflects_specularly(m)) {
        bits |= settings.brdf == BrdfModel::ggx ? shared::FEATURE_GGX : shared::FEATURE_BLINN_PHONG;
        bits |= can_be_mirror ? shared::FEATURE_MIRRORS : 0U;
    }
    return bits;
}

std::uint32_t light_features(const Scene& scene) {
    std::uint32_t bits = scene.lights.empty() ? 0U : shared::FEATURE_PUNCTUAL;
    if (scene.environment.kind == Environment::Kind::constant) {
        bits |= shared::FEATURE_CONSTANT_ENVIRONMENT;
    } else if (scene.environment.kind == Environment::Kind::map) {
        bits |= shared::FEATURE_ENVIRONMENT_MAP;
    }
    return bits;
}

}  // namespace

bool emits(const Material& material) {
    const glm::vec3 radiance = material.unlit ? glm::vec3(material.base_color) : material.emission;
    const bool moves = material.moving_emission && !material.unlit;
    return moves || radiance.x > 0 || radiance.y > 0 || radiance.z > 0;
}

std::uint32_t needed_features(const Scene& scene, const RenderSettings& settings) {
    if (settings.generic) {
        return ~0U;
    }
    std::uint32_t bits = light_features(scene);
    std::vector<bool> used(scene.meshes.size(), false);
    for (const Instance& instance : scene.instances) {
        used[static_cast<std::size_t>(instance.mesh)] = true;
    }
    for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
        for (const Primitive& primitive : scene.meshes[i].primitives) {
            if (used[i] && !primitive.triangles.empty()) {
                const Material& material = scene.materials[static_cast<std::size_t>(primitive.material)];
                bits |= material_features(material, settings);
                bits |= primitive.colors.empty() ? 0U : shared::FEATURE_VERTEX_COLORS;
                // The radiance of an unlit material also varies with the vertex colours.
                const bool colored_light = emits(material) && material.unlit && !primitive.colors.empty();
                bits |= colored_light ? shared::FEATURE_EMISSIVE_TEXTURES : 0U;
            }
        }
    }
    if (!scene.cameras.empty()) {
        const Camera& camera = scene.cameras[static_cast<std::size_t>(settings.camera)];
        bits |= camera.orthographic ? shared::FEATURE_ORTHOGRAPHIC : 0U;
        bits |= camera.lens.radius > 0 ? shared::FEATURE_THIN_LENS : 0U;
    }
    bits |= settings.standard_error ? shared::FEATURE_STANDARD_ERROR : 0U;
    bits |= settings.first_hit_layers ? shared::FEATURE_FIRST_HIT_LAYERS : 0U;
    const bool has_light = (bits & (shared::FEATURE_EMISSIVE | shared::FEATURE_CONSTANT_ENVIRONMENT |
                                    shared::FEATURE_ENVIRONMENT_MAP | shared::FEATURE_PUNCTUAL)) != 0;
    const bool has_light_to_sample =
        samples_lights(settings.integrator) ? has_light : (bits & shared::FEATURE_PUNCTUAL) != 0;
    bits |= resamples(settings.integrator) ? shared::FEATURE_RESAMPLING : 0U;
    bits |= reuses(settings.integrator) && settings.resampling.visibility == ResamplingVisibility::target
                ? shared::FEATURE_TARGET_VISIBILITY
                : 0U;
    bits |= reuses(settings.integrator) && settings.moves ? shared::FEATURE_MOTION : 0U;
    bits |= has_light_to_sample ? shared::FEATURE_LIGHT_SAMPLING : 0U;
    // Of direct light alone, only what a mirror shows is found by a ray from the first vertex.
    const bool finds_by_chance = (samples_material(settings.integrator) && !resamples(settings.integrator)) ||
                                 (bits & shared::FEATURE_MIRRORS) != 0;
    bits |= settings.max_depth > (finds_by_chance ? 0 : 1) ? shared::FEATURE_LATER_VERTICES : 0U;
    return bits;
}

std::vector<std::string> feature_names(std::uint32_t features) {
    std::vector<std::string> names;
#define ADD_NAME(name, constant, bit)                                                                                  \
    if ((features & shared::constant) != 0) {                                                                          \
        names.emplace_back(name);                                                                                      \
    }
    FEATURE_LIST(ADD_NAME)
#undef ADD_NAME
    return names;
}

}  // namespace diptych::core
