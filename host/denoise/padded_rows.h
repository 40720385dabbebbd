// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_PADDED_ROWS_H
#define WEFT_DENOISE_PADDED_ROWS_H

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

#include "denoise/padding.h"

namespace weft {

/// Calls `work` with each row of the image, from several threads at once.
template <class Work>
void for_each_row(const Padding& padding, const Work& work) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, padding.height()),
                      [&](const tbb::blocked_range<std::size_t>& rows) {
                          for (std::size_t y = rows.begin(); y < rows.end(); ++y) work(y);
                      });
}

/// Calls `work` with each pixel's number, place, column and row, from several threads at once.
template <class Work>
void for_each_padded(const Padding& padding, const Work& work) {
    for_each_row(padding, [&](std::size_t y) {
        for (std::size_t x = 0; x < padding.width(); ++x)
            work(y * padding.width() + x, padding.at(x, y), x, y);
    });
}

}  // namespace weft

#endif
