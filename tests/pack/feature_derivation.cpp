// Each feature is switched on by exactly what needs it, and buffers behind the others stay empty.
#include <functional>
#include <utility>

#include "pack_fixture.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

#define USE_FEATURE(name, constant, bit) using shared::constant;
FEATURE_LIST(USE_FEATURE)
#undef USE_FEATURE

Primitive& square(Scene& scene) {
    return scene.meshes[0].primitives[0];
}
Material& material(Scene& scene) {
    return scene.materials[0];
}

struct Case {
    const char* name;
    std::function<void(Scene&, RenderSettings&)> change;
    std::uint32_t added;
    std::uint32_t removed = 0;
};

const std::vector<Case>& cases() {
    static const std::vector<Case> all = {
        {"nothing", [](Scene&, RenderSettings&) {}, 0},
        {"texture", [](Scene& s, RenderSettings&) { material(s).base_color_texture.texture = add_texture(s); },
         FEATURE_TEXTURES},
        {"roughness texture",
         [](Scene& s, RenderSettings&) { material(s).metallic_roughness_texture.texture = add_texture(s); },
         FEATURE_TEXTURES | FEATURE_MIRRORS},
        {"normal map", [](Scene& s, RenderSettings&) { material(s).normal_texture.texture = add_texture(s); },
         FEATURE_TEXTURES | FEATURE_NORMAL_MAPS},
        {"microfacet normal map",
         [](Scene& s, RenderSettings& r) {
             material(s).normal_texture.texture = add_texture(s);
             r.normal_maps = NormalMaps::microfacet;
         },
         FEATURE_TEXTURES | FEATURE_NORMAL_MAPS | FEATURE_MICROFACET_NORMAL_MAPS},
        {"microfacet normal maps without a map",
         [](Scene&, RenderSettings& r) { r.normal_maps = NormalMaps::microfacet; }, 0},
        {"second set",
         [](Scene& s, RenderSettings&) {
             material(s).specular_texture.texture = add_texture(s);
             material(s).specular_texture.uv_set = 1;
         },
         FEATURE_TEXTURES | FEATURE_SECOND_UV},
        {"mask", [](Scene& s, RenderSettings&) { material(s).alpha_mode = AlphaMode::mask; }, FEATURE_ALPHA},
        {"blend", [](Scene& s, RenderSettings&) { material(s).alpha_mode = AlphaMode::blend; }, FEATURE_ALPHA},
        {"vertex colours", [](Scene& s, RenderSettings&) { square(s).colors.assign(4, glm::vec4(1)); },
         FEATURE_VERTEX_COLORS},
        {"emission",
         [](Scene& s, RenderSettings&) {
             material(s).emission = {0, 0, 1};
         },
         FEATURE_EMISSIVE},
        {"emission, light sampling",
         [](Scene& s, RenderSettings& r) {
             material(s).emission = {0, 0, 1};
             r.integrator = Integrator::path;
         },
         FEATURE_EMISSIVE | FEATURE_LIGHT_SAMPLING},
        {"textured emission",
         [](Scene& s, RenderSettings&) {
             material(s).emission = {0, 0, 1};
             material(s).emission_texture.texture = add_texture(s);
         },
         FEATURE_EMISSIVE | FEATURE_EMISSIVE_TEXTURES | FEATURE_TEXTURES},
        {"emission cut out",
         [](Scene& s, RenderSettings&) {
             material(s).emission = {0, 0, 1};
             material(s).alpha_mode = AlphaMode::mask;
         },
         FEATURE_EMISSIVE | FEATURE_EMISSIVE_TEXTURES | FEATURE_ALPHA},
        {"emission texture without emission",
         [](Scene& s, RenderSettings&) { material(s).emission_texture.texture = add_texture(s); }, FEATURE_TEXTURES},
        {"unlit", [](Scene& s, RenderSettings&) { material(s).unlit = true; }, FEATURE_EMISSIVE, FEATURE_GGX},
        {"unlit with vertex colours",
         [](Scene& s, RenderSettings&) {
             material(s).unlit = true;
             square(s).colors.assign(4, glm::vec4(1));
         },
         FEATURE_EMISSIVE | FEATURE_EMISSIVE_TEXTURES | FEATURE_VERTEX_COLORS, FEATURE_GGX},
        {"black unlit",
         [](Scene& s, RenderSettings&) {
             material(s).unlit = true;
             material(s).base_color = {0, 0, 0, 1};
         },
         0, FEATURE_GGX},
        {"lamp", [](Scene& s, RenderSettings&) { s.lights.emplace_back(); }, FEATURE_PUNCTUAL | FEATURE_LIGHT_SAMPLING},
        {"sky", [](Scene& s, RenderSettings&) { s.environment.kind = Environment::Kind::constant; },
         FEATURE_CONSTANT_ENVIRONMENT},
        {"sky, direct",
         [](Scene& s, RenderSettings& r) {
             s.environment.kind = Environment::Kind::constant;
             r.integrator = Integrator::direct;
         },
         FEATURE_CONSTANT_ENVIRONMENT | FEATURE_LIGHT_SAMPLING},
        {"map",
         [](Scene& s, RenderSettings&) {
             s.environment.kind = Environment::Kind::map;
             s.environment.width = 2;
             s.environment.height = 1;
             s.environment.texels.assign(2, glm::vec3(1));
         },
         FEATURE_ENVIRONMENT_MAP},
        {"blinn-phong", [](Scene&, RenderSettings& r) { r.brdf = BrdfModel::blinn_phong; }, FEATURE_BLINN_PHONG,
         FEATURE_GGX},
        {"mirror", [](Scene& s, RenderSettings&) { material(s).roughness = 0; }, FEATURE_MIRRORS},
        {"diffuse throughout",
         [](Scene& s, RenderSettings&) {
             material(s).metallic = 0;
             material(s).specular = 0;
             material(s).roughness = 0;
         },
         0, FEATURE_GGX},
        {"specular alone",
         [](Scene& s, RenderSettings&) {
             material(s).metallic = 0;
             material(s).specular = 0.1F;
         },
         0},
        {"metal alone",
         [](Scene& s, RenderSettings&) {
             material(s).metallic = 0.1F;
             material(s).specular = 0;
         },
         0},
        {"all but a mirror", [](Scene& s, RenderSettings&) { material(s).roughness = 0.011F; }, 0},
        {"lens", [](Scene& s, RenderSettings&) { s.cameras[0].lens.radius = 0.1; }, FEATURE_THIN_LENS},
        {"orthographic", [](Scene& s, RenderSettings&) { s.cameras[0].orthographic = true; }, FEATURE_ORTHOGRAPHIC},
        {"another camera's lens",
         [](Scene& s, RenderSettings&) {
             s.cameras.push_back(s.cameras[0]);
             s.cameras[1].lens.radius = 0.1;
         },
         0},
        {"errors", [](Scene&, RenderSettings& r) { r.standard_error = true; }, FEATURE_STANDARD_ERROR},
        {"layers", [](Scene&, RenderSettings& r) { r.first_hit_layers = true; }, FEATURE_FIRST_HIT_LAYERS},
        {"ris", [](Scene&, RenderSettings& r) { r.integrator = Integrator::ris; }, FEATURE_RESAMPLING},
        {"restir", [](Scene&, RenderSettings& r) { r.integrator = Integrator::restir; }, FEATURE_RESAMPLING},
        {"restir that looks back",
         [](Scene&, RenderSettings& r) {
             r.integrator = Integrator::restir;
             r.moves = true;
         },
         FEATURE_RESAMPLING | FEATURE_MOTION},
        {"restir with visibility in its target",
         [](Scene&, RenderSettings& r) {
             r.integrator = Integrator::restir;
             r.resampling.visibility = ResamplingVisibility::target;
         },
         FEATURE_RESAMPLING | FEATURE_TARGET_VISIBILITY},
        {"path that moves", [](Scene&, RenderSettings& r) { r.moves = true; }, 0},
        {"no light to sample", [](Scene&, RenderSettings& r) { r.integrator = Integrator::path; }, 0},
        {"one bounce, found by chance", [](Scene&, RenderSettings& r) { r.max_depth = 1; }, 0},
        {"no bounce", [](Scene&, RenderSettings& r) { r.max_depth = 0; }, 0, FEATURE_LATER_VERTICES},
        {"direct light alone",
         [](Scene&, RenderSettings& r) {
             r.integrator = Integrator::direct;
             r.max_depth = 1;
         },
         0, FEATURE_LATER_VERTICES},
        {"direct light alone, in mirrors too",
         [](Scene& s, RenderSettings& r) {
             material(s).roughness = 0;
             r.integrator = Integrator::direct;
             r.max_depth = 1;
         },
         FEATURE_MIRRORS},
        {"two bounces of direct light",
         [](Scene&, RenderSettings& r) {
             r.integrator = Integrator::direct;
             r.max_depth = 2;
         },
         0},
        {"ris alone",
         [](Scene&, RenderSettings& r) {
             r.integrator = Integrator::ris;
             r.max_depth = 1;
         },
         FEATURE_RESAMPLING, FEATURE_LATER_VERTICES},
        {"emission that no instance has",
         [](Scene& s, RenderSettings&) {
             Material lamp = make_emitter("lamp", glm::vec3(1));
             Primitive p = square(s);
             p.material = add_material(s, lamp);
             add_mesh(s, "unused", {p});
         },
         0},
    };
    return all;
}

}  // namespace

