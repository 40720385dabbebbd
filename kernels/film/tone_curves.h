// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The numbers of tone curves (tone.h), for kernels and host.
#ifndef WEFT_KERNELS_FILM_TONE_CURVES_H
#define WEFT_KERNELS_FILM_TONE_CURVES_H

#define TONE_NONE 0u
#define TONE_FILMIC 1u
#define TONE_AGX 2u

#endif
