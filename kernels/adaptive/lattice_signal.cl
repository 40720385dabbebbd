// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Computes what the level scheduler judges an undersampled component by, at every lattice point
// that has a sample: the luminances of its irradiance, of the reflectance that it is seen with and
// of the other light there, and which of its eight lattice neighbours lie on its surface and have
// samples. Other light is emission and, with `beneath_slots`, what the surface sends that the
// component's light is seen on top of. One work-item per lattice point of stride `lattice_stride`
// writes 4 floats; the last holds the neighbours as bits, row by row from the upper left, and
// LATTICE_SAMPLED where the point has a sample.
#include "kernels/adaptive/lattice.h"
#include "kernels/bsdf/lambert.h"
#include "kernels/core/kernel.h"
#include "kernels/film/discontinuity.h"

WEFT_KERNEL(lattice_signal)
{
    if (WORK_ITEM(range) >= range.count) return;
    uint point = range.first + WORK_ITEM(range);
    int stride = (int)lattice_stride;
    int width = (int)params.camera.width;
    int height = (int)params.camera.height;
    int columns = lattice_size(width, stride);
    int x = (int)point % columns * stride;
    int y = (int)point / columns * stride;
    uint pixel = (uint)(y * width + x);
    signal[point] = f4(0.0f, 0.0f, 0.0f, 0.0f);
    if (pixel_is_lit(gb_ids, gb_albedo, pixel) == 0) return;
    uint slot = pixel_slot[pixel];
    if (slot == INVALID_INDEX) return;
    PixelSurface surface = pixel_surface(&params, gb_position, gb_normal, gb_shading, pixel, 1.0f);
    uint bits = LATTICE_SAMPLED;
    uint bit = 1u;
    for (int j = -1; j <= 1; ++j) {
        for (int i = -1; i <= 1; ++i) {
            if (i == 0 && j == 0) continue;
            int column = x + i * stride;
            int row = y + j * stride;
            if (column >= 0 && column < width && row >= 0 && row < height) {
                uint other = (uint)(row * width + column);
                if (pixel_is_lit(gb_ids, gb_albedo, other) != 0 &&
                    pixel_slot[other] != INVALID_INDEX &&
                    on_surface(&surface, gb_position, gb_shading, other) != 0)
                    bits |= bit;
            }
            bit <<= 1;
        }
    }
    float3 other = xyz(gb_emission[pixel]);
    if (beneath_slots != 0u) {
        other += xyz(beneath_emission[pixel]);
        uint beneath = beneath_pixel_slot[pixel];
        if (beneath != INVALID_INDEX)
            other += LAMBERT_REFLECTANCE(xyz(beneath_albedo[pixel])) *
                     slot_irradiance(beneath_irradiance, beneath_slots, beneath);
    }
    signal[point] =
        f4(luminance(slot_irradiance(irradiance, slots, slot)),
           LAMBERT_REFLECTANCE(luminance(xyz(gb_albedo[pixel]))), luminance(other), (float)bits);
}
