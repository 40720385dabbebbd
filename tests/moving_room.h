// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_MOVING_ROOM_H
#define WEFT_TESTS_MOVING_ROOM_H

#include "selftest/moving_room.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
