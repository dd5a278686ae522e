// What random scenes are made of, and that a seed is all that they depend on.
#include <fstream>
#include <map>
#include <sstream>

#include "random_fixture.h"
#include "random_scene/scene_files.h"
#include "random_scene/shrink.h"

using namespace diptych::core;
using namespace diptych::core::tests;

namespace {

std::string bytes_of(const std::filesystem::path& path) {
    std::ostringstream text;
    text << std::ifstream(path, std::ios::binary).rdbuf();
    return text.str();
}

void count_material(const Material& m, std::map<std::string, int>& counts) {
    const std::pair<const char*, const TextureSlot*> slots[] = {{"base color", &m.base_color_texture},
                                                                {"metallic-roughness", &m.metallic_roughness_texture},
                                                                {"normal", &m.normal_texture},
                                                                {"emission", &m.emission_texture},
                                                                {"specular", &m.specular_texture},
                                                                {"specular color", &m.specular_color_texture}};
    for (const auto& [name, slot] : slots) {
        counts[std::string(name) + " texture"] += slot->texture != none;
        counts["texture transform"] += slot->u_row != glm::vec3(1, 0, 0);
        counts["UV set 1"] += slot->texture != none && slot->uv_set == 1;
    }
    const bool emits = m.emission != glm::vec3(0);
    counts["mask"] += m.alpha_mode == AlphaMode::mask;
    counts["blend"] += m.alpha_mode == AlphaMode::blend;
    counts["lamp under mask"] += emits && m.alpha_mode == AlphaMode::mask;
    counts["lamp under blend"] += emits && m.alpha_mode == AlphaMode::blend;
    counts["textured lamp"] += emits && m.emission_texture.texture != none;
    counts["one-sided lamp"] += emits && !m.double_sided;
    counts["unlit"] += m.unlit;
    counts["mirror"] += m.roughness == 0;
    counts["metal"] += m.metallic == 1;
    counts["ior 0"] += m.ior == 0;
    counts["specular"] += m.specular != 1;
    counts["normal scale"] += m.normal_texture.texture != none && m.normal_scale != 1;
    counts["strong green"] += m.base_color.r == 0 && m.base_color.g == 0.9F;
}

void count_primitive(const Primitive& p, bool mirrored, bool mapped, std::map<std::string, int>& counts) {
    counts["no normals"] += p.normals.empty();
    counts["vertex colours"] += !p.colors.empty();
    counts["no UV set 0"] += p.uvs[0].empty();
    counts["given tangents"] += mapped && !p.tangents.empty();
    counts["derived tangents"] += mapped && p.tangents.empty();
    counts["mapped and mirrored"] += mapped && mirrored;
}

std::map<std::string, int> count_features(std::uint64_t seeds) {
    std::map<std::string, int> counts;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const RandomScene random = make_random_scene(seed);
        const Scene& scene = random.scene;
        for (const Material& material : scene.materials) {
            count_material(material, counts);
        }
        for (const Instance& instance : scene.instances) {
            const bool mirrored = determinant(glm::dmat3(instance.object_to_world)) < 0;
            counts["mirrored instance"] += mirrored;
            for (const Primitive& p : scene.meshes[std::size_t(instance.mesh)].primitives) {
                count_primitive(p, mirrored, scene.materials[std::size_t(p.material)].normal_texture.texture != none, counts);
            }
        }
        counts["mesh with two instances"] += scene.instances.size() > scene.meshes.size();
        counts["nested nodes"] += scene.nodes.size() > scene.instances.size();
        for (const PunctualLight& light : scene.lights) {
            const char* names[] = {"point light", "spot light", "directional light"};
            for (const char* name : names) {
                counts[name] += name == names[int(light.type)];
            }
        }
        const char* skies[] = {"no sky", "constant sky", "sky map"};
        for (const char* name : skies) {
            counts[name] += name == skies[int(scene.environment.kind)];
        }
        const Camera& camera = scene.cameras[std::size_t(random.settings.camera)];
        counts["orthographic camera"] += camera.orthographic;
        counts["thin lens"] += camera.lens.radius > 0;
        counts["Blinn-Phong"] += random.settings.brdf == BrdfModel::blinn_phong;
        counts["microfacet normal maps"] += random.settings.normal_maps == NormalMaps::microfacet;
        counts["generic pipelines"] += random.settings.generic;
        counts["independent samples"] += random.settings.sampler == SamplerKind::independent;
        counts["Sobol' samples"] += random.settings.sampler == SamplerKind::sobol;
        counts["balance heuristic"] += random.settings.mis == MisHeuristic::balance;
        counts["lights picked uniformly"] += random.settings.light_sampler == LightSampler::uniform;
        counts["lights picked by power"] += random.settings.light_sampler == LightSampler::power;
        counts["lights picked by the tree"] += random.settings.light_sampler == LightSampler::spatial;
        counts["pairwise reuse"] += random.settings.resampling.mis == ResamplingMis::pairwise;
        counts["balance reuse"] += random.settings.resampling.mis == ResamplingMis::balance;
        counts["visibility in the target"] += random.settings.resampling.visibility == ResamplingVisibility::target;
        counts["no temporal reuse"] += !random.settings.resampling.temporal;
        counts["no spatial reuse"] += random.settings.resampling.spatial_passes == 0;
        counts["no material candidate"] += !random.settings.resampling.bsdf_candidate;
        counts["depth 1"] += random.settings.max_depth == 1;
        counts["roulette"] += random.settings.max_depth > 3;
    }
    return counts;
}

