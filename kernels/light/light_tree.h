// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Chooses a light for next-event estimation at a point of a surface, by what each would bring there
// if nothing lay between (light trees after Conty Estevez and Kulla 2018; here with up to
// LIGHT_CHILDREN children). Lights in scenes with more of them are leaves of a tree, whose inner
// nodes stand for all lights below. The host builds it (host/scene/light_tree.h).
//
// A node that can bring anything is chosen with a probability above 0: a part of it is the same for
// all such nodes, since a light that seems bright may be hidden behind a wall.
#ifndef WEFT_KERNELS_LIGHT_LIGHT_TREE_H
#define WEFT_KERNELS_LIGHT_LIGHT_TREE_H

#include "kernels/light/light_sample.h"

// Part of the probability that goes to all useful nodes alike. In three scenes 0.05 has 2 % less
// variance than 0.1, 0.2 has 3 % more and 0.4 14 % (docs/results/algorithms.md); the larger it is,
// the less is lost where the brightest light is hidden.
#define LIGHT_EQUAL_SHARE 0.1f

// Least share of its mean irradiance that light from all around is taken to bring to a surface.
// What it brings by its first moment may be none at all, or less, behind a single bright texel.
#define LEAST_FROM_AROUND 0.0625f

// What some nodes of the tree would bring to a point.
typedef struct {
    float importance[LIGHT_CHILDREN];  // below 0: nothing at all
    float sum;                         // of those above 0
    float useful;                      // how many are not below 0
} LightImportances;

/// Irradiance that a node would bring to a surface at most, if nothing lay between, in the unit of
/// LightNode::intensity; below 0 where it brings nothing. `least` is the square of the distance
/// below which lights are not taken to be, above 0.
static inline float light_importance(const LightNode* node, const LitPoint* lit, float least) {
    float3 axis = xyz(node->axis);
    if (node->shape == LIGHT_ALL_AROUND)
        return node->intensity * (lit->any_side != 0
                                      ? 1.0f
                                      : m_max(1.0f + dot3(lit->shading, axis), LEAST_FROM_AROUND));
    if (node->shape == LIGHT_DISTANT || node->shape == LIGHT_ALL_DISTANT) {
        float cosine =
            node->shape == LIGHT_DISTANT && lit->any_side == 0 ? -dot3(lit->shading, axis) : 1.0f;
        return cosine > 0.0f ? node->intensity * cosine : -1.0f;
    }
    float3 towards = xyz(node->position) - lit->position;
    float radius = node->position.w;
    float square = dot3(towards, towards);
    float nearest = m_max(m_max(square, radius * radius), least);
    float inverse = 1.0f / square_root(nearest);
    float above =
        lit->any_side != 0 ? square_root(square) + radius : dot3(lit->shading, towards) + radius;
    float leaves = 1.0f;
    if (node->shape == LIGHT_PANEL)
        leaves = (node->axis.w - dot3(axis, towards)) * inverse;
    else if (node->shape == LIGHT_TWO_SIDED_PANEL)
        leaves = absolute(dot3(axis, towards)) * inverse;
    else if (node->shape == LIGHT_SPOT && -dot3(axis, towards) < node->axis.w * square_root(square))
        leaves = 0.0f;
    if (!(above > 0.0f && leaves > 0.0f)) return -1.0f;
    return node->intensity * m_min(above * inverse, 1.0f) * m_min(leaves, 1.0f) *
           (inverse * inverse);
}

/// The importances of nodes [first, first + count), of which there are LIGHT_CHILDREN at most.
static inline LightImportances light_importances(GLOBAL const LightNode* nodes, uint first,
                                                 uint count, const LitPoint* lit, float least) {
    LightImportances found;
    found.sum = 0.0f;
    found.useful = 0.0f;
    for (uint i = 0u; i < count; ++i) {
        LightNode node = nodes[first + i];
        found.importance[i] = light_importance(&node, lit, least);
        if (found.importance[i] < 0.0f) continue;
        found.sum += found.importance[i];
        found.useful += 1.0f;
    }
    return found;
}

/// Probability of choosing node `i` among these; 0 where it brings nothing.
static inline float share_of_node(const LightImportances* found, uint i) {
    if (found->importance[i] < 0.0f) return 0.0f;
    float equal = 1.0f / found->useful;
    // Where importances tell nothing, all goes alike.
    if (!(found->sum > 0.0f && found->sum < RAY_INFINITY)) return equal;
    return LIGHT_EQUAL_SHARE * equal +
           (1.0f - LIGHT_EQUAL_SHARE) * (found->importance[i] / found->sum);
}

static inline float least_light_distance_squared(const RenderParams* params) {
    float least = params->scene.extent * 9.5367432e-7f;  // 2^-20
    return least * least;
}

/// Chooses a light for a point by the random number `u`. `*probability` receives that of the
/// choice, which is 0 where no light brings anything.
static inline uint choose_light_at(const RenderParams* params, GLOBAL const LightNode* nodes,
                                   const LitPoint* lit, float u, float* probability) {
    float least = least_light_distance_squared(params);
    uint first = nodes[0].first;
    uint count = nodes[0].count;
    *probability = 1.0f;
    while (count != 0u) {
        LightImportances found = light_importances(nodes, first, count, lit, least);
        float before = 0.0f;
        float share = 0.0f;
        uint chosen = 0u;
        for (uint i = 0u; i < count; ++i) {
            float own = share_of_node(&found, i);
            if (!(own > 0.0f)) continue;
            // The last useful one takes what rounding leaves.
            if (share > 0.0f && u < before + share) break;
            before += share;
            share = own;
            chosen = i;
        }
        *probability *= share;
        if (!(share > 0.0f)) return 0u;
        u = rescale_number(u, before, share);
        LightNode node = nodes[first + chosen];
        first = node.first;
        count = node.count;
    }
    return first;
}

/// Probability with which choose_light_at chooses the light of node `leaf` at a point.
static inline float light_probability_at(const RenderParams* params, GLOBAL const LightNode* nodes,
                                         const LitPoint* lit, uint leaf) {
    float least = least_light_distance_squared(params);
    float probability = 1.0f;
    while (leaf != 0u && probability > 0.0f) {
        uint parent = nodes[leaf].parent;
        uint first = nodes[parent].first;
        LightImportances found = light_importances(nodes, first, nodes[parent].count, lit, least);
        probability *= share_of_node(&found, leaf - first);
        leaf = parent;
    }
    return probability;
}

#endif
