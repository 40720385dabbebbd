// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// De-interleaves the G-buffer: copies what a pixel needs for shadow rays to its slot of the work
// list, where the pixels of a sample set follow one another. Receivers are planes of `slots`
// floats, each of which a packet loads with one wide read. One work-item per slot.
#include "kernels/bvh/triangle.h"
#include "kernels/core/kernel.h"
#include "kernels/core/offset.h"
#include "kernels/core/receivers.h"
#include "kernels/film/gbuffer.h"

WEFT_KERNEL(receivers)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = range.first + WORK_ITEM(range);
    uint pixel = slot_pixel[slot];
    float valid = 0.0f;
    float3 position = f3(0.0f, 0.0f, 0.0f);
    float3 normal = position;
    float3 shading = position;
    uint enclosing_media = 0u;
    if (pixel != INVALID_INDEX) {
        pixel_slot[pixel] = slot;
        valid = gb_ids[2u * pixel] != INVALID_INDEX ? gb_albedo[pixel].w : 0.0f;
        normal = xyz(gb_normal[pixel]);
        shading = xyz(gb_shading[pixel]);
        position = xyz(gb_position[pixel]);
        position += normal * surface_offset(position, params.scene.extent);
        if (HAS(&params, FEATURE_MEDIA)) enclosing_media = view_enclosing_media[pixel];
    }
    GLOBAL float* plane = receiver_planes + slot;
    uint stride = slots;
    plane[RECEIVER_X * stride] = position.x;
    plane[RECEIVER_Y * stride] = position.y;
    plane[RECEIVER_Z * stride] = position.z;
    plane[RECEIVER_SHADING_X * stride] = shading.x;
    plane[RECEIVER_SHADING_Y * stride] = shading.y;
    plane[RECEIVER_SHADING_Z * stride] = shading.z;
    plane[RECEIVER_VALID * stride] = valid;
    if (HAS(&params, FEATURE_SMOOTH_NORMALS)) {
        plane[RECEIVER_NORMAL_X * stride] = normal.x;
        plane[RECEIVER_NORMAL_Y * stride] = normal.y;
        plane[RECEIVER_NORMAL_Z * stride] = normal.z;
    }
    if (HAS(&params, FEATURE_MEDIA))
        plane[RECEIVER_ENCLOSING_MEDIA * stride] = from_bits(enclosing_media);
}
