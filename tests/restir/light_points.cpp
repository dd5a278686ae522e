// Points of lights of every kind: how they are named, drawn and seen; and that the rays that passes trace are counted.
#include <map>
#include <random>

#include "../cpu/agreement_scenes.h"
#include "backend/resampling_stages.h"
#include "chain_cases.h"

namespace diptych::core::tests {
namespace {

/// Counts rays. Of this file alone, so that the kernel below is too, and no linker takes another file's copy of it.
struct CountingTracer {
    static constexpr bool records_paths = false;
    const EmbreeScene& scene;
    std::uint64_t& rays;

    EmbreeHit closest(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t alpha_key) const {
        ++rays;
        return scene.closest(origin, direction, alpha_key);
    }
    EmbreeHit emitter(const glm::vec3& origin, const glm::vec3& direction, float t_max) const {
        ++rays;
        return scene.emitter(origin, direction, t_max);
    }
    bool any(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const {
        ++rays;
        return scene.any(origin, direction, t_max, alpha_key);
    }
    bool any_previous(const glm::vec3& origin, const glm::vec3& direction, float t_max, std::uint32_t alpha_key) const {
        ++rays;
        return scene.any_previous(origin, direction, t_max, alpha_key);
    }
};
using CountingKernel = shared::CpuKernel<CountingTracer, ~0U>;

/// A floor under a square lamp, a bulb, a sun and a constant sky.
Scene all_kinds_of_light() {
    Scene scene;
    const int floor = add_material(scene, diffuse_material(0.5F));
    const int lamp = add_material(scene, make_emitter("lamp", glm::vec3(3, 2, 1)));
    add_object(scene, "room",
               {horizontal_square({0, 0, 0}, 2, true, floor), horizontal_square({0.5F, 1, 0}, 0.3F, false, lamp)});
    scene.cameras.push_back(make_camera("eye", {0, 0.8, 1.5}, {0, 0, 0}, 60));
    PunctualLight bulb;
    bulb.light_to_world[3] = {-1, 1.5, 0.5, 1};
    bulb.intensity = glm::vec3(2, 3, 4);
    PunctualLight sun;
    sun.type = PunctualType::directional;
    sun.intensity = glm::vec3(0.5F);
    scene.lights = {bulb, sun};
    scene.environment.kind = EnvironmentKind::constant;
    scene.environment.scale = glm::vec3(0.2F, 0.3F, 0.4F);
    return scene;
}

struct Lights {
    PackedScene packed;
    EmbreeScene embree;
    std::uint64_t rays = 0;
    CountingKernel kernel;

