// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "picture_masks.h"
#include "render_fixture.h"
#include "written_shadow_edges.h"

// What shadow_edges.cl makes of looks at lights, against windows whose pixels are counted one by
// one.
namespace weft {
namespace {

using test::Backend;
using test::Look;
using test::LookedAtLights;
using test::WrittenShadowEdges;

constexpr int window_edge = SHADOW_WINDOW;
constexpr int before = SHADOW_BEFORE;  // columns and rows of a window
constexpr int after = window_edge - 1 - before;

/// What the window of a pixel tells of a light.
struct Window {
    bool edge = false;
    bool narrow = false, row_bars = false, column_bars = false;  ///< reasons for doubt
    int astray = 0;  ///< pixels that do not speak of one place
    std::uint32_t lit = 0, dark = 0;

    [[nodiscard]] bool scattered() const { return 2 * astray > window_edge * window_edge; }
    [[nodiscard]] int reasons() const {
        return int{narrow} + int{row_bars} + int{column_bars} + int{scattered()};
    }
    [[nodiscard]] bool doubtful() const { return edge && reasons() > 0; }
};

/// A window's looks, by row and column.
using Looks = std::array<std::array<Look, window_edge>, window_edge>;

bool all_are(const Looks& looks, int line, bool row, Look look) {
    int same = 0;
    for (int i = 0; i < window_edge; ++i) {
        const auto [x, y] = row ? std::pair{i, line} : std::pair{line, i};
        same += looks.at(static_cast<std::size_t>(y)).at(static_cast<std::size_t>(x)) == look;
    }
    return same == window_edge;
}

/// Whether a whole row (or column) saw the light and a whole other one did not.
bool has_bars(const Looks& looks, bool rows) {
    bool lit = false;
    bool dark = false;
    for (int line = 0; line < window_edge; ++line) {
        lit = lit || all_are(looks, line, rows, Look::seen);
        dark = dark || all_are(looks, line, rows, Look::hidden);
    }
    return lit && dark;
}

bool disagree(Look a, Look b) {
    return a != Look::none && b != Look::none && a != b;
}

Window window_about(const LookedAtLights& all, std::uint32_t light, int x, int y) {
    Window window;
    Looks looks{};
    const int period = all.period();
    for (int j = -before; j <= after; ++j)
        for (int i = -before; i <= after; ++i) {
            const int u = x + i;
            const int v = y + j;
            const Look own = all.at(light, u, v);
            const bool left = disagree(own, all.at(light, u - period, v));
            const bool right = disagree(own, all.at(light, u + period, v));
            const bool above = disagree(own, all.at(light, u, v - period));
            const bool below = disagree(own, all.at(light, u, v + period));
            window.lit += own == Look::seen ? 1 : 0;
            window.dark += own == Look::hidden ? 1 : 0;
            window.astray += own == Look::none || left || right || above || below ? 1 : 0;
            // What is beyond the picture cannot vouch for a pixel.
            const bool in_row = (left || !all.holds(u - period, v)) &&
                                (right || !all.holds(u + period, v)) && (left || right);
            const bool in_column = (above || !all.holds(u, v - period)) &&
                                   (below || !all.holds(u, v + period)) && (above || below);
            window.narrow = window.narrow || in_row || in_column;
            looks.at(static_cast<std::size_t>(j + before))
                .at(static_cast<std::size_t>(i + before)) = own;
        }
    window.edge = all.at(light, x, y) != Look::none && window.lit > 0 && window.dark > 0;
    window.row_bars = has_bars(looks, true);
    window.column_bars = has_bars(looks, false);
    return window;
}

/// Of all lights and pixels: light by light, row by row.
std::vector<Window> windows_of(const LookedAtLights& looks) {
    std::vector<Window> windows;
    windows.reserve(looks.lights() * looks.pixels());
    for (std::uint32_t light = 0; light < looks.lights(); ++light)
        for (int y = 0; y < looks.height(); ++y)
            for (int x = 0; x < looks.width(); ++x)
                windows.push_back(window_about(looks, light, x, y));
    return windows;
}

void expect_windows(const LookedAtLights& looks, const std::vector<Window>& windows, bool trust,
                    const WrittenShadowEdges& written) {
    std::size_t wrong_edges = 0;
    std::size_t wrong_doubts = 0;
    std::size_t wrong_counts = 0;
    for (std::uint32_t light = 0; light < looks.lights(); ++light)
        for (std::size_t pixel = 0; pixel < looks.pixels(); ++pixel) {
            const Window& window = windows[light * looks.pixels() + pixel];
            const bool doubtful = trust ? window.doubtful() : window.edge;
            wrong_edges += written.has(SHADOW_EDGE, light, pixel) != window.edge;
            wrong_doubts += written.has(SHADOW_DOUBT, light, pixel) != doubtful;
            if (!window.edge || !trust) continue;  // counts are not made without trust
            wrong_counts += written.lit(light, pixel) != window.lit ||
                            written.dark(light, pixel) != window.dark;
        }
    EXPECT_EQ(wrong_edges, 0U);
    EXPECT_EQ(wrong_doubts, 0U);
    EXPECT_EQ(wrong_counts, 0U);
}

/// What one light's picture is made of.
struct Pattern {
    enum Kind : std::uint32_t { noise, specks, penumbra, half_plane, bars, periodic_bars, count };
    Kind kind;
    float normal_x, normal_y, from, width;  ///< of a penumbra or half plane, pixels
    int bar, distance;
    bool across;
    float unknown;                  ///< share of pixels that did not look
    int hole_x, hole_y, hole_edge;  ///< a square that did not look
    std::vector<float> thresholds;  ///< by the places of a period
};

Pattern make_pattern(const LookedAtLights& looks, std::uint32_t light, test::Uniform& random) {
    Pattern pattern{};
    pattern.kind = static_cast<Pattern::Kind>(light % Pattern::count);
    const float angle = 6.2831853F * random.unit();
    // Every second one along the axes, where whole rows and columns of windows see the same.
    const bool skew = random.below(2) == 0;
    pattern.normal_x = skew ? std::cos(angle) : static_cast<float>(random.below(2));
    pattern.normal_y = skew ? std::sin(angle) : 1.0F - pattern.normal_x;
    const auto centre = [&](int edge) { return random.unit() * static_cast<float>(edge); };
    pattern.from =
        pattern.normal_x * centre(looks.width()) + pattern.normal_y * centre(looks.height());
    pattern.width = 4.0F + 40.0F * random.unit();
    pattern.from -= 0.5F * pattern.width;
    pattern.bar = 1 + static_cast<int>(random.below(3));
    pattern.distance = 7 + static_cast<int>(random.below(8));
    if (pattern.kind == Pattern::periodic_bars) {
        pattern.distance = looks.period();
        pattern.bar =
            1 + static_cast<int>(random.below(looks.interleave() + 1)) % (looks.period() - 1);
    }
    pattern.across = random.below(2) == 0;
    if (random.below(3) == 0) pattern.unknown = 0.6F * random.unit();
    pattern.hole_x = static_cast<int>(random.below(static_cast<std::uint32_t>(looks.width())));
    pattern.hole_y = static_cast<int>(random.below(static_cast<std::uint32_t>(looks.height())));
    pattern.hole_edge = static_cast<int>(random.below(8));
    for (int i = 0; i < looks.period() * looks.period(); ++i)
        pattern.thresholds.push_back(random.unit());
    return pattern;
}

bool sees(const Pattern& pattern, int period, int x, int y, test::Uniform& random) {
    const float off = pattern.normal_x * static_cast<float>(x) +
                      pattern.normal_y * static_cast<float>(y) - pattern.from;
    const std::size_t place = static_cast<std::size_t>(y % period * period + x % period);
    switch (pattern.kind) {
        case Pattern::noise:
            return random.below(2) == 0;
        case Pattern::specks:
            return random.below(24) != 0;
        case Pattern::penumbra:
            return pattern.thresholds.at(place) < off / pattern.width;
        case Pattern::half_plane:
            return off > 0.0F;
        default:
            return (pattern.across ? y : x) % pattern.distance >= pattern.bar;
    }
}

LookedAtLights random_looks(std::uint32_t width, std::uint32_t height, std::uint32_t interleave,
                            std::uint32_t words) {
    LookedAtLights looks(width, height, interleave, words);
    test::Uniform random(1000 * width + 100 * interleave + words);
    for (std::uint32_t light = 0; light < looks.lights(); ++light) {
        const Pattern pattern = make_pattern(looks, light, random);
        for (int y = 0; y < looks.height(); ++y)
            for (int x = 0; x < looks.width(); ++x) {
                const bool in_hole = std::abs(x - pattern.hole_x) < pattern.hole_edge &&
                                     std::abs(y - pattern.hole_y) < pattern.hole_edge;
                const bool unknown = random.unit() < pattern.unknown;
                const bool seen = sees(pattern, looks.period(), x, y, random);
                if (in_hole || unknown) continue;
                looks.set(light, x, y, seen ? Look::seen : Look::hidden);
            }
    }
    return looks;
}

/// That each rule alone decides somewhere, and both sides of the limit of pixels astray.
void expect_all_kinds(const std::vector<Window>& windows) {
    std::size_t sure = 0, narrow = 0, rows = 0, columns = 0, just_few = 0, just_many = 0;
    for (const Window& window : windows) {
        if (!window.edge) continue;
        const bool alone = window.reasons() == 1;
        sure += window.reasons() == 0;
        narrow += alone && window.narrow;
        rows += alone && window.row_bars;
        columns += alone && window.column_bars;
        just_few += window.reasons() == 0 && window.astray == 18;
        just_many += alone && window.astray == 19;
    }
    EXPECT_GT(sure, 0U);
    EXPECT_GT(narrow, 0U);
    EXPECT_GT(rows, 0U);
    EXPECT_GT(columns, 0U);
    EXPECT_GT(just_few, 0U);
    EXPECT_GT(just_many, 0U);
}

/// Executors of all backends and packet widths; Embree's kernels are those of the own BVH.
std::vector<std::unique_ptr<Executor>> executors() {
    std::vector<std::unique_ptr<Executor>> all;
    for (const Backend backend : test::backends()) {
        if (backend == Backend::embree)
            all.push_back(test::make_executor(backend));
        else
            for (const std::uint32_t lanes : {1U, 4U, 8U, 16U})
                all.push_back(test::make_executor(backend, lanes));
    }
    return all;
}

TEST(ShadowWindows, TellWhatCountingTheirPixelsTells) {
    const auto all = executors();
    for (const auto& [width, height] : {std::pair{1U, 1U}, {5U, 3U}, {37U, 21U}, {64U, 9U}})
        for (const std::uint32_t interleave : {1U, 3U})
            for (const std::uint32_t words : {1U, 2U}) {
                const LookedAtLights looks = random_looks(width, height, interleave, words);
                const std::vector<Window> windows = windows_of(looks);
                SCOPED_TRACE(testing::Message() << width << " x " << height << ", interleave "
                                                << interleave << ", " << words << " words");
                if (width == 37 && words == 2) expect_all_kinds(windows);
                for (const auto& executor : all) {
                    SCOPED_TRACE(executor->device().backend + ", " +
                                 std::to_string(executor->lanes()) + " lanes");
                    for (const bool trust : {false, true})
                        expect_windows(looks, windows, trust, find_edges(*executor, looks, trust));
                }
            }
}

}  // namespace
}  // namespace weft
