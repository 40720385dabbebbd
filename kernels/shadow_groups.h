// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Area lights in groups: light l of n, and its samples, belong to group l g / n of g.
#ifndef WEFT_SHADOW_GROUPS_H
#define WEFT_SHADOW_GROUPS_H

#include "port.h"
#include "types.h"

/// First light of a group; that of the group after the last is the number of lights.
static inline uint shadow_group_light(const Params* params, uint group) {
    uint lights = params->sampled_lights;
    return (group * lights + params->shadow_groups - 1u) / params->shadow_groups;
}

/// First sample of a group within a set; after the last group the number of samples.
static inline uint shadow_group_start(const Params* params, uint group) {
    if (params->shadow_groups == 1u) return group * params->samples_per_set;
    return shadow_group_light(params, group) * params->samples_per_light;
}

#endif
