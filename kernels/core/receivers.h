// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The de-interleaved receivers are planes, one after another, each of `slots` floats. Those of
// normals exist only where the scene has smooth ones or media, the last one only where it has
// media.
#ifndef WEFT_KERNELS_CORE_RECEIVERS_H
#define WEFT_KERNELS_CORE_RECEIVERS_H

#define RECEIVER_X 0u
#define RECEIVER_Y 1u
#define RECEIVER_Z 2u
#define RECEIVER_SHADING_X 3u
#define RECEIVER_SHADING_Y 4u
#define RECEIVER_SHADING_Z 5u
#define RECEIVER_VALID 6u
#define RECEIVER_NORMAL_X 7u
#define RECEIVER_NORMAL_Y 8u
#define RECEIVER_NORMAL_Z 9u
#define RECEIVER_ENCLOSING_MEDIA 10u  // boundaries of media around it, a bit each (bits)
#define RECEIVER_PLANES_FLAT 7u
#define RECEIVER_PLANES_SMOOTH 10u
#define RECEIVER_PLANES_MEDIA 11u

#endif
