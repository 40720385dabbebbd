// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// shared/native_functions.h for files of kernels/ that trace rays, too: NATIVE_KERNELS names one,
// for checks that call its functions one by one.
#ifndef WEFT_SELFTEST_NATIVE_KERNELS_H
#define WEFT_SELFTEST_NATIVE_KERNELS_H

#include "device/native/native_scene.h"
#include "shared/native_functions.h"

#endif