/// Whether a material that an instance shows reads a specular texture.
bool shows_specular_texture(const RandomScene& random) {
    for (const Instance& instance : random.scene.instances) {
        for (const Primitive& p : random.scene.meshes[std::size_t(instance.mesh)].primitives) {
            if (random.scene.materials[std::size_t(p.material)].specular_texture.texture != none) {
                return true;
            }
        }
    }
    return false;
}

}  // namespace

TEST_CASE("A random scene is a function of its seed") {
    const TestFolder folder;
    const auto written = [&](std::uint64_t seed, const char* name) {
        write_random_scene(make_random_scene(seed), folder.file(name));
        return bytes_of(folder.file(name));
    };
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const std::string first = written(seed, "scene.gltf");
        CHECK(first == written(seed, "scene.gltf"));
        CHECK(first != written(seed + 1, "scene.gltf"));
        CHECK(make_random_scene(seed).settings == make_random_scene(seed).settings);
        CHECK_FALSE(make_random_scene(seed).settings == make_random_scene(seed + 1).settings);
    }
}

TEST_CASE("Random scenes draw from everything") {
    for (const auto& [feature, count] : count_features(300)) {
        INFO(feature << ": " << count);
        CHECK(count >= 8);
    }
}

TEST_CASE("A random scene is read back as it was drawn") {
    const TestFolder folder;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        INFO("seed " << seed);
        const RandomScene random = make_random_scene(seed);
        write_random_scene(random, folder.file("scene.gltf"));
        const Scene scene = read_random_scene(random, folder.file("scene.gltf"));
        REQUIRE(scene.instances.size() == random.scene.instances.size());
        CHECK(scene.materials.size() == random.scene.materials.size());
        CHECK(scene.lights.size() == random.scene.lights.size());
        CHECK(scene.cameras.size() == random.scene.cameras.size());
        CHECK(scene.environment.texels == random.scene.environment.texels);
    }
}

TEST_CASE("An instance is where its chain of nodes brings it, and where a matrix says the same") {
    const TestFolder folder;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        RandomScene random = make_random_scene(seed);
        for (const bool with_nodes : {true, false}) {
            INFO("seed " << seed << ", nodes " << with_nodes);
            if (!with_nodes) {
                drop_nodes(random.scene);
            }
            write_random_scene(random, folder.file("scene.gltf"));
            const Scene scene = read_random_scene(random, folder.file("scene.gltf"));
            REQUIRE(scene.instances.size() == random.scene.instances.size());
            for (const Instance& drawn : random.scene.instances) {
                const std::string& mesh = random.scene.meshes[std::size_t(drawn.mesh)].name;
                double nearest = 1e9;  // the file has another order
                for (const Instance& read : scene.instances) {
                    double apart = scene.meshes[std::size_t(read.mesh)].name == mesh ? 0 : 1e9;
                    for (int column = 0; column < 4; ++column) {
                        apart += glm::length(read.object_to_world[column] - drawn.object_to_world[column]);
                    }
                    nearest = std::min(nearest, apart);
                }
                CHECK(nearest < 1e-6);
            }
        }
    }
}

TEST_CASE("Shrinking leaves what fails and nothing else") {
    int shrunk = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        const RandomScene random = make_random_scene(seed);
        if (!shows_specular_texture(random)) {
            continue;
        }
        ++shrunk;
        const RandomScene small = shrink(random, shows_specular_texture, 2000);
        INFO("seed " << seed);
        CHECK(shows_specular_texture(small));
        CHECK(small.scene.instances.size() == 1);
        CHECK(small.scene.lights.empty());
        CHECK(small.scene.environment.kind == EnvironmentKind::none);
        CHECK(small.settings.max_depth == 1);
        int textures = 0;
        for (const Material& m : small.scene.materials) {
            textures += (m.base_color_texture.texture != none) + (m.emission_texture.texture != none) +
                        (m.normal_texture.texture != none) + (m.specular_texture.texture != none);
            CHECK(m.emission == glm::vec3(0));
        }
        CHECK(textures == 1);
    }
    CHECK(shrunk > 5);
}
