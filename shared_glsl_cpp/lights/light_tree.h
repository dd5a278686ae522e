// The light tree: a hierarchy of lights with eight children a node (after Conty Estevez and Kulla 2018). A vertex walks
// it from the root and picks a child at every node, in proportion to an estimate of the irradiance that the child's
// lights cause there. All estimates are positive, so every light that may contribute can be picked.
#ifndef LIGHT_TREE_H
#define LIGHT_TREE_H

#include "numbers/rng.h"
#include "numbers/elementary.h"
#include "language/scene_types.h"

SHARED_BEGIN

/// Share of a child's spread that blurs the cosines at the surface and at the lights: their positions differ.
CONST float LIGHT_TREE_BLUR = 0.5f;
/// Least blur of a cosine at the surface. It keeps lights in the tree that stand below the shading normal's horizon,
/// but above the triangle's.
CONST float LIGHT_TREE_HORIZON = 0.01f;

/// A direction in 30 bits. Rounding it is harmless because picking and its pdf use the same rounded direction.
FN uint pack_facing(vec3 normal) {
    uint x = uint(int(floor(normal.x * 511.0f + 0.5f)) & 1023);
    uint y = uint(int(floor(normal.y * 511.0f + 0.5f)) & 1023);
    uint z = uint(int(floor(normal.z * 511.0f + 0.5f)) & 1023);
    return x | (y << 10) | (z << 20);
}

FN float facing_component(uint bits, uint shift) {
    return float((int(bits << (22u - shift))) >> 22) * (1.0f / 511.0f);
}

/// Nearly unit.
FN vec3 unpack_facing(uint bits) {
    return vec3(facing_component(bits, 0u), facing_component(bits, 10u), facing_component(bits, 20u));
}

/// The weights of a node's children at a point, with sums over pairs, over halves and over all of them.
struct LightWeights {
    float of[8];
    float pair_0;
    float pair_1;
    float pair_2;
    float pair_3;
    float half_0;
    float half_1;
    float total;
};

FN void sum_weights(INOUT(LightWeights) w) {
    PRECISE float pair_0 = w.of[0] + w.of[1];
    PRECISE float pair_1 = w.of[2] + w.of[3];
    PRECISE float pair_2 = w.of[4] + w.of[5];
    PRECISE float pair_3 = w.of[6] + w.of[7];
    PRECISE float half_0 = pair_0 + pair_1;
    PRECISE float half_1 = pair_2 + pair_3;
    PRECISE float total = half_0 + half_1;
    w.pair_0 = pair_0;
    w.pair_1 = pair_1;
    w.pair_2 = pair_2;
    w.pair_3 = pair_3;
    w.half_0 = half_0;
    w.half_1 = half_1;
    w.total = total;
}

/// Four times the estimated irradiance from child i. With d from the point to the child's center, D = d² + spread and
/// b = BLUR spread / D, a cosine c becomes (c + sqrt(c² + b)) / 2, a smooth max(c, 0).
FN float light_weight(IN(LightNode) node, uint i, vec3 position, vec3 normal) {
    float place = node.place[i];
    PRECISE float x = node.center_x[i] - place * position.x;
    PRECISE float y = node.center_y[i] - place * position.y;
    PRECISE float z = node.center_z[i] - place * position.z;
    float spread = node.spread[i];
    PRECISE float inverse = 1.0f / sqrt(x * x + y * y + z * z + spread);
    PRECISE float inverse_square = inverse * inverse;
    PRECISE float blur = LIGHT_TREE_BLUR * MUTANT(TREE_SPREAD_LEFT_OUT, spread, 0.0f) * inverse_square;
    PRECISE float at_surface = (x * normal.x + y * normal.y + z * normal.z) * inverse;
    PRECISE float at_light = -(x * node.axis_x[i] + y * node.axis_y[i] + z * node.axis_z[i]) * inverse;
    float front = node.front[i];
    PRECISE float arrives = at_surface + sqrt(at_surface * at_surface + blur + LIGHT_TREE_HORIZON);
    PRECISE float leaves =
        front * at_light + (2.0f - front) * sqrt(at_light * at_light + blur + node.blur[i]);
    PRECISE float weight = node.power[i] * arrives * leaves * inverse_square;
    return weight;
}

