// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Which solid dielectrics a path is inside of. They are numbered so that of several that lie
// within each other the first counts; a path stores up to four of those that are around it, a
// fifth is ignored. The surface of one that is inside of another that counts more is not there:
// glasses and the liquid in them may overlap (Schmidt and Budge 2002).
//
// Where rays start on a surface, rounding decides whether they have crossed it; so the side from
// which one is met corrects the set, as in medium_walk.h.
#ifndef WEFT_KERNELS_PATH_INTERFACES_H
#define WEFT_KERNELS_PATH_INTERFACES_H

#include "kernels/core/port.h"
#include "kernels/core/types.h"

#define NO_INTERFACE 0xFFFFu
#define INTERFACES_HELD 4

// Numbers in ascending order, then NO_INTERFACE.
typedef struct {
    uint number[INTERFACES_HELD];
} InterfaceSet;

static inline InterfaceSet no_interfaces(void) {
    InterfaceSet none;
    for (int i = 0; i < INTERFACES_HELD; ++i) none.number[i] = NO_INTERFACE;
    return none;
}

/// Without one of them.
static inline InterfaceSet leave_interface(InterfaceSet around, uint number) {
    InterfaceSet left = no_interfaces();
    int count = 0;
    for (int i = 0; i < INTERFACES_HELD; ++i)
        if (around.number[i] != number) left.number[count++] = around.number[i];
    return left;
}

/// With one more, which may be among them already.
static inline InterfaceSet enter_interface(InterfaceSet around, uint number) {
    InterfaceSet others = leave_interface(around, number);
    InterfaceSet all = no_interfaces();
    int at = 0;
    int held = 0;
    for (int i = 0; i < INTERFACES_HELD; ++i) {
        if (held == 0 && number < others.number[at]) {
            all.number[i] = number;
            held = 1;
        } else {
            all.number[i] = others.number[at++];
        }
    }
    return all;
}

/// Index of refraction of the interface that counts; 1 outside of all. Indices that are given
/// relative to what lies around an interface are multiplied from the outermost on.
static inline float index_within(GLOBAL const InterfaceRecord* interfaces, InterfaceSet around) {
    float index = 1.0f;
    for (int i = 0; i < INTERFACES_HELD && around.number[i] != NO_INTERFACE; ++i) {
        index *= interfaces[around.number[i]].index;
        if (interfaces[around.number[i]].is_local == 0u) break;
    }
    return index;
}

/// Its absorption.
static inline float3 absorption_within(GLOBAL const InterfaceRecord* interfaces,
                                       InterfaceSet around) {
    if (around.number[0] == NO_INTERFACE) return f3(0.0f, 0.0f, 0.0f);
    return xyz(interfaces[around.number[0]].sigma_a);
}

#endif
