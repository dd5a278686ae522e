#include "pack/mesh_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "language/compat.h"
#include "error.h"
#include "pack/duplicate_triangles.h"
#include "pack/linear_part.h"
#include "pack/range.h"

namespace diptych::core {
namespace {

/// Triangles and vertices that may be copied so that instances have vertices in the world; those beyond are thickened.
constexpr std::size_t fewest_copied = std::size_t{1} << 20U;
/// Triangles whose doubled area is no larger a share of their longest side's square are lines that rounding widened.
constexpr double least_area = 1e-13;

std::size_t vertex_count(const Mesh& mesh) {
    std::size_t count = 0;
    for (const Primitive& primitive : mesh.primitives) {
        count += primitive.positions.size();
    }
    return count;
}

std::size_t triangle_count(const Mesh& mesh) {
    std::size_t count = 0;
    for (const Primitive& primitive : mesh.primitives) {
        count += primitive.triangles.size();
    }
    return count;
}

bool has_area(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const glm::dvec3 sides[] = {b - a, c - a, c - b};
    double longest = 0;
    for (const glm::dvec3& side : sides) {
        longest = std::max(longest, glm::length(side));
    }
    return glm::length(glm::cross(sides[0] / longest, sides[1] / longest)) > least_area;
}

/// Attributes that only their directions matter of, by the matrix over its size; not normalised, so that interpolation
/// and transform commute as they do where the matrix is the instance's.
void turn(std::vector<glm::vec3>& normals, const glm::dmat3& m) {
    const double size = largest_column(m);
    for (glm::vec3& normal : normals) {
        normal = size > 0 ? glm::vec3(m * glm::dvec3(normal) / size) : glm::vec3(0);
    }
}

void turn(std::vector<glm::vec4>& tangents, const glm::dmat3& m) {
    const double size = largest_column(m);
    for (glm::vec4& tangent : tangents) {
        tangent = glm::vec4(glm::vec3(m * glm::dvec3(tangent) / size), tangent.w);
    }
}

template <typename Visit>
void each_corner(const Mesh& mesh, const Visit& visit) {
    for (const Primitive& primitive : mesh.primitives) {
        for (const glm::uvec3& t : primitive.triangles) {
            for (int k = 0; k < 3; ++k) {
                visit(primitive.positions[t[k]]);
            }
        }
    }
}

Box world_box(const Mesh& mesh, const glm::dmat4& to_world) {
    Box box;
    each_corner(mesh, [&](const glm::vec3& position) {
        const glm::dvec3 p(to_world * glm::dvec4(position, 1));
        box.low = glm::min(box.low, p);
        box.high = glm::max(box.high, p);
    });
    return box;
}

/// Principal axes, and how far the mesh reaches along them.
void find_spread(const Mesh& mesh, MeshFrame& frame) {
    const auto packed = [&](const glm::vec3& p) { return (glm::dvec3(p) - frame.center) / frame.unit; };
    glm::dmat3 covariance(0);
    each_corner(mesh, [&](const glm::vec3& p) {
        const glm::dvec3 from_middle = packed(p) - frame.middle;
        covariance += glm::outerProduct(from_middle, from_middle);
    });
    glm::dmat3 axes = singular_values(covariance, false).right;
    axes[2] = glm::cross(axes[0], axes[1]);
    glm::dvec3 low(1e300);
    glm::dvec3 high(-1e300);
    each_corner(mesh, [&](const glm::vec3& p) {
        const glm::dvec3 along = glm::transpose(axes) * packed(p);
        low = glm::min(low, along);
        high = glm::max(high, along);
    });
    frame.middle = axes * (0.5 * (low + high));
    frame.spread = {axes, 0.5 * (high - low)};
}

/// Where the mesh's vertices are to lie: as the instance says, but for the two sides of a shape that it flattens.
glm::dmat4 placement_of(const Mesh& mesh, const glm::dmat4& to_world) {
    const Box box = world_box(mesh, glm::dmat4(1));
    if (!(box.low.x <= box.high.x)) {
        return to_world;
    }
    MeshFrame frame;
    frame.middle = 0.5 * (box.low + box.high);
    find_spread(mesh, frame);
    const std::optional<glm::dmat3> apart =
        MUTANT(SHEETS_COINCIDE, with_sheets_apart(glm::dmat3(to_world), frame.spread), std::optional<glm::dmat3>());
    if (!apart) {
        return to_world;
    }
    glm::dmat4 placed(*apart);
    placed[3] = glm::dvec4(glm::dvec3(to_world * glm::dvec4(frame.middle, 1)) - *apart * frame.middle, 1);
    return placed;
}

/// The mesh where it stands, about the middle of its box; its triangles without area are gone.
PlannedMesh in_world(const Mesh& mesh, const glm::dmat4& instance_to_world) {
    const glm::dmat4 to_world = placement_of(mesh, instance_to_world);
    const Box box = world_box(mesh, to_world);
    PlannedMesh planned;
    planned.frame.in_world = true;
    planned.frame.center = box.low.x <= box.high.x ? 0.5 * (box.low + box.high) : glm::dvec3(0);
    glm::dmat4 moved = to_world;
    moved[3] -= glm::dvec4(planned.frame.center, 0);
    const glm::dmat3 linear = glm::dmat3(instance_to_world);
    const double scale = largest_column(linear);
    auto own = std::make_shared<Mesh>(mesh);
    for (Primitive& primitive : own->primitives) {
        const auto place = [&](std::uint32_t v) { return glm::dvec3(moved * glm::dvec4(primitive.positions[v], 1)); };
        std::vector<glm::uvec3>& triangles = primitive.triangles;
        triangles.erase(
            std::remove_if(triangles.begin(), triangles.end(),
                           [&](const glm::uvec3& t) { return !has_area(place(t.x), place(t.y), place(t.z)); }),
            triangles.end());
        for (std::uint32_t v = 0; v < primitive.positions.size(); ++v) {
            primitive.positions[v] = glm::vec3(place(v));
        }
        turn(primitive.normals, cofactor(linear / scale));
        turn(primitive.tangents, linear);
    }
    planned.own = std::move(own);
    planned.mesh = planned.own.get();
    return planned;
}

/// Where a mesh's vertices lie, if that is so far from their own origin that its triangles would lose digits there;
/// else 0. Differences of such vertices are exact.
glm::dvec3 center_of(const Box& box) {
    const glm::dvec3 middle = 0.5 * (box.low + box.high);
    const bool far = glm::length(middle) > 8 * glm::length(0.5 * (box.high - box.low)) && box.high.x >= box.low.x;
    return MUTANT(MESH_NOT_CENTRED, far, false) ? glm::dvec3(glm::vec3(middle)) : glm::dvec3(0);
}

/// The power of two near the mesh's size, where that is far from 1: matrices then say how large it is in the world.
double unit_of(const Box& box, const glm::dvec3& center) {
    const glm::dvec3 far = glm::max(glm::abs(box.low - center), glm::abs(box.high - center));
    const double size = std::max({far.x, far.y, far.z});
    return box.low.x <= box.high.x && size > 0 && (size < 1e-6 || size > 1e6) ? std::exp2(std::round(std::log2(size)))
                                                                             : 1.0;
}

/// Both lists of one mesh; either may be empty.
std::vector<LeftOut> joined(std::vector<LeftOut> a, const std::vector<LeftOut>& b) {
    a.resize(std::max(a.size(), b.size()));
    for (std::size_t p = 0; p < b.size(); ++p) {
        a[p].insert(a[p].end(), b[p].begin(), b[p].end());
    }
    return a;
}

std::size_t count_of(const std::vector<LeftOut>& lists) {
    std::size_t count = 0;
    for (const LeftOut& list : lists) {
        count += list.size();
    }
    return count;
}

PlannedMesh as_it_is(const Mesh& mesh, const std::vector<LeftOut>& left_out) {
    PlannedMesh planned;
    planned.mesh = &mesh;
    if (!left_out.empty()) {
        planned.own = std::make_shared<Mesh>(without_triangles(mesh, left_out));
        planned.mesh = planned.own.get();
    }
    const Box box = box_of(*planned.mesh);
    planned.frame.center = center_of(box);
    planned.frame.unit = unit_of(box, planned.frame.center);
    if (box.low.x <= box.high.x) {
        planned.frame.middle = (0.5 * (box.low + box.high) - planned.frame.center) / planned.frame.unit;
        planned.frame.spread.half = 0.5 * (box.high - box.low) / planned.frame.unit;
    }
    return planned;
}

class Planner {
public:
    Planner(const Scene& scene, const glm::dvec3& origin, const Camera* camera)
        : scene_(scene), origin_(origin), camera_(camera), duplicates_(find_duplicate_triangles(scene)) {}

