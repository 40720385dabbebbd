// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_SCENE_BUILDER_H
#define WEFT_TESTS_TESTING_SCENE_BUILDER_H

#include "selftest/scene_builder.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
