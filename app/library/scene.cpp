#include "diptych/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "library/impl.h"
#include "near_miss.h"
#include "pose/clips.h"
#include "pose/pose.h"
#include "scene/completion.h"
#include "scene/default_camera.h"
#include "scene/environment_load.h"
#include "scene/sun.h"
#include "scene/viewpoint.h"

DIPTYCH_BEGIN

Scene Impl::make_scene(std::shared_ptr<core::Scene> content, core::FileNodes nodes) {
    Scene scene;
    scene.data_->tables = tables_of(*content, nodes);
    scene.data_->synced = scene.data_->tables;
    scene.data_->content = std::move(content);
    scene.data_->file_nodes = std::move(nodes);
    return scene;
}

core::Scene& SceneData::own_content() {
    if (content.use_count() > 1) {
        content = std::make_shared<core::Scene>(*content);
    }
    static std::atomic<std::uint64_t> revisions{0};
    revision = ++revisions;
    return *content;
}

std::shared_ptr<const core::Scene> SceneData::snapshot() {
    if (tables != synced) {
        check(tables, synced, *content, file_nodes.nodes.size());
        if (tables.nodes != synced.nodes) {
            core::FileNodes nodes = edited_nodes(synced, tables, file_nodes);
            follow_nodes(file_nodes, nodes, tables);
            apply(synced, tables, nodes, own_content());
            file_nodes = std::move(nodes);
        } else {
            let_go_of_nodes(synced, file_nodes, tables);
            apply(synced, tables, file_nodes, own_content());
        }
        synced = tables;
    }
    if (content->cameras.empty()) {
        core::add_missing_camera(own_content());
        tables.cameras.push_back(from_core(content->cameras.front()));
        synced.cameras = tables.cameras;
    }
    return content;
}

Scene::Scene() : data_(std::make_shared<SceneData>()) {
    data_->content = std::make_shared<core::Scene>();
}

std::vector<Material>& Scene::materials() {
    return data_->tables.materials;
}
std::vector<Camera>& Scene::cameras() {
    return data_->tables.cameras;
}
std::vector<Light>& Scene::lights() {
    return data_->tables.lights;
}
std::vector<Instance>& Scene::instances() {
    return data_->tables.instances;
}
Environment& Scene::environment() {
    return data_->tables.environment;
}
std::vector<Node>& Scene::nodes() {
    if (data_->synced.nodes.empty()) {
        data_->synced.nodes = nodes_of(*data_->content, data_->file_nodes);
        data_->tables.nodes = data_->synced.nodes;
    }
    return data_->tables.nodes;
}

NodeContent Scene::content_of(int node) const {
    const std::size_t count = data_->file_nodes.nodes.size();
    if (node < 0 || static_cast<std::size_t>(node) >= count) {
        throw Error(
            fmt::format("{}: there is no node {}; there are {}", name().empty() ? "scene" : name(), node, count));
    }
    const auto of = [&](const auto& table) {
        std::vector<int> indices;
        for (std::size_t i = 0; i < table.size(); ++i) {
            if (table[i].node == node) {
                indices.push_back(static_cast<int>(i));
            }
        }
        return indices;
    };
    return {of(data_->tables.instances), of(data_->tables.cameras), of(data_->tables.lights)};
}

namespace {

template <class Object>
Object& find(std::vector<Object>& table, std::string_view name, const char* kind, const std::string& scene) {
    std::vector<std::string> names;
    for (Object& object : table) {
        if (object.name == name) {
            return object;
        }
        names.push_back(object.name);
    }
    constexpr std::size_t shown = 20;
    std::string list;
    for (std::size_t i = 0; i < std::min(names.size(), shown); ++i) {
        list += fmt::format("{}'{}'", i == 0 ? "" : ", ", names[i]);
    }
    if (names.size() > shown) {
        list += fmt::format(" and {} more", names.size() - shown);
    }
    throw Error(fmt::format("{}: no {} '{}'{}; there are {}", scene.empty() ? "scene" : scene, kind, name,
                            core::did_you_mean(std::string(name), names), names.empty() ? "none" : list));
}

}  // namespace

Material& Scene::material(std::string_view name) {
    return find(materials(), name, "material", this->name());
}
Camera& Scene::camera(std::string_view name) {
    return find(cameras(), name, "camera", this->name());
}
Light& Scene::light(std::string_view name) {
    return find(lights(), name, "light", this->name());
}
Instance& Scene::instance(std::string_view name) {
    return find(instances(), name, "instance", this->name());
}
Node& Scene::node(std::string_view name) {
    return find(nodes(), name, "node", this->name());
}

Light& Scene::add(const Sun& sun) {
    lights().push_back(from_core(core::sun_light({sun.azimuth, sun.elevation, sun.irradiance})));
    return lights().back();
}

namespace {

/// Throws before anything is added.
void check(const MeshData& mesh, std::size_t materials) {
    const std::string object = mesh.name.empty() ? "mesh" : "mesh '" + mesh.name + "'";
    const std::size_t vertices = mesh.positions.size();
    const auto require_length = [&](std::size_t length, const char* what) {
        if (length != 0 && length != vertices) {
            throw Error(fmt::format("{}: {} {} for {} positions", object, length, what, vertices));
        }
    };
    const auto require_finite = [&](const auto& values, const char* what) {
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (!std::all_of(values[i].begin(), values[i].end(), [](float x) { return std::isfinite(x); })) {
                throw Error(fmt::format("{}: {}[{}] is not finite", object, what, i));
            }
        }
    };
    if (vertices == 0 || mesh.triangles.empty()) {
        throw Error(object + ": no " + (vertices == 0 ? "positions" : "triangles"));
    }
    require_length(mesh.normals.size(), "normals");
    require_length(mesh.uvs.size(), "uvs");
    require_finite(mesh.positions, "positions");
    require_finite(mesh.normals, "normals");
    require_finite(mesh.uvs, "uvs");
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (const std::uint32_t index : mesh.triangles[i]) {
            if (index >= vertices) {
                throw Error(
                    fmt::format("{}: triangles[{}] names position {}; there are {}", object, i, index, vertices));
            }
        }
    }
    if (mesh.material != none && (mesh.material < 0 || static_cast<std::size_t>(mesh.material) >= materials)) {
        throw Error(fmt::format("{}: material {} of {}", object, mesh.material, materials));
    }
}

