#include "pack/cut_triangles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace diptych::core {
namespace {

/// Halvings of the mesh's extent after which a triangle is left as it is: the eye may lie in its plane.
constexpr int most_halvings = 22;

bool comes_before(const glm::dvec3& a, const glm::dvec3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// An edge by where it lies: triangles that meet there may have vertices of their own.
struct Edge {
    glm::dvec3 from;
    glm::dvec3 to;

    Edge(const glm::dvec3& a, const glm::dvec3& b) : from(comes_before(a, b) ? a : b), to(comes_before(a, b) ? b : a) {}
    bool operator<(const Edge& other) const {
        return from != other.from ? comes_before(from, other.from) : comes_before(to, other.to);
    }
};

/// A primitive on its way, with places in double precision relative to the eye.
struct Cutting {
    Primitive primitive;
    std::vector<glm::dvec3> places;

    Cutting(const Primitive& whole, const glm::dvec3& eye) : primitive(whole) {
        places.reserve(whole.positions.size());
        for (const glm::vec3& position : whole.positions) {
            places.push_back(glm::dvec3(position) - eye);
        }
    }

    Edge edge(const glm::uvec3& t, int side) const { return {places[t[side]], places[t[(side + 1) % 3]]}; }

    /// Whether there is a place between the ends of that side: halving ends where double precision does.
    bool has_middle(const glm::uvec3& t, int side) const {
        const glm::dvec3& from = places[t[side]];
        const glm::dvec3& to = places[t[(side + 1) % 3]];
        const glm::dvec3 middle = 0.5 * (from + to);
        return middle != from && middle != to;
    }

    /// How many triangles halving these edges will add.
    std::size_t count_halves(const std::set<Edge>& edges) const {
        std::size_t count = 0;
        for (const glm::uvec3& t : primitive.triangles) {
            for (int side = 0; side < 3; ++side) {
                count += edges.count(edge(t, side));
            }
        }
        return count;
    }

    std::uint32_t add_middle(std::uint32_t a, std::uint32_t b) {
        const auto add = [&](auto& values) {
            if (!values.empty()) {
                values.push_back((values[a] + values[b]) * 0.5F);
            }
        };
        places.push_back(0.5 * (places[a] + places[b]));
        add(primitive.normals);
        if (!primitive.tangents.empty()) {
            glm::vec4 tangent = (primitive.tangents[a] + primitive.tangents[b]) * 0.5F;
            tangent.w = primitive.tangents[a].w;
            primitive.tangents.push_back(tangent);
        }
        add(primitive.uvs[0]);
        add(primitive.uvs[1]);
        add(primitive.colors);
        return static_cast<std::uint32_t>(places.size() - 1);
    }

    /// Halves the triangles along these edges, and the halves again where more than one of a triangle's edges is there.
    void halve(const std::set<Edge>& edges) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        std::vector<glm::uvec3>& triangles = primitive.triangles;
        for (std::size_t i = 0; i < triangles.size();) {
            const glm::uvec3 t = triangles[i];
            int side = 0;
            while (side < 3 && edges.count(edge(t, side)) == 0) {
                ++side;
            }
            if (side == 3) {
                ++i;
                continue;
            }
            const std::uint32_t a = t[side];
            const std::uint32_t b = t[(side + 1) % 3];
            const std::uint32_t c = t[(side + 2) % 3];
            auto [middle, is_new] = middles.try_emplace({std::min(a, b), std::max(a, b)});
            if (is_new) {
                middle->second = add_middle(middle->first.first, middle->first.second);
            }
            triangles[i] = {a, middle->second, c};
            triangles.emplace_back(middle->second, b, c);
        }
    }
};

using Corners = std::array<glm::dvec3, 3>;  // in the world, from the eye

/// Which triangles are too large for where they lie.
struct Sizing {
    glm::dmat3 to_world;
    double least_distance;

