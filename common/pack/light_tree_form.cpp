#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "pack/light_tree.h"

namespace diptych::core {
namespace {

/// Most lights of a patch of one surface that is not split. Fewer cost time: 8 of them take a level more.
constexpr std::uint32_t lights_a_patch = 32;
/// Of more lights than this, so many times as many are a leaf, wherever they stand. Else the nodes outgrow the caches.
constexpr std::size_t many_lights = std::size_t{1} << 15U;
static_assert(lights_a_patch <= shared::MOST_LIGHTS_PER_LEAF);

/// One or two lights that no split parts: halves of a quadrilateral stay together.
struct Atom {
    glm::vec3 center;
    float weight;
    glm::vec3 normal;
    float area;
    std::uint32_t first;
    std::uint32_t count;
};

/// Atoms begin to end - 1, which are together in the tree.
struct Branch {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
    std::uint32_t lights = 0;
    int axis = 0;       // along which to split: of the centers, or beyond them of the normals
    double middle = 0;
    double error = 0;   // weight times variance
    bool leaf = false;  // may be a leaf

    bool splits() const { return end - begin > 1; }
};

class TreeBuilder {
public:
    explicit TreeBuilder(PackedScene& packed) : packed_(packed) {}

    void build() {
        if (packed_.light_powers.size() > shared::LIGHT_LEAF_FIRST) {
            return;  // more than a node can name
        }
        find_atoms();
        if (atoms_.size() + distant_.size() < 2) {
            return;
        }
        packed_.light_places.assign(nearby_lights(packed_) + 1, {shared::NONE, 0});
        nodes_.push_back(shared::NONE);
        packed_.light_nodes.push_back({});
        const std::size_t taken = add_distant(atoms_.empty() ? shared::LIGHT_NODE_WIDTH : shared::LIGHT_NODE_WIDTH / 2);
        if (!atoms_.empty()) {
            fill(0, taken, measured(0, static_cast<std::uint32_t>(atoms_.size())));
        }
        while (!pending_.empty()) {
            const auto [node, group] = pending_.back();
            pending_.pop_back();
            fill(node, 0, group);
        }
        for (const std::uint32_t slot_above : nodes_) {
            packed_.light_places.push_back({slot_above, 1});
        }
    }

private:
    void find_atoms() {
        const std::size_t emitters = packed_.emissive_triangles.size();
        double total = 0;
        for (const double power : packed_.light_powers) {
            total += power;
        }
        const double any = 1 / static_cast<double>(packed_.light_powers.size());
        for (std::size_t light = 0; light < packed_.light_powers.size(); ++light) {
            if (is_distant(packed_, light)) {
                distant_.push_back(static_cast<std::uint32_t>(light));
                continue;
            }
            // Half by power and half alike: dim lamps, and those that are off, have a place too.
            const double share = (total > 0 ? packed_.light_powers[light] / total : 0) + any;
            const LightEmission own = emission_of(packed_, light);
            Atom atom{own.center, static_cast<float>(share), own.axis, 0, static_cast<std::uint32_t>(light), 1};
            if (light < emitters) {
                atom.area = 0.5F * packed_.emissive_triangles[light].double_area;
                if (light > 0 && !atoms_.empty() && completes(packed_.emissive_triangles[light - 1], light)) {
                    Atom& before = atoms_.back();
                    before.center = 0.5F * (before.center + atom.center);
                    before.weight += atom.weight;
                    before.area += atom.area;
                    before.count = 2;
                    continue;
                }
            }
            atoms_.push_back(atom);
        }
    }

    /// Whether the light is the other half of a flat quadrilateral whose first half is the atom last found.
    bool completes(const shared::EmissiveTriangle& half, std::size_t light) const {
        const shared::EmissiveTriangle& other = packed_.emissive_triangles[light];
        if (atoms_.back().first + 1 != light || atoms_.back().count != 1 || half.geometry != other.geometry ||
            !(glm::dot(half.front, other.front) > 0.999F)) {
            return false;
        }
        const auto corner = [](const shared::EmissiveTriangle& of, int i) {
            return of.vertex_0 + (i == 1 ? of.edge_1 : i == 2 ? of.edge_2 : glm::vec3(0));
        };
        int shared_corners = 0;
        for (int i = 0; i < 9; ++i) {
            const glm::vec3 apart = corner(half, i / 3) - corner(other, i % 3);
            shared_corners += glm::dot(apart, apart) <= 1e-8F * (half.double_area + other.double_area) ? 1 : 0;
        }
        return shared_corners == 2;
    }

