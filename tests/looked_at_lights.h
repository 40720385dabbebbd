// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_LOOKED_AT_LIGHTS_H
#define WEFT_TESTS_LOOKED_AT_LIGHTS_H

#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/shared_types.h"

namespace weft::test {

/// What a pixel found with its first ray to a light.
enum class Look : std::uint8_t { none, seen, hidden };

/// What the pixels of a picture found of all lights of some words.
class LookedAtLights {
  public:
    LookedAtLights(std::uint32_t width, std::uint32_t height, std::uint32_t interleave,
                   std::uint32_t words)
        : width_(width),
          height_(height),
          interleave_(interleave),
          words_(words),
          looks_(std::size_t{words} * SHADOW_WORD_LIGHTS * width * height, Look::none) {}

    [[nodiscard]] int width() const { return static_cast<int>(width_); }
    [[nodiscard]] int height() const { return static_cast<int>(height_); }
    [[nodiscard]] int period() const {
        return static_cast<int>(shared::shadow_period(interleave_));
    }
    [[nodiscard]] std::uint32_t interleave() const { return interleave_; }
    [[nodiscard]] std::uint32_t words() const { return words_; }
    [[nodiscard]] std::uint32_t lights() const { return words_ * SHADOW_WORD_LIGHTS; }
    [[nodiscard]] std::size_t pixels() const { return std::size_t{width_} * height_; }

    void set(std::uint32_t light, int x, int y, Look look) { looks_[place(light, x, y)] = look; }

    [[nodiscard]] bool holds(int x, int y) const {
        return x >= 0 && y >= 0 && x < width() && y < height();
    }

    /// Pixels outside of the picture did not look.
    [[nodiscard]] Look at(std::uint32_t light, int x, int y) const {
        if (!holds(x, y)) return Look::none;
        return looks_[place(light, x, y)];
    }

    /// As shadow_probes.cl writes it.
    [[nodiscard]] std::vector<std::uint32_t> planes() const {
        const std::size_t margin = shared::shadow_margin(interleave_);
        const std::size_t pitch = shared::shadow_pitch(width_, interleave_);
        const std::size_t plane = shared::shadow_plane(width_, height_, interleave_);
        std::vector<std::uint32_t> all(2 * words_ * plane, 0);
        for (std::uint32_t light = 0; light < lights(); ++light)
            for (int y = 0; y < height(); ++y)
                for (int x = 0; x < width(); ++x) {
                    const Look look = at(light, x, y);
                    if (look == Look::none) continue;
                    const std::size_t word = light / SHADOW_WORD_LIGHTS;
                    const std::size_t first = (2 * word + (look == Look::hidden ? 1 : 0)) * plane;
                    const std::size_t row = static_cast<std::size_t>(y) + margin;
                    const std::size_t column = static_cast<std::size_t>(x) + margin;
                    all[first + row * pitch + column] |= 1U << light % SHADOW_WORD_LIGHTS;
                }
        return all;
    }

  private:
    [[nodiscard]] std::size_t place(std::uint32_t light, int x, int y) const {
        return light * pixels() + static_cast<std::size_t>(y) * width_ +
               static_cast<std::size_t>(x);
    }

    std::uint32_t width_, height_, interleave_, words_;
    std::vector<Look> looks_;
};

}  // namespace weft::test

#endif
