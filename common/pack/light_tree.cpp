#include "pack/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>

#include "lights/light_tree.h"
#include "pack/alias_table_build.h"
#include "pack/pack_parts.h"

namespace diptych::core {
namespace {

constexpr std::size_t node_width = shared::LIGHT_NODE_WIDTH;

/// Of the extent of all lights: nearer than this to a light, it no longer matters how near.
constexpr double least_extent = 1e-6;

/// Least blur of a cosine at a light. It keeps lights in the tree whose plane a rounded position is just behind.
constexpr double least_blur = 1e-4;

/// Most of an environment's light that its estimate takes to come from one direction: the rest keeps it in the tree
/// wherever it may contribute.
constexpr double most_heading = 0.9;

double blur_of(const glm::dvec3& axis) {
    return std::max(0.25 * (1 - glm::dot(axis, axis)), least_blur);
}

/// light_weight's cosine at the light, twice, where that is `cosine` and nothing but the axes blurs it.
double lobe(double cosine, double blur) {
    return cosine + std::sqrt(cosine * cosine + blur);
}

LightEmission emission_of(const shared::EmissiveTriangle& light, double power) {
    const glm::dvec3 a(light.edge_1);
    const glm::dvec3 b(light.edge_2);
    const glm::dvec3 c = b - a;
    const bool two_sided = (light.flags & shared::EMITTER_TWO_SIDED) != 0;
    LightEmission out;
    out.weight = power / (two_sided ? 2 * std::numbers::pi : std::numbers::pi);
    out.center = glm::dvec3(light.vertex_0) + (a + b) / 3.0;
    out.spread = (glm::dot(a, a) + glm::dot(b, b) + glm::dot(c, c)) / 36;
    out.axis = light.front;
    out.front = two_sided ? 0 : 1;
    return out;
}

LightEmission emission_of(const shared::PunctualLight& light) {
    const double strength = luminance(glm::dvec3(light.intensity));
    LightEmission out;
    out.front = 1;
    out.center = light.type == shared::PUNCTUAL_DIRECTIONAL ? -light.direction : light.position;
    if (light.type == shared::PUNCTUAL_SPOT) {
        // A lobe about as wide as the cone: the mean of a cap's directions.
        const double cos_outer = -static_cast<double>(light.cone_offset) / static_cast<double>(light.cone_scale);
        out.axis = glm::dvec3(light.direction) * (0.5 + 0.5 * cos_outer);
    }
    out.weight = 2 * strength / lobe(glm::length(out.axis), blur_of(out.axis));
    return out;
}

/// Irradiance is pi L (1 + 2 m · n) to first order, where m is the mean direction of the light (Ramamoorthi and
/// Hanrahan 2001). The weight is such that the estimate's mean over all normals is right: pi L.
LightEmission emission_of_environment(const PackedScene& packed) {
    const glm::dvec3& m = packed.environment_heading;
    const double r_0 = static_cast<double>(packed.constants.environment.rotation.x);
    const double r_1 = static_cast<double>(packed.constants.environment.rotation.y);
    LightEmission out;
    out.center = 2.0 * glm::dvec3(r_0 * m.x + r_1 * m.z, m.y, r_0 * m.z - r_1 * m.x);
    const double length = glm::length(out.center);
    out.center *= length > most_heading ? most_heading / length : 1;
    out.spread = 1 - glm::dot(out.center, out.center);
    out.front = 1;
    const double blur = static_cast<double>(shared::LIGHT_TREE_BLUR) * out.spread;
    const double leaves = lobe(0, blur + blur_of(out.axis));
    double arrives = 0;
    constexpr int steps = 16;
    for (int i = 0; i < steps; ++i) {
        const double cosine = glm::length(out.center) * (2 * (i + 0.5) / steps - 1);
        arrives += lobe(cosine, blur + static_cast<double>(shared::LIGHT_TREE_HORIZON)) / steps;
    }
    out.weight = 4 * std::numbers::pi * packed.environment_luminance / (leaves * arrives);
    return out;
}

}  // namespace

/// Moments about a mean that moves along (West 1979). Normals of two-sided lights have no sign.
void LightEmission::add(const LightEmission& other) {
    if (!(other.weight > 0)) {
        return;
    }
    weight += other.weight;
    const double share = other.weight / weight;
    const glm::dvec3 step = other.center - center;
    spread += share * (other.spread - spread) + share * (1 - share) * glm::dot(step, step);
    center += share * step;
    const bool turned = front < 0.5 && other.front < 0.5 && glm::dot(axis, other.axis) < 0;
    axis += share * ((turned ? -other.axis : other.axis) - axis);
    front += share * (other.front - front);
}

LightEmission emission_of(const PackedScene& packed, std::size_t light) {
    if (light < packed.emissive_triangles.size()) {
        return emission_of(packed.emissive_triangles[light], packed.light_powers[light]);
    }
    return light < nearby_lights(packed) ? emission_of(packed.punctual_lights[light - packed.emissive_triangles.size()])
                                          : emission_of_environment(packed);
}

bool is_distant(const PackedScene& packed, std::size_t light) {
    return light >= nearby_lights(packed) ||
           (light >= packed.emissive_triangles.size() &&
            packed.punctual_lights[light - packed.emissive_triangles.size()].type == shared::PUNCTUAL_DIRECTIONAL);
}

namespace {

/// Nearer to a light than the root of this, it no longer matters how near.
double least_spread_of(const PackedScene& packed) {
    glm::dvec3 lo(1e300);
    glm::dvec3 hi(-1e300);
    for (std::size_t light = 0; light < nearby_lights(packed); ++light) {
        if (!is_distant(packed, light)) {
            const glm::dvec3 center = emission_of(packed, light).center;
            lo = glm::min(lo, center);
            hi = glm::max(hi, center);
        }
    }
    const glm::dvec3 extent = least_extent * (hi - lo);
    return hi.x < lo.x ? 1e-12 : std::max(glm::dot(extent, extent), 1e-30);
}

/// A leaf's lights together, with their alias table and their shares.
LightEmission weigh_leaf(PackedScene& packed, std::uint32_t child) {
    const std::size_t first = child & shared::LIGHT_LEAF_FIRST;
    const std::size_t size = shared::leaf_size(child);
    std::array<double, shared::MOST_LIGHTS_PER_LEAF> weights{};
    LightEmission whole;
    for (std::size_t i = 0; i < size; ++i) {
        const LightEmission own = emission_of(packed, packed.tree_lights[first + i]);
        weights[i] = own.weight;
        whole.add(own);
    }
    for (std::size_t i = 0; i < size; ++i) {
        const std::uint32_t light = packed.tree_lights[first + i];
        weights[i] = whole.weight > 0 ? weights[i] / whole.weight : 0;
        const auto share = static_cast<float>(weights[i]);
        packed.leaf_picks[first + i] = {1, light, share, light, share};
        packed.light_places[light].share = share;
    }
    if (size > 1 && whole.weight > 0) {
        const std::vector<shared::AliasEntry> table = build_alias_table(std::span(weights).first(size));
        for (std::size_t i = 0; i < size; ++i) {
            shared::LeafPick& pick = packed.leaf_picks[first + i];
            pick.probability = table[i].probability;
            pick.alias = packed.tree_lights[first + table[i].alias];
            pick.alias_share = packed.light_places[pick.alias].share;
        }
    }
    return whole;
}

/// `power` is over the largest of the node's children; what emits at all keeps some of it.
void write_child(const LightEmission& emission, bool distant, double power, double least, std::size_t i,
                 shared::LightNode& node) {
    node.center_x[i] = static_cast<float>(emission.center.x);
    node.center_y[i] = static_cast<float>(emission.center.y);
    node.center_z[i] = static_cast<float>(emission.center.z);
    node.place[i] = distant ? 0 : 1;
    node.spread[i] = static_cast<float>(std::max(emission.spread, distant ? 1e-12 : least));
    node.axis_x[i] = static_cast<float>(emission.axis.x);
    node.axis_y[i] = static_cast<float>(emission.axis.y);
    node.axis_z[i] = static_cast<float>(emission.axis.z);
    node.blur[i] = static_cast<float>(blur_of(emission.axis));
    node.front[i] = static_cast<float>(emission.front);
    node.power[i] = power > 0 ? static_cast<float>(std::max(power, 1e-30)) : 0;
}

}  // namespace

void weigh_light_tree(PackedScene& packed) {
    if (MUTANT(TREE_STAYS, false, !packed.leaf_picks.empty())) {
        return;
    }
    const std::size_t count = packed.light_nodes.size();
    const double least = count > 0 ? least_spread_of(packed) : 0;
    std::vector<LightEmission> emissions(count);
    std::vector<std::uint8_t> distant(count, 0);
    packed.leaf_picks.resize(packed.tree_lights.size());
    for (std::size_t k = count; k-- > 0;) {  // children come after their parents
        shared::LightNode& node = packed.light_nodes[k];
        std::array<LightEmission, node_width> children{};
        std::array<bool, node_width> far{};
        double most = 0;
        for (std::size_t i = 0; i < node_width; ++i) {
            const std::uint32_t child = node.child[i];
            if ((child & shared::LIGHT_LEAF) != 0) {
                children[i] = weigh_leaf(packed, child);
                far[i] = is_distant(packed, packed.tree_lights[child & shared::LIGHT_LEAF_FIRST]);
            } else if (child != 0) {
                children[i] = emissions[child];
                far[i] = distant[child] != 0;
            }
            most = std::max(most, children[i].weight);
        }
        for (std::size_t i = 0; i < node_width; ++i) {
            write_child(children[i], far[i], most > 0 ? children[i].weight / most : 0, least, i, node);
            emissions[k].add(children[i]);
        }
        distant[k] = far[0] ? 1 : 0;
    }
}

void choose_light_sampler(LightSampler wanted, PackedScene& packed) {
    const bool had = !packed.light_nodes.empty();
    if (wanted != LightSampler::spatial) {
        packed.light_nodes.clear();
        packed.light_places.clear();
        packed.leaf_picks.clear();
        packed.tree_lights.clear();
        packed.tree_was_sought = false;
    } else if (!packed.tree_was_sought) {
        packed.tree_was_sought = true;
        form_light_tree(packed);
        weigh_light_tree(packed);
    }
    const bool has = !packed.light_nodes.empty();
    if (has != had) {
        packed.revisions.light_nodes = new_revision();
        packed.revisions.light_places = new_revision();
        packed.revisions.leaf_picks = new_revision();
    }
    const bool falls_back = wanted == LightSampler::spatial && !has;
    packed.constants.light_sampler = static_cast<std::uint32_t>(falls_back ? LightSampler::power : wanted);
    const bool generic = packed.features == ~0U;
    packed.features |= has ? shared::FEATURE_LIGHT_TREE : 0U;
    packed.features &= has || generic ? ~0U : ~shared::FEATURE_LIGHT_TREE;
}

}  // namespace diptych::core
