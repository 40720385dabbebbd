// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BVH_EMBREE_H
#define WEFT_BVH_EMBREE_H

/// The Embree that the build found: Debian 12 packages version 3, Debian 13 version 4.
#if WEFT_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#endif
