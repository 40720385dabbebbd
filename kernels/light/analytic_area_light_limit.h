// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Tells which area lights analytic_area_light.h uses the closed form for: flat panels of few
// triangles, which have an axis (host/scene/area_light_bounds.h), where every area light has
// samples of its own. No part of a panel hides another, and its samples tell how much of all of it
// is hidden; those of several panels, or of a box with its far side, would not.
#ifndef WEFT_KERNELS_LIGHT_ANALYTIC_AREA_LIGHT_LIMIT_H
#define WEFT_KERNELS_LIGHT_ANALYTIC_AREA_LIGHT_LIMIT_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"

static inline int has_closed_form(const RenderParams* params,
                                  GLOBAL const LightRecord* area_light) {
    float4 axis = area_light->axis;
    int flat = axis.x != 0.0f || axis.y != 0.0f || axis.z != 0.0f ? 1 : 0;
    return flat != 0 && params->sampling.lights.per_light > 0u ? 1 : 0;
}

#endif