FN LightWeights light_weights(IN(LightNode) node, vec3 position, vec3 normal) {
    LightWeights weights;
    for (uint i = 0u; i < LIGHT_NODE_WIDTH; i++) {
        weights.of[i] = light_weight(node, i, position, normal);
    }
    sum_weights(weights);
    if (!(weights.total > 0.0f && weights.total < INFINITE_DISTANCE)) {  // beyond fp32: by power
        for (uint i = 0u; i < LIGHT_NODE_WIDTH; i++) {
            weights.of[i] = node.power[i];
        }
        sum_weights(weights);
    }
    return weights;
}

/// A random number that several choices share, one after another. Each choice stretches the interval that it took to
/// [0, 1), and fills the bits that this lacks from `more`.
struct SharedNumber {
    float u;    // in [0, 1)
    uint more;  // state of a linear congruential generator
};

FN SharedNumber share_number(uvec2 words) {
    SharedNumber n;
    n.u = unit_float(words.x);
    n.more = words.y;
    return n;
}

/// Goes on within the interval of that width, of [0, whole), that begins `x` before the number.
FN void stretch(INOUT(SharedNumber) n, float x, float width, float whole) {
    n.more = n.more * 747796405u + 2891336453u;
    PRECISE float fill = unit_float(n.more) * (whole * (1.0f / 16777216.0f));
    n.u = clamp((x + fill) / width, 0.0f, 0.99999994f);
}

/// A node's child, and its probability among the node's children.
struct PickedChild {
    uint link;  // LightNode::child
    float probability;
};

/// Picks a child; weights.total must be positive. A search of three steps, which never picks a child of weight 0. By
/// selections, because a GPU keeps no array in registers whose index varies.
FN PickedChild pick_child(IN(LightNode) node, IN(LightWeights) w, INOUT(SharedNumber) n) {
    PRECISE float x = n.u * w.total;
    bool right = w.half_1 > 0.0f && x >= w.half_0;
    x = x - (right ? w.half_0 : 0.0f);
    float first = right ? w.pair_2 : w.pair_0;
    float second = right ? w.pair_3 : w.pair_1;
    bool later = second > 0.0f && x >= first;
    x = x - (later ? first : 0.0f);
    float even_left = later ? w.of[2] : w.of[0];
    float odd_left = later ? w.of[3] : w.of[1];
    float even_right = later ? w.of[6] : w.of[4];
    float odd_right = later ? w.of[7] : w.of[5];
    float even = right ? even_right : even_left;
    float odd = right ? odd_right : odd_left;
    bool last = odd > 0.0f && x >= even;
    x = x - (last ? even : 0.0f);
    float width = last ? odd : even;
    uint link_0 = last ? node.child[1] : node.child[0];
    uint link_2 = last ? node.child[3] : node.child[2];
    uint link_4 = last ? node.child[5] : node.child[4];
    uint link_6 = last ? node.child[7] : node.child[6];
    uint link_left = later ? link_2 : link_0;
    uint link_right = later ? link_6 : link_4;
    PickedChild picked;
    picked.link = right ? link_right : link_left;
    picked.probability = width / w.total;
    stretch(n, x, width, w.total);
    return picked;
}

/// Probability of child `own` among the children of its node.
FN float child_probability(IN(LightWeights) weights, uint own) {
    float weight = 0.0f;
    for (uint i = 0u; i < LIGHT_NODE_WIDTH; i++) {
        weight = i == own ? weights.of[i] : weight;
    }
    return weight / weights.total;
}

FN uint leaf_size(uint child) { return ((child >> LIGHT_LEAF_SIZE_SHIFT) & (MOST_LIGHTS_PER_LEAF - 1u)) + 1u; }

/// Picks a column of a leaf's alias table. n.u then decides between the column's two lights.
FN uint pick_leaf_column(uint size, INOUT(SharedNumber) n) {
    PRECISE float x = n.u * float(size);
    uint column = min(uint(x), size - 1u);
    stretch(n, x - float(column), 1.0f, float(size));
    return column;
}

SHARED_END

#endif
