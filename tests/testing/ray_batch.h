// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_RAY_BATCH_H
#define WEFT_TESTS_TESTING_RAY_BATCH_H

#include "selftest/ray_batch.h"
#include "tests/testing/render_fixture.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
