// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// De-interleaves the G-buffer: copies what a pixel needs for shadow rays to its slot of the work
// list, where the pixels of a sample set follow one another. Receivers are planes of `slots`
// floats, each of which a packet loads with one wide read. One work-item per slot.
#include "kernels/bvh/triangle.h"
#include "kernels/core/kernel.h"
#include "kernels/core/receivers.h"
#include "kernels/film/gbuffer.h"
#include "kernels/film/seen_receiver.h"

WEFT_KERNEL(receivers)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint slot = range.first + WORK_ITEM(range);
    uint pixel = slot_pixel[slot];
    float3 nowhere = f3(0.0f, 0.0f, 0.0f);
    SeenReceiver seen = {nowhere, nowhere, nowhere, 0.0f};
    uint enclosing_media = 0u;
    if (pixel != INVALID_INDEX) {
        pixel_slot[pixel] = slot;
        seen = seen_receiver(&params, gb_ids, gb_position, gb_normal, gb_shading, gb_albedo, pixel);
        if (HAS(&params, FEATURE_MEDIA)) enclosing_media = view_enclosing_media[pixel];
    }
    GLOBAL float* plane = receiver_planes + slot;
    uint stride = slots;
    plane[RECEIVER_X * stride] = seen.position.x;
    plane[RECEIVER_Y * stride] = seen.position.y;
    plane[RECEIVER_Z * stride] = seen.position.z;
    plane[RECEIVER_SHADING_X * stride] = seen.shading.x;
    plane[RECEIVER_SHADING_Y * stride] = seen.shading.y;
    plane[RECEIVER_SHADING_Z * stride] = seen.shading.z;
    plane[RECEIVER_VALID * stride] = seen.valid;
    if (HAS(&params, FEATURE_SMOOTH_NORMALS)) {
        plane[RECEIVER_NORMAL_X * stride] = seen.normal.x;
        plane[RECEIVER_NORMAL_Y * stride] = seen.normal.y;
        plane[RECEIVER_NORMAL_Z * stride] = seen.normal.z;
    }
    if (HAS(&params, FEATURE_MEDIA))
        plane[RECEIVER_ENCLOSING_MEDIA * stride] = from_bits(enclosing_media);
}