    MeshPlan plan() {
        add_meshes();
        for (std::size_t i = 0; i < scene_.instances.size(); ++i) {
            const int mesh = plan_.of_instances.emplace_back(place(i));
            if (mesh != none) {
                plan_.meshes[static_cast<std::size_t>(mesh)].users.push_back(i);
            }
        }
        find_spreads();
        warn(duplicates_.count, "triangles repeat others, with the same vertices on the same side; left out");
        warn(without_area_, "instances are flattened to a line or a point by their transforms; left out");
        warn(tiny_, "instances are too small to be seen; left out");
        return std::move(plan_);
    }

private:
    void warn(std::size_t count, const char* what) {
        if (count > 0) {
            plan_.warnings.push_back(scene_.name + ": " + std::to_string(count) + " " + what);
        }
    }

    void add_meshes() {
        std::size_t size = 0;
        for (std::size_t i = 0; i < scene_.meshes.size(); ++i) {
            plan_.meshes.push_back(as_it_is(scene_.meshes[i], duplicates_.of_meshes[i]));
            size += triangle_count(scene_.meshes[i]) + vertex_count(scene_.meshes[i]);
        }
        plan_.reach = scene_reach(scene_, plan_.meshes, origin_);
        copies_left_ = std::max(fewest_copied, size);
        uses_.resize(scene_.meshes.size(), 0);
        for (const Instance& instance : scene_.instances) {
            ++uses_[static_cast<std::size_t>(instance.mesh)];
        }
    }