int default_material(std::vector<Material>& materials) {
    Material material;
    material.name = "default";
    const auto found = std::find(materials.begin(), materials.end(), material);
    if (found != materials.end()) {
        return static_cast<int>(found - materials.begin());
    }
    materials.push_back(material);
    return static_cast<int>(materials.size()) - 1;
}

core::Mesh to_core(const MeshData& mesh, int material) {
    core::Primitive primitive;
    for (const Vec3& p : mesh.positions) {
        primitive.positions.emplace_back(p[0], p[1], p[2]);
    }
    for (const Vec3& n : mesh.normals) {
        const glm::vec3 normal(n[0], n[1], n[2]);
        const float length = glm::length(normal);
        primitive.normals.push_back(length > 0 ? normal / length : normal);
    }
    for (const Vec2& uv : mesh.uvs) {
        primitive.uvs[0].emplace_back(uv[0], uv[1]);
    }
    for (const std::array<std::uint32_t, 3>& t : mesh.triangles) {
        primitive.triangles.emplace_back(t[0], t[1], t[2]);
    }
    primitive.material = material;
    return {mesh.name, {std::move(primitive)}};
}

}  // namespace

int Scene::add_mesh(const MeshData& mesh, const Matrix& object_to_world) {
    check(mesh, materials().size());
    const int material = mesh.material == none ? default_material(materials()) : mesh.material;
    core::Scene& content = data_->own_content();
    content.meshes.push_back(to_core(mesh, material));
    const int index = static_cast<int>(content.meshes.size()) - 1;
    instances().push_back({mesh.name, index, object_to_world, none});
    return index;
}

int Scene::add_texture(int width, int height, std::span<const std::uint8_t> rgba, const std::string& name) {
    const std::size_t wanted =
        width > 0 && height > 0 ? 4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height) : 0;
    if (wanted == 0 || rgba.size() != wanted) {
        throw Error(fmt::format("texture '{}': {} bytes for {}x{} RGBA pixels", name, rgba.size(), width, height));
    }
    core::Scene& content = data_->own_content();
    content.images.push_back({name, width, height, {rgba.begin(), rgba.end()}});
    content.textures.push_back({name, static_cast<int>(content.images.size()) - 1});
    return static_cast<int>(content.textures.size()) - 1;
}

const std::string& Scene::name() const {
    return data_->content->name;
}

std::size_t Scene::mesh_count() const {
    return data_->content->meshes.size();
}

std::size_t Scene::triangle_count() const {
    std::size_t count = 0;
    for (const Instance& instance : data_->tables.instances) {
        if (instance.mesh < 0 || static_cast<std::size_t>(instance.mesh) >= mesh_count()) {
            continue;  // refused at the next render
        }
        for (const core::Primitive& primitive :
             data_->content->meshes[static_cast<std::size_t>(instance.mesh)].primitives) {
            count += primitive.triangles.size();
        }
    }
    return count;
}

std::vector<std::string> Scene::animations() const {
    std::vector<std::string> names;
    for (const core::Animation& animation : data_->content->animations) {
        names.push_back(animation.name);
    }
    return names;
}

double Scene::duration() const {
    return core::duration(*data_->content);
}

Scene Scene::copy() const {
    Scene scene;
    *scene.data_ = *data_;
    return scene;
}

Scene load(const std::string& path, const LoadOptions& options) {
    return guarded([&] {
        core::FileNodes nodes;
        auto content = std::make_shared<core::Scene>(
            core::load_gltf(path, {options.ignore_extensions, options.strict, options.allow_external,
                                   options.memory_limit}, &nodes));
        if (content->name.empty()) {
            content->name = path;
        }
        if (options.animation.empty()) {
            core::play_all_clips(*content);
        } else {
            core::play_clip(*content, core::find_clip(*content, options.animation));
        }
        if (options.complete) {
            core::add_missing_light(*content);
            core::add_missing_camera(*content);
        }
        if (options.warnings) {
            for (const std::string& line : content->warnings.lines()) {
                options.warnings(line);
            }
        }
        return Impl::make_scene(std::move(content), std::move(nodes));
    });
}

Environment load_environment(const std::string& path, std::uint64_t memory_limit) {
    return guarded([&] { return from_core(core::load_environment(path, nullptr, memory_limit)); });
}

Camera look_at(const Point& eye, const Point& target, const Point& up, double vertical_fov) {
    return guarded([&] {
        core::Camera camera;
        core::Viewpoint viewpoint;
        viewpoint.eye = glm::dvec3(eye[0], eye[1], eye[2]);
        viewpoint.look_at = glm::dvec3(target[0], target[1], target[2]);
        viewpoint.up = glm::dvec3(up[0], up[1], up[2]);
        core::place_at(viewpoint, camera);
        camera.vertical_fov = vertical_fov;
        Camera placed = from_core(camera);
        check(placed);
        return placed;
    });
}

DIPTYCH_END
