// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_SURFACE_SCENES_H
#define WEFT_TESTS_TESTING_SURFACE_SCENES_H

#include "selftest/surface_scenes.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
