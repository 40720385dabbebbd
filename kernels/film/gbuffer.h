// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The buffers of GROUP_SeenSurfaces hold what a primary ray found, per pixel.
//   gb_ids       instance (INVALID_INDEX: background) and triangle id
//   gb_position  point; w: distance along the viewing axis from where the ray begins
//   gb_normal    geometric normal towards the camera; w: footprint of a pixel on the surface
//   gb_shading   interpolated normal
//   gb_albedo    diffuse albedo; w: 1 where that is not black
//   gb_emission  emitted radiance, or that of the background
// Points of the previous frame, for moving objects, are to join as gb_previous.
#ifndef WEFT_KERNELS_FILM_GBUFFER_H
#define WEFT_KERNELS_FILM_GBUFFER_H

#include "kernels/core/port.h"

#endif
