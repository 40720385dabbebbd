// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Defines kernels by their signatures: after WEFT_KERNEL(name) follows the body, which has
// `params`, `range` and the arguments of ARGUMENTS_<name> (signatures.h) by their names.
#ifndef WEFT_KERNELS_CORE_KERNEL_H
#define WEFT_KERNELS_CORE_KERNEL_H

#include "kernels/core/port.h"
#include "kernels/core/signatures.h"
#include "kernels/core/types.h"

#define WEFT_BUFFER(kind, element) typedef element kind;
#include "kernels/core/buffers.def"
#undef WEFT_BUFFER

/// The arguments of a kernel, in their order.
#define WEFT_KERNEL_ARGUMENTS(name)      \
    VALUE_ARGUMENT(RenderParams, params) \
    , VALUE_ARGUMENT(LaunchRange, range) ARGUMENTS_##name(KERNEL_ARGUMENT)

#define WEFT_KERNEL(name) KERNEL_ENTRY void name(WEFT_KERNEL_ARGUMENTS(name))

#define KERNEL_ARGUMENT(mode, kind, name) KERNEL_##mode(kind, name)
#define KERNEL_READS(kind, name) , GLOBAL const kind* name
#define KERNEL_WRITES(kind, name) , GLOBAL kind* name
#define KERNEL_MAY_READ(kind, name) KERNEL_READS(kind, name)
#define KERNEL_MAY_WRITE(kind, name) KERNEL_WRITES(kind, name)
#define KERNEL_VALUE(type, name) , VALUE_ARGUMENT(type, name)
#define KERNEL_TRACES(kind, name) , SCENE_ARGUMENTS
#define KERNEL_GROUP(group, name) GROUP_##group(KERNEL_MEMBER)
#define KERNEL_MEMBER(mode, kind, name) KERNEL_##mode(kind, name)

#endif
