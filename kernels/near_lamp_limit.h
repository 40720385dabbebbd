// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Which lamps near_lamp.h knows the irradiance of: those of few triangles, where every lamp has
// samples of its own.
#ifndef WEFT_NEAR_LAMP_LIMIT_H
#define WEFT_NEAR_LAMP_LIMIT_H

#include "port.h"
#include "types.h"

#define NEAR_LAMP_TRIANGLES 16u

static inline int has_closed_form(const Params* params, GLOBAL const LightRecord* lamp) {
    return params->samples_per_light > 0u && lamp->count <= NEAR_LAMP_TRIANGLES ? 1 : 0;
}

#endif
