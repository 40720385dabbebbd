// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What layered_opencl_test.cpp calls beside kernels/bsdf/layered_sample.h.
#ifndef WEFT_TESTS_BSDF_LAYERED_OPENCL_TOO_H
#define WEFT_TESTS_BSDF_LAYERED_OPENCL_TOO_H

#include "kernels/bsdf/bent_normal.h"
#include "kernels/bsdf/plastic.h"

#endif
