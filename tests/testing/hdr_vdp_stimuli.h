// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_HDR_VDP_STIMULI_H
#define WEFT_TESTS_TESTING_HDR_VDP_STIMULI_H

#include "selftest/hdr_vdp_stimuli.h"

namespace weft {

using namespace selftest;

}  // namespace weft

#endif