TEST_CASE("Each feature is on where something needs it, and only there") {
    std::uint32_t seen = 0;
    for (const Case& c : cases()) {
        Scene scene = least_scene();
        RenderSettings settings = brdf_settings();
        c.change(scene, settings);
        const std::uint32_t bits = needed_features(scene, settings);
        INFO(c.name);
        CHECK(feature_names(bits) == feature_names(((FEATURE_GGX | FEATURE_LATER_VERTICES) & ~c.removed) | c.added));
        CHECK(pack_scene(scene, settings).features == bits);
        seen |= bits;
        settings.generic = true;
        CHECK(needed_features(scene, settings) == ~0U);
    }
    // Every feature there is has had its scene.
    // The light tree is known when the lights are packed (light_tree.cpp).
    CHECK(feature_names(seen | FEATURE_LIGHT_TREE) == feature_names(~0U));
}

TEST_CASE("Features of what no instance shows stay off") {
    Scene scene = least_scene();
    material(scene).emission = {1, 1, 1};
    material(scene).alpha_mode = AlphaMode::blend;
    scene.instances.clear();
    CHECK(needed_features(scene, brdf_settings()) == FEATURE_LATER_VERTICES);
    scene = least_scene();
    square(scene).triangles.clear();
    material(scene).alpha_mode = AlphaMode::blend;
    CHECK(needed_features(scene, brdf_settings()) == FEATURE_LATER_VERTICES);
}

