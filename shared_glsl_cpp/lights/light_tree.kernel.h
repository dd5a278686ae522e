// Picks lights from the light tree (light_tree.h), and tells the probability of each pick.
#ifndef LIGHT_TREE_KERNEL_H
#define LIGHT_TREE_KERNEL_H

#include "leaves.h"

/// Picks a light at `reference`. light_count must be positive. `words` are two random words.
FN LightPick pick_from_tree(vec3 reference, uint facing, uvec2 words) {
    vec3 normal = unpack_facing(facing);
    SharedNumber n = share_number(words);
    LightPick pick;
    pick.pmf = 1.0f;
    uint child = 0u;
    while ((child & LIGHT_LEAF) == 0u) {
        LOCAL(LightNode) node = load_light_nodes(child);
        LightWeights weights = light_weights(node, reference, normal);
        PickedChild picked = pick_child(node, weights, n);
        pick.pmf = MUTANT(TREE_PMF_OF_ROOT, pick.pmf * picked.probability, child == 0u ? picked.probability : pick.pmf);
        child = picked.link;
    }
    uint column = pick_leaf_column(leaf_size(child), n);
    LOCAL(LeafPick) entry = load_leaf_picks((child & LIGHT_LEAF_FIRST) + column);
    bool keeps = n.u < entry.probability;
    pick.id = keeps ? entry.light : entry.alias;
    pick.pmf = pick.pmf * (keeps ? entry.light_share : entry.alias_share);
    return pick;
}

/// Index of a node's place among light_places: after those of the lights.
FN uint node_place(uint node) { return constants.emissive_triangle_count + constants.punctual_light_count + 1u + node; }

/// Probability with which pick_from_tree picks the light at `reference`.
FN float probability_from_tree(uint id, vec3 reference, uint facing) {
    vec3 normal = unpack_facing(facing);
    LightPlace place = load_light_places(id);
    float probability = place.share;
    while (place.slot != NONE && probability > 0.0f) {
        uint above = place.slot / LIGHT_NODE_WIDTH;
        LOCAL(LightNode) node = load_light_nodes(above);
        LightWeights weights = light_weights(node, reference, normal);
        probability = probability * child_probability(weights, place.slot % LIGHT_NODE_WIDTH);
        place = load_light_places(node_place(above));
    }
    return probability;
}

#endif