    explicit Lights(const RenderSettings& settings, const Scene& scene = all_kinds_of_light())
        : packed(pack_scene(scene, settings)), embree(packed), kernel{packed, packed.constants, {embree, rays}} {}
};

RenderSettings small_settings(Integrator integrator) {
    RenderSettings settings;
    settings.width = 16;
    settings.height = 12;
    settings.integrator = integrator;
    settings.max_depth = 1;
    return settings;
}

}  // namespace

TEST_CASE("Directions as uv come back, with a turn in 0 to 1 and the upper half from 0 on") {
    Lights lights(small_settings(Integrator::ris));
    std::mt19937 engine(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int k = 0; k < 20000; ++k) {
        const double z = k % 4 == 0 ? 1.0 - 1e-6 * unit(engine) : 2.0 * unit(engine) - 1.0;
        const double phi = 2.0 * M_PI * unit(engine);
        const double sine = std::sqrt(1.0 - z * z);
        const glm::vec3 d(glm::normalize(glm::dvec3(sine * std::cos(phi), sine * std::sin(phi), k % 8 < 4 ? z : -z)));
        const glm::vec2 uv = lights.kernel.direction_uv(d);
        CAPTURE(d.x, d.y, d.z, uv.x, uv.y);
        REQUIRE(glm::length(lights.kernel.uv_direction(uv) - d) < 1e-6F);
        REQUIRE((uv.y >= 0 && uv.y <= 1 && std::abs(uv.x) <= 1.000001F));
        REQUIRE((uv.x < 0) == (d.z < 0));
    }
}

TEST_CASE("A light point is drawn with the density that it is said to have, and seen as its light is") {
    Lights lights(small_settings(Integrator::ris));
    const auto& c = lights.packed.constants;
    REQUIRE(c.emissive_triangle_count == 2);
    REQUIRE(c.punctual_light_count == 2);
    REQUIRE(c.light_count == 5);
    const glm::vec3 moved(lights.packed.origin);  // packed coordinates count from there
    const glm::vec3 reference = glm::vec3(0.1F, 0.2F, -0.3F) - moved;
    double picked = 0;
    for (std::uint32_t id = 0; id < c.light_count; ++id) {
        const glm::vec2 u(0.8F, 0.7F);
        const auto drawn = lights.kernel.sample_light_point(id, u, {0x12345678U, 0x9abcdef0U});
        const auto seen = lights.kernel.see_light_point(drawn.point, reference, shared::MOMENT_CURRENT);
        CAPTURE(id);
        CHECK(drawn.point.light == id);
        CHECK(drawn.pdf == Approx(lights.kernel.pdf_light_point(drawn.point)).epsilon(1e-5));
        if (id < 2) {
            const auto& t = lights.packed.emissive_triangles[id];
            const glm::dvec3 point(t.vertex_0 + 0.2F * t.edge_1 + 0.3F * t.edge_2);  // folded: u + v > 1
            const glm::dvec3 to = point - glm::dvec3(reference);
            const double area2 = glm::length(glm::cross(glm::dvec3(t.edge_1), glm::dvec3(t.edge_2)));
            CHECK(glm::length(glm::dvec3(seen.direction) - glm::normalize(to)) < 1e-6);
            CHECK(static_cast<double>(seen.measure) == Approx(area2 * std::abs(to.y) / std::pow(glm::length(to), 3)).epsilon(1e-5));
            CHECK(glm::length(seen.radiance - glm::vec3(3, 2, 1)) < 1e-5F);
            CHECK(static_cast<double>(drawn.pdf) == Approx(2.0 * static_cast<double>(t.pmf)).epsilon(1e-5));
            CHECK((seen.by_chance && !seen.distant));
            picked += static_cast<double>(t.pmf);
        } else if (id < 4) {
            CHECK(drawn.pdf == lights.packed.punctual_lights[id - 2].pmf);
            CHECK(seen.measure == 1.0F);
            CHECK(!seen.by_chance);
            CHECK(seen.distant == (id == 3));
            const glm::vec3 to = id == 2 ? glm::vec3(-1, 1.5F, 0.5F) - moved - reference : glm::vec3(0, 0, 1);
            CHECK(glm::length(seen.direction - glm::normalize(to)) < 1e-6F);
            const glm::vec3 radiance = id == 2 ? glm::vec3(2, 3, 4) / glm::dot(to, to) : glm::vec3(0.5F);
            CHECK(glm::length(seen.radiance - radiance) < 1e-5F);
            picked += static_cast<double>(drawn.pdf);
        } else {  // the sky, uniform over the sphere: 4 pi sr are 2 of uv
            CHECK(static_cast<double>(drawn.pdf) == Approx(0.5 * static_cast<double>(c.environment.pmf)).epsilon(1e-5));
            CHECK(static_cast<double>(seen.measure) == Approx(2.0 * M_PI));
            CHECK(glm::length(seen.radiance - glm::vec3(0.2F, 0.3F, 0.4F)) < 1e-6F);
            CHECK((seen.by_chance && seen.distant));
            picked += static_cast<double>(c.environment.pmf);
        }
    }
    CHECK(picked == Approx(1.0).epsilon(1e-5));
    shared::LightPoint none = shared::no_light_point();
    CHECK(lights.kernel.see_light_point(none, reference, shared::MOMENT_CURRENT).measure == 0.0F);
}

TEST_CASE("A light point of the moment before is where its light was, and as bright as that was") {
    Lights lights(small_settings(Integrator::restir));
    lights.packed.features |= shared::FEATURE_MOTION;
    lights.packed.previous_emissive_triangles = lights.packed.emissive_triangles;
    lights.packed.previous_punctual_lights = lights.packed.punctual_lights;
    for (shared::EmissiveTriangle& light : lights.packed.previous_emissive_triangles) {
        light.vertex_0 += glm::vec3(0.5F, 0.1F, -0.2F);
        light.radiance *= 7.0F;
    }
    for (shared::PunctualLight& light : lights.packed.previous_punctual_lights) {
        light.intensity *= 5.0F;
    }
    const glm::vec3 reference = glm::vec3(0.1F, 0.2F, -0.3F) - glm::vec3(lights.packed.origin);
    for (std::uint32_t id = 0; id < 4; ++id) {
        const shared::LightPoint point = lights.kernel.sample_light_point(id, {0.2F, 0.3F}, {1U, 2U}).point;
        const auto now = lights.kernel.see_light_point(point, reference, shared::MOMENT_CURRENT);
        const auto before = lights.kernel.see_light_point(point, reference, shared::MOMENT_PREVIOUS);
        CAPTURE(id);
        CHECK(glm::length(before.radiance - (id < 2 ? 7.0F : 5.0F) * now.radiance) < 1e-5F * before.radiance.x);
        if (id < 2) {
            const auto& light = lights.packed.previous_emissive_triangles[id];
            const glm::vec3 to = light.vertex_0 + point.uv.x * light.edge_1 + point.uv.y * light.edge_2 - reference;
            CHECK(glm::length(before.direction - glm::normalize(to)) < 1e-6F);
        }
    }
}

TEST_CASE("Rays pass an emitter in places if its material is MASK or BLEND, and sampling the material does not find it there") {
    Scene scene = all_kinds_of_light();
    const int texture = add_checker_texture(scene, 4, Filter::linear);
    for (const AlphaMode mode : {AlphaMode::opaque, AlphaMode::mask, AlphaMode::blend}) {
        Material lamp = make_emitter("lamp", glm::vec3(1));
        lamp.emission_texture.texture = texture;
        lamp.base_color_texture.texture = texture;
        lamp.alpha_mode = mode;
        Primitive square = horizontal_square({0, 1.2F, 0}, 0.2F, false, add_material(scene, lamp));
        square.uvs[0] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
        add_object(scene, "lamp", {square});
    }
    Lights lights(small_settings(Integrator::ris), scene);
    std::map<int, int> triangles;
    for (const shared::EmissiveTriangle& light : lights.packed.emissive_triangles) {
        const shared::uint flags = lights.packed.materials[lights.packed.geometries[light.geometry].material].flags;
        const bool passable = (flags & (shared::MATERIAL_ALPHA_MASK | shared::MATERIAL_ALPHA_BLEND)) != 0;
        ++triangles[static_cast<int>(flags & (shared::MATERIAL_ALPHA_MASK | shared::MATERIAL_ALPHA_BLEND))];
        CHECK(lights.kernel.may_be_passed(light) == passable);
        const glm::vec3 below = light.vertex_0 + 0.3F * (light.edge_1 + light.edge_2) + light.front;
        CHECK(lights.kernel.see_emitter(light, {0.3F, 0.3F}, below).by_chance != passable);
    }
    CHECK(triangles.size() == 3);
    CHECK(triangles[0] == 4);  // of the room's plain lamp and the opaque one with a texture
}

TEST_CASE("What takes no light from a reservoir is unlit, a mirror or nothing at all") {
    Scene scene = all_kinds_of_light();
    Material unlit = diffuse_material(0.5F);
    unlit.unlit = true;
    const int kinds[] = {add_material(scene, unlit), add_material(scene, make_material("mirror", glm::vec3(1), 1, 0)),
                         add_material(scene, make_material("rough", glm::vec3(1), 1, 0.4F))};
    const bool takes[] = {false, false, true, true, false};  // then the floor, and the sky
    for (int k = 0; k < 3; ++k) {
        add_object(scene, "patch", {horizontal_square({k, 5, 0}, 0.2F, true, kinds[k])});
    }
    for (int k = 0; k < 5; ++k) {
        const glm::dvec3 target = k < 3 ? glm::dvec3(k, 5, 0) : k == 3 ? glm::dvec3(-1, 0, 0) : glm::dvec3(0, 20, -3);
        scene.cameras = {point_camera({-1, 8, 4}, target)};
        RenderSettings settings = small_settings(Integrator::ris);
        Lights lights(settings, scene);
        ResamplingFilms films(lights.packed.constants);
        lights.kernel.films = &films;
        ResamplingSchedule schedule(lights.packed.constants);
        const shared::ResamplingPass pass = schedule.next_frame(0).front().pass;
        lights.kernel.find_first_vertex({3, 4}, pass);
        const auto hit = lights.kernel.load_first_vertex(4 * 16 + 3).hit;
        CAPTURE(k, hit.instance);
        CHECK((hit.instance == shared::NONE) == (k == 4));
        CHECK(lights.kernel.load_first_surface({3, 4}, pass, hit).takes_light == takes[k]);
    }
}

TEST_CASE("A lamp and a sky are seen in a mirror as bright as they are, where first vertices take light from reservoirs too") {
    for (const bool lamp : {true, false}) {
        Scene scene;
        std::vector<Primitive> parts{horizontal_square({0, 0, 0}, 1, true, add_material(scene, make_material("mirror", glm::vec3(1), 1, 0)))};
        if (lamp) {
            parts.push_back(horizontal_square({0, 1, -1}, 0.3F, false, add_material(scene, make_emitter("lamp", {3, 2, 1}))));
        } else {
            scene.environment.kind = EnvironmentKind::constant;
            scene.environment.scale = glm::vec3(3, 2, 1);
        }
        add_object(scene, "room", parts);
        scene.cameras.push_back(point_camera({0, 1, 1}, {0, 0, 0}));
        for (const Integrator integrator : {Integrator::path, Integrator::ris, Integrator::restir}) {
            const ImageMean m = image_mean(render_cpu(scene, statistical_settings(4, 4, integrator, 1), 2));
            INFO(name_of(integrator) << (lamp ? ", a lamp: " : ", a sky: ") << describe(m));
            for (std::size_t c = 0; c < 3; ++c) {
                CHECK(m.mean[c] == Approx(3.0 - static_cast<double>(c)).epsilon(1e-5));
            }
        }
    }
}

TEST_CASE("Every ray that ris and restir trace is counted at its pixel, once") {
    // On the glossy plates of veach-mis materials look for lamps, and picked points ask whether an emitter is before them.
    const Scene scene = GENERATE(0, 1) == 0 ? all_kinds_of_light() : generated("veach-mis");
    CAPTURE(scene.name);
    for (const Integrator integrator : {Integrator::ris, Integrator::restir}) {
        for (const auto visibility : {ResamplingVisibility::shading, ResamplingVisibility::target, ResamplingVisibility::biased_initial}) {
            RenderSettings settings = small_settings(integrator);
            settings.max_depth = 3;
            settings.resampling.visibility = visibility;
            Lights lights(settings, scene);
            ResamplingFilms films(lights.packed.constants);
            lights.kernel.films = &films;
            ResamplingSchedule schedule(lights.packed.constants);
            std::uint64_t counted = 0;
            for (std::uint32_t frame = 0; frame < 3; ++frame) {
                for (const ResamplingStep& step : schedule.next_frame(frame)) {
                    for (std::uint32_t i = 0; i < films.pixels; ++i) {
                        const shared::uvec2 pixel(i % settings.width, i / settings.width);
                        run_stage(lights.kernel, step, pixel);
                        if (step.stage == ResamplingStage::shade) {
                            counted += lights.kernel.shade_resampled(pixel, step.pass).rays;
                        }
                    }
                }
            }
            CAPTURE(static_cast<int>(integrator), static_cast<int>(visibility));
            CHECK(counted > 3 * films.pixels);
            CHECK(counted == lights.rays);
        }
    }
}

}  // namespace diptych::core::tests
