// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_RAY_BRUTE_FORCE_H
#define WEFT_TESTS_TESTING_RAY_BRUTE_FORCE_H

#include "selftest/ray_brute_force.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
