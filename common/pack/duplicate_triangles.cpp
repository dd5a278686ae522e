#include "pack/duplicate_triangles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <set>

#include "language/compat.h"

namespace diptych::core {
namespace {

using TurnedCorners = std::array<glm::vec3, 3>;

bool is_before(const glm::vec3& a, const glm::vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Vertices from the least on, so that it does not matter which is named first. Adding 0 makes -0 a 0.
TurnedCorners cyclic(const Primitive& primitive, const glm::uvec3& t) {
    TurnedCorners c = {primitive.positions[t.x] + 0.0F, primitive.positions[t.y] + 0.0F, primitive.positions[t.z] + 0.0F};
    std::rotate(c.begin(), std::min_element(c.begin(), c.end(), is_before), c.end());
    return c;
}

std::uint64_t hash(const TurnedCorners& corners) {
    std::uint64_t h = 0x9e3779b97f4a7c15U;
    for (const glm::vec3& corner : corners) {
        for (int i = 0; i < 3; ++i) {
            h = (h ^ std::bit_cast<std::uint32_t>(corner[i])) * 0xff51afd7ed558ccdU;
            h ^= h >> 32U;
        }
    }
    return h;
}

struct TriangleId {
    std::uint32_t mesh = 0;
    std::uint32_t primitive = 0;
    std::uint32_t triangle = 0;
};

/// Finds triangles again: open addressing, 16 bytes a triangle.
class TriangleTable {
public:
    TriangleTable(const Scene& scene, const std::vector<bool>& used) : scene_(scene) {
        for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
            for (std::uint32_t p = 0; used[m] && p < scene.meshes[m].primitives.size(); ++p) {
                const Primitive& primitive = scene.meshes[m].primitives[p];
                if (scene.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::opaque) {
                    runs_.push_back({count_, {m, p, 0}});
                    count_ += primitive.triangles.size();
                }
            }
        }
        // More cannot be packed, which is said there.
        if (count_ < std::numeric_limits<std::uint32_t>::max()) {
            slots_.resize(std::bit_ceil(2 * count_ + 1));
        }
    }

    /// Calls `repeats(first, again)` for each triangle that was met before.
    template <typename Repeats>
    void each_repeat(const Repeats& repeats) {
        for (std::size_t id = 0; !slots_.empty() && id < count_; ++id) {
            const TurnedCorners corners = corners_of(id);
            const std::uint64_t h = hash(corners);
            std::size_t slot = h & (slots_.size() - 1);
            while (slots_[slot].next_id != 0 &&
                   (slots_[slot].print != h >> 32U || corners_of(slots_[slot].next_id - 1U) != corners)) {
                slot = (slot + 1) & (slots_.size() - 1);
            }
            if (slots_[slot].next_id != 0) {
                repeats(slots_[slot].next_id - 1U, id);
            } else {
                slots_[slot] = {static_cast<std::uint32_t>(h >> 32U), static_cast<std::uint32_t>(id + 1)};
            }
        }
    }

    TriangleId find(std::size_t id) const {
        const auto after = std::upper_bound(runs_.begin(), runs_.end(), id,
                                            [](std::size_t wanted, const Run& run) { return wanted < run.first; });
        TriangleId found = std::prev(after)->begin;
        found.triangle = static_cast<std::uint32_t>(id - std::prev(after)->first);
        return found;
    }

private:
    struct Run {
        std::size_t first;
        TriangleId begin;
    };
    struct Slot {
        std::uint32_t print = 0;
        std::uint32_t next_id = 0;  // 0: empty
    };

    TurnedCorners corners_of(std::size_t id) const {
        const TriangleId t = find(id);
        const Primitive& primitive = scene_.meshes[t.mesh].primitives[t.primitive];
        return cyclic(primitive, primitive.triangles[t.triangle]);
    }

    const Scene& scene_;
    std::vector<Run> runs_;
    std::size_t count_ = 0;
    std::vector<Slot> slots_;
};

/// Triangles of a mesh that others hold as well, by the first triangle of their kind.
using SharedTriangles = std::map<std::uint32_t, std::vector<std::pair<std::size_t, TriangleId>>>;

void leave_out(const Scene& scene, const TriangleId& t, std::vector<std::vector<LeftOut>>& of, std::size_t index) {
    of[index].resize(scene.meshes[t.mesh].primitives.size());
    of[index][t.primitive].push_back(t.triangle);
}

/// Fills of_meshes; what is left in several meshes is returned.
SharedTriangles compare_meshes(const Scene& scene, const std::vector<bool>& used, DuplicateTriangles& found) {
    TriangleTable table(scene, used);
    std::map<std::size_t, std::vector<TriangleId>> kinds;
    table.each_repeat([&](std::size_t first, std::size_t again) {
        std::vector<TriangleId>& kind = kinds[first];
        if (kind.empty()) {
            kind.push_back(table.find(first));
        }
        const TriangleId t = table.find(again);
        if (MUTANT(DUPLICATES_KEPT, kind.back().mesh == t.mesh, false)) {
            leave_out(scene, t, found.of_meshes, t.mesh);
        } else {
            kind.push_back(t);
        }
    });
    SharedTriangles shared;
    for (const auto& [first, kind] : kinds) {
        for (std::size_t i = 0; kind.size() > 1 && i < kind.size(); ++i) {
            shared[kind[i].mesh].emplace_back(first, kind[i]);
        }
    }
    return shared;
}

/// Instances that stand still, those of one transform next to one another and in order.
std::vector<std::size_t> by_transform(const Scene& scene) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        if (scene.instances[i].node == none) {
            order.push_back(i);
        }
    }
    const auto numbers = [&](std::size_t i) { return &scene.instances[i].object_to_world[0][0]; };
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::lexicographical_compare(numbers(a), numbers(a) + 16, numbers(b), numbers(b) + 16);
    });
    return order;
}

