// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SHARED_SHARED_TYPES_H
#define WEFT_SHARED_SHARED_TYPES_H

#include <cstddef>

/// The structs of kernels/core/types.h, and kernels/adaptive/shadow_layout.h, as the host sees
/// them.
namespace weft::shared {

using uint = unsigned int;
struct alignas(16) float4 {
    float x, y, z, w;
};

#include "kernels/core/types.h"
// This one needs no type but uint.
#include "kernels/adaptive/shadow_layout.h"

static_assert(sizeof(BvhNode) == 256);
static_assert(sizeof(Triangle) == 16);
static_assert(sizeof(InstanceRecord) == 16);
static_assert(sizeof(MaterialRecord) == 64);
static_assert(sizeof(TextureRecord) == 16);
static_assert(sizeof(LightRecord) == 112);
static_assert(sizeof(LightNode) == 64);
static_assert(sizeof(EmissiveTriangle) == 16);
static_assert(sizeof(LightNode) == 64);
static_assert(sizeof(SurfaceMap) == 48);
static_assert(sizeof(SurfaceRecord) == 144);
static_assert(sizeof(InterfaceRecord) == 32);
static_assert(sizeof(Vpl) == 64);
static_assert(sizeof(EnvironmentRecord) == 80);
static_assert(sizeof(DensityGridRecord) == 96);
static_assert(sizeof(MediumRecord) == 64);
static_assert(sizeof(MediaRecord) == 1280);
static_assert(sizeof(CacheRecord) == 192);
static_assert(sizeof(TileRecord) == 32);
static_assert(sizeof(RayCounter) == 16);
static_assert(sizeof(NonfiniteCounter) == 72);
static_assert(sizeof(CameraParams) == 96);
static_assert(sizeof(SceneParams) == 80);
static_assert(sizeof(LightSampling) == 16);
static_assert(sizeof(SamplingParams) == 144);
static_assert(sizeof(FilterParams) == 16);
static_assert(sizeof(RenderParams) == 352);
static_assert(sizeof(LaunchRange) == 16);
static_assert(sizeof(SetList) == 12);
static_assert(sizeof(HemisphereGrid) == 12);
static_assert(sizeof(RecordUpdate) == 16);
static_assert(sizeof(PathParams) == 12);

}  // namespace weft::shared

#endif
