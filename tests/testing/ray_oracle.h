// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_RAY_ORACLE_H
#define WEFT_TESTS_TESTING_RAY_ORACLE_H

#include "selftest/ray_oracle.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
