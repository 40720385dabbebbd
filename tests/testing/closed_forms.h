// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_CLOSED_FORMS_H
#define WEFT_TESTS_TESTING_CLOSED_FORMS_H

#include "selftest/closed_forms.h"
#include "selftest/statistics.h"

namespace weft::test {

using namespace selftest;

}  // namespace weft::test

#endif
