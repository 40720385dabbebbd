// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_SCATTERED_LIGHT_H
#define WEFT_TESTS_TESTING_SCATTERED_LIGHT_H

#include <cstdint>

#include "tests/testing/path_fixture.h"

namespace weft::test {

/// Mean of a channel of the image but for light that comes straight from area lights.
inline double scattered_mean(const Rendering& rendering, std::uint32_t channel) {
    double sum = 0.0;
    for (const char* layer : {"direct", "indirect", "media"}) {
        if (rendering.image.find(layer) == nullptr) continue;
        for (const double value : channel_of(rendering, layer, channel)) sum += value;
    }
    return sum / (static_cast<double>(rendering.image.width) * rendering.image.height);
}

}  // namespace weft::test

#endif
