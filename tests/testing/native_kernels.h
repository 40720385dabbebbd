// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_NATIVE_KERNELS_H
#define WEFT_TESTS_TESTING_NATIVE_KERNELS_H

#include "selftest/native_kernels.h"

#endif
