// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_METRICS_RGB_VIEW_H
#define WEFT_METRICS_RGB_VIEW_H

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

namespace weft {

/// A colour image in memory that others own: linear Rec.709, planar (all red values, then green,
/// then blue), rows from the top.
struct RgbView {
    std::span<const float> values;
    std::uint32_t width = 0;
    std::uint32_t height = 0;

    [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
    [[nodiscard]] std::span<const float> plane(std::size_t channel) const {
        return values.subspan(channel * pixels(), pixels());
    }
};

/// Throws std::invalid_argument unless both are images of one size that is not zero.
inline void check_pair(const RgbView& reference, const RgbView& test) {
    const auto whole = [](const RgbView& view) {
        return view.pixels() > 0 && view.values.size() == 3 * view.pixels();
    };
    if (!whole(reference) || !whole(test) || reference.width != test.width ||
        reference.height != test.height)
        throw std::invalid_argument("metrics need two images of one size");
}

/// Luminance per pixel, with the weights that HDR-VDP's authors use for Rec.709; they add up to 1.
[[nodiscard]] inline std::vector<float> luminance(const RgbView& view) {
    std::vector<float> result(view.pixels());
    const auto red = view.plane(0);
    const auto green = view.plane(1);
    const auto blue = view.plane(2);
    for (std::size_t i = 0; i < result.size(); ++i)
        result[i] = static_cast<float>(0.212656 * double{red[i]} + 0.715158 * double{green[i]} +
                                       0.072186 * double{blue[i]});
    return result;
}

}  // namespace weft

#endif
