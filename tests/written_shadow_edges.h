// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_WRITTEN_SHADOW_EDGES_H
#define WEFT_TESTS_WRITTEN_SHADOW_EDGES_H

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "device/executor.h"
#include "looked_at_lights.h"

namespace weft::test {

/// What shadow_edges.cl wrote; pixels are numbered row by row.
struct WrittenShadowEdges {
    std::size_t pixels = 0;
    std::vector<std::uint32_t> planes;
    std::vector<shared::ShadowCounts> counts;

    /// Whether a plane (SHADOW_EDGE or SHADOW_DOUBT) has a light at a pixel.
    [[nodiscard]] bool has(std::uint32_t plane, std::uint32_t light, std::size_t pixel) const {
        const std::size_t word = light / SHADOW_WORD_LIGHTS;
        const std::size_t at = (SHADOW_PLANES * word + plane) * pixels + pixel;
        return (planes.at(at) >> light % SHADOW_WORD_LIGHTS & 1U) != 0;
    }
    /// How many pixels of a window saw a light.
    [[nodiscard]] std::uint32_t lit(std::uint32_t light, std::size_t pixel) const {
        return number_of(counts.at(light / SHADOW_WORD_LIGHTS * pixels + pixel).lit, light);
    }
    /// How many looked at it and did not see it.
    [[nodiscard]] std::uint32_t dark(std::uint32_t light, std::size_t pixel) const {
        return number_of(counts.at(light / SHADOW_WORD_LIGHTS * pixels + pixel).dark, light);
    }

  private:
    static std::uint32_t number_of(const std::uint32_t (&digits)[SHADOW_DIGITS],
                                   std::uint32_t light) {
        std::uint32_t number = 0;
        for (std::uint32_t k = 0; k < SHADOW_DIGITS; ++k)
            number += (digits[k] >> light % SHADOW_WORD_LIGHTS & 1U) << k;
        return number;
    }
};

/// Runs the kernel by itself. Checks that it writes nothing behind the ends of its buffers.
inline WrittenShadowEdges find_edges(Executor& executor, const LookedAtLights& looks, bool trust) {
    // What is in buffers before, and must stay behind their ends.
    constexpr std::uint32_t untouched = 0xA5C3960FU;
    constexpr std::size_t guard = 32;  // more than any packet is wide
    const KernelId kernel = KernelId::shadow_edges;
    executor.build({&kernel, 1}, 0);
    shared::Params params{};
    params.width = static_cast<std::uint32_t>(looks.width());
    params.height = static_cast<std::uint32_t>(looks.height());
    params.interleave = looks.interleave();
    params.sampled_lights = looks.lights();
    params.shadow_trust = trust ? 1 : 0;
    shared::ShadowCounts unwritten{};
    std::ranges::fill(unwritten.lit, untouched);
    std::ranges::fill(unwritten.dark, untouched);
    const std::size_t values = looks.words() * looks.pixels();
    const auto shadows = upload<std::uint32_t>(executor, looks.planes(), "shadows of pixels");
    const auto edges = upload<std::uint32_t>(
        executor, std::vector<std::uint32_t>(SHADOW_PLANES * values + guard, untouched), "edges");
    const auto counts = upload<shared::ShadowCounts>(
        executor, std::vector<shared::ShadowCounts>(values + guard, unwritten), "counts");
    const std::array<Buffer*, 3> buffers{shadows.get(), edges.get(), counts.get()};
    const std::uint32_t lanes = executor.lanes();
    const std::uint32_t runs = (params.width + lanes - 1) / lanes * params.height;
    // Launches of 100 work-items end in the middle of rows and of words.
    EXPECT_TRUE(executor.run({kernel, params, nullptr, buffers, runs * looks.words(), 100}, {}));
    (void)executor.take_milliseconds();
    WrittenShadowEdges written{
        looks.pixels(),
        read_buffer<std::uint32_t>(executor, *edges, SHADOW_PLANES * values + guard),
        read_buffer<shared::ShadowCounts>(executor, *counts, values + guard)};
    for (std::size_t i = 0; i < guard; ++i) {
        EXPECT_EQ(written.planes[SHADOW_PLANES * values + i], untouched);
        EXPECT_TRUE(std::ranges::equal(written.counts[values + i].lit, unwritten.lit));
        EXPECT_TRUE(std::ranges::equal(written.counts[values + i].dark, unwritten.dark));
    }
    return written;
}

}  // namespace weft::test

#endif