TEST_CASE("What samples no light packs no light") {
    Scene scene = least_scene();
    material(scene).emission = {1, 1, 1};
    scene.environment.kind = Environment::Kind::map;
    scene.environment.width = 2;
    scene.environment.height = 1;
    scene.environment.texels.assign(2, glm::vec3(1));
    const PackedScene brdf = pack_scene(scene, brdf_settings());
    CHECK(brdf.light_table.empty());
    CHECK(brdf.emissive_triangles.empty());
    CHECK(brdf.emitter_slots.empty());
    CHECK(brdf.environment_table.empty());
    CHECK(brdf.constants.light_count == 0);
    RenderSettings settings = brdf_settings();
    settings.integrator = Integrator::path;
    const PackedScene path = pack_scene(scene, settings);
    CHECK(path.light_table.size() == 3);
    CHECK(path.emissive_triangles.size() == 2);
    CHECK(path.environment_table.size() == 2);
    CHECK(path.emitter_slots.size() == 1);
    CHECK(path.instances[0].first_emitter_slot == 0);
    CHECK(brdf.instances[0].first_emitter_slot == shared::NONE);
}

TEST_CASE("Without textures there are no coordinates, texels, slots or tangents") {
    Scene scene = least_scene();
    square(scene).uvs[0].assign(4, glm::vec2(0));
    square(scene).uvs[1].assign(4, glm::vec2(1));
    square(scene).tangents.assign(4, glm::vec4(1, 0, 0, 1));
    const PackedScene bare = pack_scene(scene, brdf_settings());
    CHECK(bare.uvs.empty());
    CHECK(bare.texels.empty());
    CHECK(bare.texture_slots.empty());
    CHECK(bare.srgb_table.empty());
    CHECK(bare.tangents.empty());
    CHECK(bare.normals.empty());
    CHECK(bare.colors.empty());
    CHECK(bare.geometries[0].first_uv_0 == shared::NONE);

    const int texture = add_texture(scene);
    material(scene).base_color_texture.texture = texture;
    const PackedScene textured = pack_scene(scene, brdf_settings());
    CHECK(textured.uvs.size() == 4);
    CHECK(textured.texels.size() == 4);
    CHECK(textured.texels[0] == 0x80808080U);
    CHECK(textured.srgb_table.size() == 256);
    CHECK(textured.geometries[0].first_uv_1 == shared::NONE);
    material(scene).normal_texture.texture = texture;
    material(scene).normal_texture.uv_set = 1;
    const PackedScene mapped = pack_scene(scene, brdf_settings());
    CHECK(mapped.uvs.size() == 8);
    CHECK(mapped.tangents.size() == 4);
    CHECK(mapped.texels.size() == 4);  // one image, however many slots read it
    CHECK(mapped.texture_slots.size() == 2);
    CHECK((mapped.texture_slots[0].flags & shared::TEXTURE_SRGB) != 0);
    CHECK((mapped.texture_slots[1].flags & shared::TEXTURE_SRGB) == 0);
    CHECK((mapped.texture_slots[1].flags & shared::TEXTURE_UV_1) != 0);
}