    /// The group with its split: across the dimension along which atoms vary most, at their mean. The variance of a
    /// normal, at most 1, counts as half of that share of the variance of all centers.
    Branch measured(std::uint32_t begin, std::uint32_t end) const {
        Branch group;
        group.begin = begin;
        group.end = end;
        const glm::dvec3 origin(atoms_[begin].center);
        double weight = 0;
        double area = 0;
        std::array<double, 6> sum{};
        std::array<double, 6> squares{};
        for (std::uint32_t i = begin; i < end; ++i) {
            const Atom& atom = atoms_[i];
            const auto w = static_cast<double>(atom.weight);
            const glm::dvec3 c = glm::dvec3(atom.center) - origin;
            const glm::dvec3 n(atom.normal);
            weight += w;
            area += static_cast<double>(atom.area);
            group.lights += atom.count;
            for (int k = 0; k < 3; ++k) {
                sum[std::size_t(k)] += w * c[k];
                squares[std::size_t(k)] += w * c[k] * c[k];
                sum[std::size_t(k + 3)] += w * n[k];
                squares[std::size_t(k + 3)] += w * n[k] * n[k];
            }
        }
        std::array<double, 6> variance{};
        for (std::size_t k = 0; k < 6; ++k) {
            const double mean = sum[k] / weight;
            variance[k] = std::max(squares[k] / weight - mean * mean, 0.0);
        }
        const double size = variance[0] + variance[1] + variance[2];
        double most = -1;
        for (std::size_t k = 0; k < 6; ++k) {
            const double measure = k < 3 ? variance[k] : 0.5 * size * variance[k];
            if (measure > most) {
                most = measure;
                group.axis = static_cast<int>(k);
                group.middle = sum[k] / weight + (k < 3 ? origin[static_cast<int>(k)] : 0);
            }
        }
        group.error = weight * size * (1 + variance[3] + variance[4] + variance[5]);
        // A patch of one surface is a leaf; lights that stand apart are not.
        const bool few = group.lights <= packed_.light_powers.size() / many_lights && group.lights <= lights_a_patch;
        group.leaf = !group.splits() || few || (group.lights <= lights_a_patch && size <= 0.5 * area);
        return group;
    }

    std::pair<Branch, Branch> split(const Branch& group) {
        const auto first = atoms_.begin() + group.begin;
        const auto last = atoms_.begin() + group.end;
        const auto below = [&](const Atom& atom) {
            const float x = group.axis < 3 ? atom.center[group.axis] : atom.normal[group.axis - 3];
            return static_cast<double>(x) < group.middle;
        };
        auto middle = std::partition(first, last, below);
        if (middle == first || middle == last) {  // in one place, but for rounding
            middle = first + (last - first) / 2;
        }
        const auto at = static_cast<std::uint32_t>(middle - atoms_.begin());
        return {measured(group.begin, at), measured(at, group.end)};
    }

    /// Fills the node's children from `slot` on.
    void fill(std::size_t node, std::size_t slot, const Branch& all) {
        std::vector<Branch> groups = {all};
        while (groups.size() + slot < shared::LIGHT_NODE_WIDTH) {
            // What cannot be a leaf comes first, and then what varies most.
            const auto widest = std::max_element(groups.begin(), groups.end(), [](const Branch& a, const Branch& b) {
                return std::tuple(a.splits(), !a.leaf, a.error) < std::tuple(b.splits(), !b.leaf, b.error);
            });
            if (!widest->splits()) {
                break;
            }
            const auto [low, high] = split(*widest);
            *widest = low;
            groups.push_back(high);
        }
        for (const Branch& group : groups) {
            if (group.leaf) {
                begin_leaf(node, slot, group.lights);
                for (std::uint32_t i = group.begin; i < group.end; ++i) {
                    for (std::uint32_t k = 0; k < atoms_[i].count; ++k) {
                        add_light(atoms_[i].first + k, node, slot);
                    }
                }
                ++slot;
            } else {
                pending_.emplace_back(add_node(node, slot), group);
                ++slot;
            }
        }
    }

    /// Lights at infinity take at most so many of the root's children; those that do not fit are in a chain of nodes.
    std::size_t add_distant(std::size_t slots) {
        std::size_t taken = 0;
        std::size_t next = 0;
        for (std::size_t node = 0;; slots = shared::LIGHT_NODE_WIDTH) {
            const std::size_t left = distant_.size() - next;
            const bool fits = left <= slots;
            for (std::size_t slot = 0; slot < (fits ? left : slots - 1); ++slot) {
                begin_leaf(node, slot, 1);
                add_light(distant_[next++], node, slot);
            }
            taken = node == 0 ? std::min(left, slots) : taken;
            if (fits) {
                return taken;
            }
            node = add_node(node, slots - 1);
        }
    }

    void begin_leaf(std::size_t node, std::size_t slot, std::uint32_t size) {
        const auto first = static_cast<std::uint32_t>(packed_.tree_lights.size());
        packed_.light_nodes[node].child[slot] =
            shared::LIGHT_LEAF | ((size - 1) << shared::LIGHT_LEAF_SIZE_SHIFT) | first;
    }

    void add_light(std::uint32_t light, std::size_t node, std::size_t slot) {
        packed_.tree_lights.push_back(light);
        packed_.light_places[light].slot = static_cast<std::uint32_t>(node * shared::LIGHT_NODE_WIDTH + slot);
    }

    std::uint32_t add_node(std::size_t above, std::size_t slot) {
        const auto node = static_cast<std::uint32_t>(packed_.light_nodes.size());
        packed_.light_nodes.push_back({});
        packed_.light_nodes[above].child[slot] = node;
        nodes_.push_back(static_cast<std::uint32_t>(above * shared::LIGHT_NODE_WIDTH + slot));
        return node;
    }

    PackedScene& packed_;
    std::vector<Atom> atoms_;
    std::vector<std::uint32_t> distant_;
    std::vector<std::uint32_t> nodes_;  // the slot of each
    std::vector<std::pair<std::size_t, Branch>> pending_;
};

}  // namespace

void form_light_tree(PackedScene& packed) {
    TreeBuilder(packed).build();
}

}  // namespace diptych::core
