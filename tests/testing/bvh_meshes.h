// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_BVH_MESHES_H
#define WEFT_TESTS_TESTING_BVH_MESHES_H

#include "selftest/bvh_meshes.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