void leave_out_opaque(const Scene& scene, std::size_t instance, DuplicateTriangles& found) {
    const auto index = static_cast<std::size_t>(scene.instances[instance].mesh);
    const Mesh& mesh = scene.meshes[index];
    const std::vector<LeftOut>& already = found.of_meshes[index];
    for (std::uint32_t p = 0; p < mesh.primitives.size(); ++p) {
        const Primitive& primitive = mesh.primitives[p];
        const bool opaque =
            scene.materials[static_cast<std::size_t>(primitive.material)].alpha_mode == AlphaMode::opaque;
        for (std::uint32_t t = 0; opaque && t < primitive.triangles.size(); ++t) {
            if (already.empty() || !std::binary_search(already[p].begin(), already[p].end(), t)) {
                leave_out(scene, {static_cast<std::uint32_t>(index), p, t}, found.of_instances, instance);
            }
        }
    }
}

void compare_instances(const Scene& scene, const SharedTriangles& shared, DuplicateTriangles& found) {
    const std::vector<std::size_t> order = by_transform(scene);
    std::set<int> meshes;
    std::set<std::size_t> kinds;
    for (std::size_t k = 1; k < order.size(); ++k) {
        const Instance& instance = scene.instances[order[k]];
        const Instance& before = scene.instances[order[k - 1]];
        if (instance.object_to_world != before.object_to_world) {
            meshes.clear();
            kinds.clear();
            continue;
        }
        found.of_instances.resize(scene.instances.size());
        const auto meet = [&](const Instance& i) {
            const auto of_mesh = shared.find(static_cast<std::uint32_t>(i.mesh));
            for (std::size_t t = 0; of_mesh != shared.end() && t < of_mesh->second.size(); ++t) {
                const auto& [kind, triangle] = of_mesh->second[t];
                if (!kinds.insert(kind).second && &i == &instance) {
                    leave_out(scene, triangle, found.of_instances, order[k]);
                }
            }
        };
        if (meshes.insert(before.mesh).second) {
            meet(before);
        }
        if (meshes.insert(instance.mesh).second) {
            meet(instance);
        } else {
            leave_out_opaque(scene, order[k], found);
        }
    }
}

std::size_t count(const std::vector<LeftOut>& left_out) {
    std::size_t sum = 0;
    for (const LeftOut& of_primitive : left_out) {
        sum += of_primitive.size();
    }
    return sum;
}

}  // namespace

DuplicateTriangles find_duplicate_triangles(const Scene& scene) {
    DuplicateTriangles found;
    found.of_meshes.resize(scene.meshes.size());
    std::vector<bool> used(scene.meshes.size(), false);
    for (const Instance& instance : scene.instances) {
        used[static_cast<std::size_t>(instance.mesh)] = true;
    }
    compare_instances(scene, compare_meshes(scene, used, found), found);
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        found.count += count(found.of_meshes[static_cast<std::size_t>(scene.instances[i].mesh)]);
        found.count += found.of_instances.empty() ? 0 : count(found.of_instances[i]);
    }
    return found;
}

Mesh without_triangles(const Mesh& mesh, const std::vector<LeftOut>& left_out) {
    Mesh kept = mesh;
    for (std::size_t p = 0; p < left_out.size(); ++p) {
        std::vector<glm::uvec3>& triangles = kept.primitives[p].triangles;
        for (const std::uint32_t t : left_out[p]) {
            triangles[t] = glm::uvec3(0);
        }
        triangles.erase(std::remove(triangles.begin(), triangles.end(), glm::uvec3(0)), triangles.end());
    }
    return kept;
}

}  // namespace diptych::core
