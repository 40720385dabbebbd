// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Which shafts of a buffer are proven to be open, for tests. A record is 6 values: the lower and
// upper corner of the receivers' box and of the light's, then the planes of both (xyz unit normal
// into the shaft, or 0 for none; w offset). The answer is 1 for open shafts, else 0.
#include "shaft.h"

#define SHAFT_RECORD 6

WEFT_KERNEL(query_shaft)
(PARAMS, SCENE_ARGS, GLOBAL const float4* records, GLOBAL uint* open) {
    if (GLOBAL_ID >= params.count) return;
    uint item = params.first + GLOBAL_ID;
    SCENE_MAKE(scene);
    GLOBAL const float4* record = records + SHAFT_RECORD * item;
    Shaft shaft;
    int possible = make_shaft(xyz(record[0]), xyz(record[1]), xyz(record[2]), xyz(record[3]),
                              record[4], record[5], params.extent, &shaft);
    open[item] = possible != 0 && shaft_is_open(scene, &shaft) != 0 ? 1u : 0u;
}
