// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <utility>

#include "picture_masks.h"
#include "render_fixture.h"
#include "written_shadow_edges.h"

// What windows of first looks tell of a wide penumbra, and that they do not speak of a hard edge.
namespace weft {
namespace {

using test::Backend;
using test::Look;
using test::LookedAtLights;
using test::WrittenShadowEdges;

constexpr int before = SHADOW_BEFORE;  // columns of a window
constexpr int after = SHADOW_WINDOW - 1 - before;
constexpr std::uint32_t interleave = 3;
constexpr int samples = 36;  // of a light: those that the pixels of a period look at

// A penumbra, and behind it a shadow that begins at once.
constexpr int penumbra_from = 20;
constexpr int penumbra_width = 60;
constexpr int step_at = 110;

double share_at(int x) {
    if (x >= step_at) return 0.0;
    return std::clamp(static_cast<double>(x - penumbra_from) / penumbra_width, 0.0, 1.0);
}

/// The mean over the columns of a pixel's window in a picture of that width.
double true_share(int x, int width) {
    double sum = 0.0;
    const int first = std::max(0, x - before);
    const int last = std::min(width - 1, x + after);
    for (int u = first; u <= last; ++u) sum += share_at(u);
    return sum / (last - first + 1);
}

/// Numbers of the samples that the pixels of a period look at, row by row. Those of light 0 are
/// spread: columns have every sixth sample, rows nearly so; those of others are random.
std::array<int, samples> order_of(std::uint32_t light, test::Uniform& random) {
    std::array<int, samples> order{};
    for (int i = 0; i < samples; ++i) order.at(static_cast<std::size_t>(i)) = 23 * i % samples;
    if (light == 0) return order;
    for (std::uint32_t i = samples; i > 1; --i)
        std::swap(order.at(i - 1), order.at(random.below(i)));
    return order;
}

LookedAtLights penumbras() {
    LookedAtLights looks(140, 40, interleave, 1);
    const int period = looks.period();
    test::Uniform random(7);
    for (std::uint32_t light = 0; light < looks.lights(); ++light) {
        const std::array<int, samples> order = order_of(light, random);
        for (int y = 0; y < looks.height(); ++y)
            for (int x = 0; x < looks.width(); ++x) {
                const int sample =
                    order.at(static_cast<std::size_t>(x % period + y % period * period));
                const bool seen = (sample + 0.5) / samples < share_at(x);
                looks.set(light, x, y, seen ? Look::seen : Look::hidden);
            }
    }
    return looks;
}

/// What became of one light.
struct Outcome {
    std::size_t edges = 0, doubts = 0;  ///< of the penumbra
    std::size_t sure_steps = 0;         ///< pixels at the step that are not in doubt
    /// How far off a whole window's share of the light is where that is not in doubt.
    double worst = 0.0;
    /// The same of windows at the border, in the standard deviations of as many samples drawn at
    /// random.
    double worst_deviation = 0.0;
};

Outcome outcome_of(const LookedAtLights& looks, const WrittenShadowEdges& written,
                   std::uint32_t light) {
    Outcome outcome;
    for (std::size_t pixel = 0; pixel < looks.pixels(); ++pixel) {
        const int x = static_cast<int>(pixel) % looks.width();
        const bool edge = written.has(SHADOW_EDGE, light, pixel);
        const bool doubt = written.has(SHADOW_DOUBT, light, pixel);
        if (x >= step_at - after && x < step_at + before) {
            outcome.sure_steps += !edge || !doubt;
            continue;
        }
        outcome.edges += edge;
        outcome.doubts += doubt;
        if (!edge || doubt) continue;
        const double lit = written.lit(light, pixel);
        const double looked = lit + written.dark(light, pixel);
        const double off = std::abs(lit / looked - true_share(x, looks.width()));
        if (looked == samples) {
            outcome.worst = std::max(outcome.worst, off);
            continue;
        }
        // Without replacement, half of all samples seen.
        const double deviation = std::sqrt(0.25 / looked * (samples - looked) / (samples - 1.0));
        outcome.worst_deviation = std::max(outcome.worst_deviation, off / deviation);
    }
    return outcome;
}

// Along the penumbra a tenth of the light comes into sight from one period to the next, so that a
// fifth of the pixels disagree with one of those that lie a period off, where more than half of a
// window has to; and none with both. Only windows with a whole line seen and another hidden are in
// doubt: where half of the looks see the light, one of five rows is seen with a chance of about
// 5/32, and one is hidden as often; with columns that makes 2 (5/32)^2 = 5 % of the windows. The
// limit leaves room for orders of samples that make such lines likelier.
TEST(ShadowPenumbra, IsKnownFromWindowsAndAHardEdgeIsNot) {
    const LookedAtLights looks = penumbras();
    for (const Backend backend : test::backends()) {
        const WrittenShadowEdges written = find_edges(test::shared_executor(backend), looks, true);
        for (std::uint32_t light = 0; light < looks.lights(); ++light) {
            SCOPED_TRACE(testing::Message() << test::backend_name(backend) << ", light " << light);
            const Outcome outcome = outcome_of(looks, written, light);
            // The middle third of the penumbra at least.
            EXPECT_GT(outcome.edges, 20U * 40U);
            EXPECT_LT(static_cast<double>(outcome.doubts),
                      0.2 * static_cast<double>(outcome.edges));
            EXPECT_EQ(outcome.sure_steps, 0U);
            // A whole window has one look at every sample, from places 5 pixels apart at most: of
            // the three samples whose edge lies among them, half are on the wrong side at most.
            EXPECT_LT(outcome.worst, 1.5 / 36.0 + 0.05);
            // A normal distribution has 7e-6 of its values further out. There are 36 windows in
            // each of ten periods: 8 % of all seeds could fail at most, this one does not.
            EXPECT_LT(outcome.worst_deviation, 4.5);
        }
    }
}

}  // namespace
}  // namespace weft
