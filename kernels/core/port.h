// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The one place that knows whether kernels are compiled as OpenCL C 1.2 by a device or as C++ by
// the host compiler. Everything below looks the same to a kernel on both sides:
//
//   GLOBAL CONSTANT_TABLE VALUE_ARGUMENT KERNEL_ENTRY             address spaces and entry points
//   GLOBAL_ID WORK_ITEM(range)                                    indices of work-items
//   f3(x,y,z) f4(x,y,z,w)                                         constructors
//   as_bits(f) from_bits(u) square_root(f) absolute(f)            scalar built-ins
//   WFloat WMask (LANES rays), NFloat NMask (NODE_WIDTH children) wide values, touched only through
//   WIDE NODE SELECT VMIN VMAX mask_* wide_* node_*               these names
//   PREFETCH(p) lowest_bit(u) bit_count(u)                        hints and bits
//
// A mask is what a comparison of wide values yields: all bits set per true lane, but 1 for a
// scalar (LANES = 1). Only the mask_* functions and SELECT may interpret it.
#ifndef WEFT_KERNELS_CORE_PORT_H
#define WEFT_KERNELS_CORE_PORT_H

#ifndef LANES
#define LANES 8
#endif
#define NODE_WIDTH 8

#ifdef __cplusplus
#include "kernels/core/port_native.h"
#else
#include "kernels/core/port_opencl.h"
#endif

#define VMIN(a, b) SELECT((a) < (b), (a), (b))
#define VMAX(a, b) SELECT((a) > (b), (a), (b))

// A feature bit of the frame: a compile-time constant on OpenCL, a test of RenderParams natively.
// `p` is a pointer to RenderParams.
#ifdef WEFT_FEATURES
#define HAS(p, bit) (((uint)(WEFT_FEATURES) & (uint)(bit)) != 0u)
#else
#define HAS(p, bit) (((p)->features & (uint)(bit)) != 0u)
#endif

#endif
