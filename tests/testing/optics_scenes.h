// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_OPTICS_SCENES_H
#define WEFT_TESTS_TESTING_OPTICS_SCENES_H

#include "selftest/optics_scenes.h"
#include "tests/testing/surface_scenes.h"

#endif
