#include <algorithm>

#include "random_scene/parts.h"
#include "generate/shapes.h"

namespace diptych::core {

namespace {

/// A bumpy 2 x 2 grid that faces +z, with smooth normals.
Primitive make_patch(Draws& draws) {
    Primitive out;
    for (int i = 0; i < 9; ++i) {
        out.positions.emplace_back(i % 3 - 1, i / 3 - 1, draws.between(-0.3, 0.3));
        out.normals.push_back(glm::normalize(glm::vec3(draws.between(-0.4, 0.4), draws.between(-0.4, 0.4), 1)));
    }
    for (const unsigned corner : {0U, 1U, 3U, 4U}) {
        out.triangles.emplace_back(corner, corner + 1, corner + 4);
        out.triangles.emplace_back(corner, corner + 4, corner + 3);
    }
    return out;
}

/// Four triangles that share no vertex, around a skewed tetrahedron.
Primitive make_tetrahedron(Draws& draws) {
    glm::vec3 corners[4] = {{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    for (glm::vec3& corner : corners) {
        corner += glm::vec3(draws.within(-0.3, 0.3));
    }
    constexpr unsigned faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    Primitive out;
    for (const auto& face : faces) {
        const auto first = unsigned(out.positions.size());
        for (const unsigned corner : face) {
            out.positions.push_back(corners[corner]);
        }
        out.triangles.emplace_back(first, first + 1, first + 2);
    }
    return out;
}

Primitive random_shape(Draws& draws) {
    Primitive out;
    switch (draws.below(5)) {
    case 0:
        add_quad(out, {-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0});
        return out;
    case 1:
        add_box(out, {-1, -1, -1}, {1, 1, 1});
        return out;
    case 2:
        return make_tetrahedron(draws);
    case 3:
        return make_patch(draws);
    default: {
        const int segments = 5 + draws.below(4);
        return make_sphere(1, segments, 4, none);
    }
    }
}

/// Kept, left out or tilted. A flat shape has none to keep, and may be given some.
void draw_normals(Primitive& p, Draws& draws) {
    const int kind = draws.below(4);
    if (kind == 0) {
        p.normals.clear();
    } else if (kind == 1 && p.normals.empty()) {
        p.normals.resize(p.positions.size());
        for (const glm::uvec3& t : p.triangles) {
            const glm::vec3 a = p.positions[t.x];
            const glm::vec3 front = glm::normalize(glm::cross(p.positions[t.y] - a, p.positions[t.z] - a));
            p.normals[t.x] = p.normals[t.y] = p.normals[t.z] = front;
        }
    }
    if (draws.chance(0.4)) {
        for (glm::vec3& normal : p.normals) {
            normal = glm::normalize(normal + 0.35F * glm::vec3(draws.direction()));
        }
    }
}

std::vector<glm::vec2> random_uvs(const Primitive& p, Draws& draws) {
    const double size = draws.between(0.4, 1.2);
    const glm::dvec3 u = size * draws.direction();
    const glm::dvec3 v = size * draws.direction();
    std::vector<glm::vec2> out;
    for (const glm::vec3& position : p.positions) {
        const glm::dvec2 jitter{draws.between(-0.2, 0.2), draws.between(-0.2, 0.2)};
        out.emplace_back(glm::dvec2(dot(u, glm::dvec3(position)), dot(v, glm::dvec3(position))) + jitter + 0.3);
    }
    return out;
}

void draw_attributes(Primitive& p, Draws& draws) {
    draw_normals(p, draws);
    for (const double presence : {0.9, 0.7}) {
        const bool there = draws.chance(presence);
        std::vector<glm::vec2>& set = presence > 0.8 ? p.uvs[0] : p.uvs[1];
        set = random_uvs(p, draws);
        if (!there) {
            set.clear();
        }
    }
    if (draws.chance(0.4)) {
        for (std::size_t i = 0; i < p.positions.size(); ++i) {
            const glm::dvec3 color = draws.within(0.3, 1);
            p.colors.emplace_back(color, draws.between(0.5, 1));
        }
    }
    const bool given = draws.chance(0.5);
    const double handedness = draws.sign();
    for (std::size_t i = 0; given && i < p.positions.size(); ++i) {
        const glm::dvec3 direction = draws.direction();
        p.tangents.emplace_back(direction, draws.chance(0.1) ? -handedness : handedness);
    }
}

Node random_node(Draws& draws) {
    const glm::dmat3 turn = draws.rotation();
    glm::dvec3 scale = draws.within(0.5, 1.5);
    if (draws.chance(0.35)) {
        scale[draws.below(3)] *= -1;
    }
    Node node;
    node.translation = draws.within(-0.3, 0.3);
    if (draws.chance(0.3)) {  // a sheared matrix, as only a matrix can hold
        const glm::dmat3 other = draws.rotation();
        const glm::dmat3 stretch(scale.x, 0, 0, 0, scale.y, 0, 0, 0, scale.z);
        node.matrix = glm::dmat4(turn * stretch * other);
        (*node.matrix)[3] = glm::dvec4(node.translation, 1);
        return node;
    }
    const glm::dvec3 axis = draws.direction();
    const double angle = draws.between(-1, 1);  // cosine of its half
    node.rotation = glm::dvec4(axis * std::sqrt(1 - angle * angle), angle);
    node.scale = scale;
    return node;
}

/// Brings the mesh under `inner` to `place`, `size` across, turned.
glm::dmat4 outer_transform(const Mesh& mesh, const glm::dmat4& inner, const glm::dvec3& place, double size,
                           const glm::dmat3& turn) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const Primitive& p : mesh.primitives) {
        for (const glm::vec3& position : p.positions) {
            const glm::dvec3 at = turn * glm::dvec3(inner * glm::dvec4(position, 1));
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
    }
    const glm::dvec3 extent = high - low;
    const double scale = size / std::max({extent.x, extent.y, extent.z});
    glm::dmat4 out(turn * scale);
    out[3] = glm::dvec4(place - 0.5 * scale * (low + high), 1);
    return out;
}

/// An instance below one to four nodes, the outermost of which brings it to its place.
void add_placed(Scene& scene, int mesh, const glm::dvec3& place, double size, Draws& draws) {
    const int inner_count = draws.below(4);
    std::vector<Node> inner;
    glm::dmat4 chain(1);
    for (int i = 0; i < inner_count; ++i) {
        inner.push_back(random_node(draws));
        chain = chain * node_matrix(inner.back());
    }
    Node outer;
    outer.name = "object" + std::to_string(scene.instances.size());
    outer.matrix = outer_transform(scene.meshes[std::size_t(mesh)], chain, place, size, draws.rotation());
    Instance instance;
    instance.mesh = mesh;
    instance.object_to_world = *outer.matrix * chain;
    int parent = int(scene.nodes.size());
    scene.nodes.push_back(outer);
    for (Node& node : inner) {
        node.parent = parent;
        node.name = outer.name + "-" + std::to_string(parent);
        parent = int(scene.nodes.size());
        scene.nodes.push_back(node);
    }
    instance.node = parent;
    instance.name = scene.nodes.back().name;
    scene.instances.push_back(instance);
}

int add_random_mesh(Scene& scene, const TexturePool& textures, Role role, std::uint64_t seed, Draws& draws) {
    std::vector<Primitive> primitives;
    const int count = draws.chance(0.25) ? 2 : 1;
    for (int i = 0; i < count; ++i) {
        Primitive p = random_shape(draws);
        for (glm::vec3& position : p.positions) {
            // They may meet, but no two faces share a plane: rounding would choose the nearer one, for each renderer another.
            position += float(i) * glm::vec3(1.5F, 0.37F, 0.23F);
        }
        draw_attributes(p, draws);
        p.material = add_random_material(scene, textures, role, Draws(seed, Topic::materials, scene.materials.size()));
        primitives.push_back(std::move(p));
    }
    return add_mesh(scene, "mesh" + std::to_string(scene.meshes.size()), std::move(primitives));
}

void add_objects(Scene& scene, const TexturePool& textures, std::uint64_t seed, Draws& draws) {
    constexpr glm::dvec3 places[] = {{-0.6, 0.45, 0}, {0.6, -0.45, 0}, {-0.6, -0.45, 0}, {0.6, 0.45, 0}};
    const int count = 2 + draws.below(3);
    int mesh = none;
    for (int i = 0; i < count; ++i) {
        const bool again = mesh != none && draws.chance(0.3);  // an instance of the mesh before
        mesh = again ? mesh : add_random_mesh(scene, textures, Role::object, seed, draws);
        const glm::dvec3 place = places[i] + draws.within(-0.15, 0.15);
        const double size = draws.between(1, 1.6);
        add_placed(scene, mesh, place, size, draws);
    }
}

/// A square behind the objects, in any material.
void add_backdrop(Scene& scene, const TexturePool& textures, std::uint64_t seed, Draws& draws) {
    Primitive p;
    add_quad(p, {-2.5F, -2, -1.3F}, {2.5F, -2, -1.3F}, {2.5F, 2, -1.6F}, {-2.5F, 2, -1.6F});
    draw_attributes(p, draws);
    p.material = add_random_material(scene, textures, Role::object, Draws(seed, Topic::materials, scene.materials.size()));
    add_object(scene, "backdrop", {p});
}

/// Walls around everything, the cameras included.
void add_room(Scene& scene, const TexturePool& textures, std::uint64_t seed) {
    Primitive p;
    add_box(p, {-5, -5, -5}, {5, 5, 7});
    p.material = add_random_material(scene, textures, Role::room, Draws(seed, Topic::materials, scene.materials.size()));
    add_object(scene, room_name, {p});
}

}  // namespace

void add_random_meshes(Scene& scene, const TexturePool& textures, std::uint64_t seed) {
    Draws draws(seed, Topic::meshes);
    add_objects(scene, textures, seed, draws);
    if (draws.chance(0.75)) {
        add_backdrop(scene, textures, seed, draws);
    }
    const int lamps = draws.below(3);
    for (int i = 0; i < lamps; ++i) {
        const int mesh = add_random_mesh(scene, textures, Role::lamp, seed, draws);
        const glm::dvec3 side = draws.direction();
        const double distance = draws.between(1.8, 2.4);
        const double size = draws.between(1, 1.6);
        add_placed(scene, mesh, distance * glm::dvec3(side.x, side.y, std::abs(side.z)), size, draws);
    }
    if (draws.chance(0.25)) {
        add_room(scene, textures, seed);
    }
}

}  // namespace diptych::core