    /// The longest side of such a triangle, by the corner that it begins at.
    std::optional<int> side_to_halve(const Corners& corner) const {
        std::array<double, 3> squared;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 along = corner[(k + 1) % 3] - corner[k];
            squared[k] = glm::dot(along, along);
        }
        const auto longest = std::max_element(squared.begin(), squared.end());
        const double length = std::sqrt(*longest);
        if (!(length > longest_near_edge * least_distance)) {
            return std::nullopt;
        }
        const glm::dvec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        const glm::dvec3 centroid = (corner[0] + corner[1] + corner[2]) / 3.0;
        // Neither is more than the distance, and one of them is not much less.
        const double off_plane = std::abs(glm::dot(normal, centroid)) / std::max(glm::length(normal), 1e-300);
        const double off_sphere = glm::length(centroid) - length;
        if (!(length > longest_near_edge * std::max(off_plane, off_sphere))) {
            return std::nullopt;
        }
        return static_cast<int>(longest - squared.begin());
    }

    std::set<Edge> edges_to_halve(const std::vector<Cutting>& parts) const {
        std::set<Edge> edges;
        for (const Cutting& part : parts) {
            for (const glm::uvec3& t : part.primitive.triangles) {
                const auto corner = [&](int k) { return to_world * part.places[t[k]]; };
                const std::optional<int> side = side_to_halve({corner(0), corner(1), corner(2)});
                if (side && part.has_middle(t, *side)) {
                    edges.insert(part.edge(t, *side));
                }
            }
        }
        return edges;
    }

    bool finds_any(const Mesh& mesh, const glm::dvec3& eye) const {
        return std::any_of(mesh.primitives.begin(), mesh.primitives.end(), [&](const Primitive& primitive) {
            const auto corner = [&](std::uint32_t v) { return to_world * (glm::dvec3(primitive.positions[v]) - eye); };
            return std::any_of(primitive.triangles.begin(), primitive.triangles.end(), [&](const glm::uvec3& t) {
                return side_to_halve({corner(t.x), corner(t.y), corner(t.z)}).has_value();
            });
        });
    }
};

/// The longest diagonal of the mesh where it stands, and how near the eye comes to the box of that.
std::pair<double, double> extent_and_distance(const Mesh& mesh, const glm::dvec3& eye, const glm::dmat3& to_world) {
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    for (const Primitive& primitive : mesh.primitives) {
        for (const glm::vec3& position : primitive.positions) {
            const glm::dvec3 p = to_world * (glm::dvec3(position) - eye);
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
    }
    return low.x <= high.x ? std::pair(glm::length(high - low), glm::length(glm::clamp(glm::dvec3(0), low, high)))
                           : std::pair(0.0, 0.0);
}

}  // namespace

std::optional<Mesh> cut_near_triangles(const Mesh& mesh, const glm::dvec3& eye, const glm::dmat3& object_to_world,
                                       std::size_t& budget) {
    const auto [extent, distance] = extent_and_distance(mesh, eye, object_to_world);
    const Sizing sizing{object_to_world, std::ldexp(extent, -most_halvings)};
    if (!std::isfinite(extent) || extent <= longest_near_edge * distance || !sizing.finds_any(mesh, eye)) {
        return std::nullopt;
    }
    std::vector<Cutting> parts;
    for (const Primitive& primitive : mesh.primitives) {
        parts.emplace_back(primitive, eye);
    }
    for (std::set<Edge> edges = sizing.edges_to_halve(parts); !edges.empty(); edges = sizing.edges_to_halve(parts)) {
        std::size_t added = 0;
        for (const Cutting& part : parts) {
            added += part.count_halves(edges);
        }
        if (added > budget) {
            break;
        }
        budget -= added;
        for (Cutting& part : parts) {
            part.halve(edges);
        }
    }
    Mesh cut;
    cut.name = mesh.name;
    for (Cutting& part : parts) {
        part.primitive.positions.clear();
        std::transform(part.places.begin(), part.places.end(), std::back_inserter(part.primitive.positions),
                       [](const glm::dvec3& place) { return glm::vec3(place); });
        cut.primitives.push_back(std::move(part.primitive));
    }
    return cut;
}

}  // namespace diptych::core