    /// Whether this instance may have a copy of its mesh.
    bool takes_copy(const Instance& instance, const Mesh& mesh) {
        const bool alone = uses_[static_cast<std::size_t>(instance.mesh)] == 1;
        const std::size_t copied = alone ? 0 : triangle_count(mesh) + vertex_count(mesh);
        if (copied > copies_left_) {
            return false;
        }
        copies_left_ -= copied;
        return true;
    }

    int add(PlannedMesh planned) {
        plan_.meshes.push_back(std::move(planned));
        return static_cast<int>(plan_.meshes.size()) - 1;
    }

    /// The index of its planned mesh.
    int place(std::size_t index) {
        const Instance& instance = scene_.instances[index];
        const auto of_scene = static_cast<std::size_t>(instance.mesh);
        int mesh = instance.mesh;
        if (!duplicates_.of_instances.empty() && !duplicates_.of_instances[index].empty()) {
            const std::vector<LeftOut> left_out =
                joined(duplicates_.of_meshes[of_scene], duplicates_.of_instances[index]);
            if (count_of(left_out) == triangle_count(scene_.meshes[of_scene])) {
                return none;
            }
            mesh = add(as_it_is(scene_.meshes[of_scene], left_out));
        }
        const Mesh& whole = *plan_.meshes[static_cast<std::size_t>(mesh)].mesh;
        if (triangle_count(whole) == 0) {
            return none;
        }
        const glm::dmat4& to_world = instance.object_to_world;
        const double distance = sizes_away(plan_.meshes[static_cast<std::size_t>(mesh)].frame, to_world, origin_);
        const bool good = has_good_inverse(glm::dmat3(to_world), distance, plan_.reach);
        if (instance.node != none || MUTANT(SINGULAR_NOT_IN_WORLD, good, true) || !takes_copy(instance, whole)) {
            return mesh;
        }
        PlannedMesh planned = in_world(whole, to_world);
        if (triangle_count(*planned.mesh) == 0) {
            ++without_area_;
            return none;
        }
        const Box box = box_of(*planned.mesh);
        if (glm::length(box.high - box.low) < smallest) {
            require_unseen(instance, glm::length(box.high - box.low), glm::length(planned.frame.center - origin_));
            ++tiny_;
            return none;
        }
        return add(std::move(planned));
    }

    /// Of meshes that instances may flatten: about axes of their own, so that what is flat is known to be.
    void find_spreads() {
        for (PlannedMesh& planned : plan_.meshes) {
            const bool flattened =
                std::any_of(planned.users.begin(), planned.users.end(), [&](std::size_t user) {
                    const Instance& instance = scene_.instances[user];
                    const double distance = sizes_away(planned.frame, instance.object_to_world, origin_);
                    return instance.node != none || !is_well_conditioned(glm::dmat3(instance.object_to_world),
                                                                         largest_condition(distance));
                });
            if (flattened && !planned.frame.in_world) {
                find_spread(*planned.mesh, planned.frame);
            }
        }
    }

    void require_unseen(const Instance& instance, double size, double distance) const {
        const double width = camera_ != nullptr && camera_->orthographic ? camera_->orthographic_height : distance;
        if (camera_ != nullptr && !(size < 1e-6 * width)) {
            char text[120];
            std::snprintf(text, sizeof text,
                          "is %.3g m across, which single precision cannot render: scale the scene up", size);
            throw Error(scene_.name + ": instance '" + instance.name + "': " + text);
        }
    }

    const Scene& scene_;
    glm::dvec3 origin_;
    const Camera* camera_;
    DuplicateTriangles duplicates_;
    MeshPlan plan_;
    std::vector<std::size_t> uses_;  // instances of each mesh
    std::size_t copies_left_ = 0;
    std::size_t without_area_ = 0;
    std::size_t tiny_ = 0;
};

}  // namespace

Box box_of(const Mesh& mesh) {
    return world_box(mesh, glm::dmat4(1));
}

bool has_good_inverse(const glm::dmat3& linear, double distance, double reach) {
    return is_well_conditioned(linear, largest_condition(distance)) && largest_column(linear) > std::max(1e-6, 1e-10 * reach);
}

MeshPlan plan_meshes(const Scene& scene, const glm::dvec3& origin, const Camera* camera) {
    return Planner(scene, origin, camera).plan();
}

}  // namespace diptych::core
