#include "library/library_fixture.h"

#include <unistd.h>

#include <algorithm>
#include <bit>

namespace library_tests {

namespace {

void add_quad(dp::Scene& scene, const std::string& name, const std::vector<dp::Vec3>& corners, int material) {
    const std::vector<std::array<std::uint32_t, 3>> triangles = {{0, 1, 2}, {0, 2, 3}};
    const std::vector<dp::Vec2> uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    dp::MeshData mesh;
    mesh.name = name;
    mesh.positions = corners;
    mesh.triangles = triangles;
    mesh.uvs = uvs;
    mesh.material = material;
    scene.add_mesh(mesh);
}

dp::Material material(const std::string& name, const dp::Vec4& color, const dp::Vec3& emission = {0, 0, 0}) {
    dp::Material m;
    m.name = name;
    m.base_color = color;
    m.metallic = 0;
    m.emission = emission;
    return m;
}

}  // namespace

dp::Scene small_scene() {
    dp::Scene scene;
    scene.materials() = {material("white", {0.8F, 0.8F, 0.8F, 1}), material("red", {0.7F, 0.1F, 0.1F, 1}),
                         material("lamp", {0, 0, 0, 1}, {20, 18, 15})};
    add_quad(scene, "floor", {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}, 0);
    add_quad(scene, "wall", {{-2, 0, -2}, {2, 0, -2}, {2, 2, -2}, {-2, 2, -2}}, 1);
    add_quad(scene, "lamp", {{-0.3F, 1.2F, 0}, {-0.3F, 1.8F, 0}, {0.3F, 1.8F, 0}, {0.3F, 1.2F, 0}}, 2);
    scene.cameras().push_back(dp::look_at({0, 1.5, 4}, {0, 0.5, 0}));
    scene.cameras().back().name = "front";
    return scene;
}

dp::Settings small_settings(dp::Integrator integrator) {
    dp::Settings settings;
    settings.integrator = integrator;
    settings.size = {24, 16};
    settings.max_depth = 3;
    return settings;
}

std::vector<dp::Backend> panels() {
    std::vector<dp::Backend> panels = {dp::Backend::cpu};
    if (!dp::devices().empty()) {
        panels.push_back(dp::Backend::vulkan);
    }
    return panels;
}

bool same_bits(const dp::Film& a, const dp::Film& b) {
    const auto equal = [](std::span<const float> x, std::span<const float> y) {
        return std::equal(x.begin(), x.end(), y.begin(), y.end(), [](float p, float q) {
            return std::bit_cast<std::uint32_t>(p) == std::bit_cast<std::uint32_t>(q);
        });
    };
    return a.sums() == b.sums() && a.sample_counts() == b.sample_counts() &&
           equal(a.standard_error(), b.standard_error()) && equal(a.layer("albedo"), b.layer("albedo")) &&
           equal(a.layer("normal"), b.layer("normal")) && equal(a.layer("depth"), b.layer("depth"));
}

dp::Film rendered(const dp::Scene& scene, dp::Backend backend, const dp::Settings& settings, std::uint32_t spp) {
    dp::BackendChoice choice;
    choice.backend = backend;
    dp::Session session(scene, choice, settings);
    session.render(spp);
    return session.film();
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const dp::Error& error) {
        return error.what();
    }
    return "";
}

Folder::Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "diptych-library-XXXXXX").string();
    path = ::mkdtemp(pattern.data());
}

Folder::~Folder() {
    std::filesystem::remove_all(path);
}

}  // namespace library_tests
