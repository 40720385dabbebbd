// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FILM_FOR_EACH_PIXEL_H
#define WEFT_FILM_FOR_EACH_PIXEL_H

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cstddef>

namespace weft {

/// Calls `work` with each pixel's number, from several threads at once.
template <class Work>
void for_each_pixel(std::size_t pixels, const Work& work) {
    constexpr std::size_t grain = std::size_t{1} << 14;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, pixels, grain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                          for (std::size_t pixel = range.begin(); pixel < range.end(); ++pixel)
                              work(pixel);
                      });
}

}  // namespace weft

#endif
