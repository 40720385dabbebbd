// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/shadow_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "shared/shared_types.h"
#include "tests/testing/image_masks.h"
#include "tests/testing/render_fixture.h"

// Where probes at lights differ (shadow_edges.cl) against a search of every footprint, on every
// backend and at every width of packets; and how densely lights are sampled there, against a search
// of every pixel.
namespace weft::shadow_edges_test {
namespace {

using test::TestBackend;

/// What a pixel found with its first ray to a light.
enum class Probe : std::uint8_t { none, seen, hidden };

constexpr int before = SHADOW_BEFORE;  // columns and rows of a footprint
constexpr int after = SHADOW_FOOTPRINT - 1 - before;

/// What the pixels of an image found of all lights of some words.
class Probes {
  public:
    Probes(int width, int height, std::uint32_t words)
        : width_(width),
          height_(height),
          words_(words),
          probes_(std::size_t{words} * VISIBILITY_MASK_LIGHTS * pixels(), Probe::none) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    [[nodiscard]] std::uint32_t words() const { return words_; }
    [[nodiscard]] std::uint32_t lights() const { return words_ * VISIBILITY_MASK_LIGHTS; }
    [[nodiscard]] std::size_t pixels() const {
        return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
    }

    void set(std::uint32_t light, int x, int y, Probe probe) {
        probes_[place(light, x, y)] = probe;
    }

    /// Pixels outside of the image did not probe.
    [[nodiscard]] Probe at(std::uint32_t light, int x, int y) const {
        const bool inside = x >= 0 && y >= 0 && x < width_ && y < height_;
        return inside ? probes_[place(light, x, y)] : Probe::none;
    }

    /// Whether a pixel looked and not all pixels of its footprint that did saw the same.
    [[nodiscard]] bool differ_about(std::uint32_t light, int x, int y) const {
        bool seen = false;
        bool hidden = false;
        for (int j = -before; j <= after; ++j)
            for (int i = -before; i <= after; ++i) {
                seen = seen || at(light, x + i, y + j) == Probe::seen;
                hidden = hidden || at(light, x + i, y + j) == Probe::hidden;
            }
        return at(light, x, y) != Probe::none && seen && hidden;
    }

    /// As shadow_probes.cl writes it.
    [[nodiscard]] std::vector<std::uint32_t> planes() const {
        const auto width = static_cast<std::uint32_t>(width_);
        const auto height = static_cast<std::uint32_t>(height_);
        const std::size_t plane = shared::shadow_plane(width, height);
        std::vector<std::uint32_t> all(2 * words_ * plane, 0);
        for (std::uint32_t light = 0; light < lights(); ++light)
            for (int y = 0; y < height_; ++y)
                for (int x = 0; x < width_; ++x) {
                    const Probe probe = at(light, x, y);
                    if (probe == Probe::none) continue;
                    const std::size_t word = light / VISIBILITY_MASK_LIGHTS;
                    const std::size_t first = (2 * word + (probe == Probe::hidden ? 1 : 0)) * plane;
                    const std::size_t row = static_cast<std::size_t>(y) + SHADOW_MARGIN;
                    const std::size_t column = static_cast<std::size_t>(x) + SHADOW_MARGIN;
                    all[first + row * shared::shadow_pitch(width) + column] |=
                        1U << light % VISIBILITY_MASK_LIGHTS;
                }
        return all;
    }

  private:
    [[nodiscard]] std::size_t place(std::uint32_t light, int x, int y) const {
        return light * pixels() + static_cast<std::size_t>(y * width_ + x);
    }

    int width_, height_;
    std::uint32_t words_;
    std::vector<Probe> probes_;
};

/// Half planes of light and shadow, with specks in every second, and with a square that did not
/// probe and single pixels that did not; the last light is seen by all, the one before by none.
Probes random_probes(int width, int height, std::uint32_t words) {
    Probes probes(width, height, words);
    test::RandomBits random(static_cast<std::uint32_t>(1000 * width) + words);
    const auto some = [&](int edge) {
        return static_cast<int>(random.below(static_cast<std::uint32_t>(edge)));
    };
    for (std::uint32_t light = 0; light < probes.lights(); ++light) {
        const int slope_x = some(5) - 2;
        const int slope_y = some(5) - 2;
        const int end = slope_x * some(width) + slope_y * some(height);
        const int hole_x = some(width);
        const int hole_y = some(height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const bool hole = x >= hole_x && x < hole_x + 7 && y >= hole_y && y < hole_y + 7;
                if (hole || random.below(16) == 0) continue;
                const bool speck = light % 2 == 1 && random.below(64) == 0;
                bool seen = (slope_x * x + slope_y * y > end) != speck;
                if (light + 2 >= probes.lights()) seen = light + 1 == probes.lights();
                probes.set(light, x, y, seen ? Probe::seen : Probe::hidden);
            }
    }
    return probes;
}

/// Runs the kernel by itself. Checks that it writes nothing behind its buffer's end.
std::vector<std::uint32_t> written_edges(Executor& executor, const Probes& probes) {
    constexpr std::uint32_t untouched = 0xA5C3960FU;
    constexpr std::size_t guard = 32;  // more than any packet is wide
    const KernelId kernel = KernelId::shadow_edges;
    executor.build({&kernel, 1}, 0);
    shared::RenderParams params{};
    shared::CameraParams& camera = params.camera;
    camera.width = static_cast<std::uint32_t>(probes.width());
    camera.height = static_cast<std::uint32_t>(probes.height());
    const std::size_t values = probes.words() * probes.pixels();
    const auto shadows =
        upload<kinds::PixelShadows>(executor, probes.planes(), "shadows of pixels");
    const auto edges = upload<kinds::ShadowEdges>(
        executor, std::vector<std::uint32_t>(values + guard, untouched), "edges");
    const std::uint32_t lanes = executor.lanes();
    const std::uint32_t runs = (camera.width + lanes - 1) / lanes * camera.height;
    // Launches have at most 100 work-items, so that they end in the middle of rows and of words.
    EXPECT_TRUE(run_kernel(executor, params,
                           kernels::shadow_edges{.pixel_shadows = shadows, .shadow_edges = edges},
                           runs * probes.words(), {.items_per_launch = 100}));
    (void)executor.take_milliseconds();
    auto written = read_buffer(executor, edges, values + guard);
    for (std::size_t i = values; i < written.size(); ++i) EXPECT_EQ(written[i], untouched);
    written.resize(values);
    return written;
}

/// Executors of all backends and packet widths; Embree's kernels are those of the own BVH.
std::vector<std::unique_ptr<Executor>> executors() {
    std::vector<std::unique_ptr<Executor>> all;
    for (const TestBackend backend : test::backends()) {
        if (backend == TestBackend::embree)
            all.push_back(test::make_executor(backend));
        else
            for (const std::uint32_t lanes : {1U, 4U, 8U, 16U})
                all.push_back(test::make_executor(backend, lanes));
    }
    return all;
}

TEST(ShadowEdges, AreWhereProbesOfAFootprintDiffer) {
    const auto all = executors();
    for (const auto& [width, height] : {std::pair{1, 1}, {5, 3}, {37, 21}, {64, 9}})
        for (const std::uint32_t words : {1U, 2U}) {
            SCOPED_TRACE(testing::Message()
                         << width << " x " << height << ", " << words << " words");
            const Probes probes = random_probes(width, height, words);
            std::vector<std::uint32_t> expected(words * probes.pixels(), 0);
            std::size_t differing = 0;
            for (std::uint32_t light = 0; light < probes.lights(); ++light)
                for (std::size_t pixel = 0; pixel < probes.pixels(); ++pixel) {
                    const auto place = static_cast<int>(pixel);
                    if (!probes.differ_about(light, place % width, place / width)) continue;
                    expected[light / VISIBILITY_MASK_LIGHTS * probes.pixels() + pixel] |=
                        1U << light % VISIBILITY_MASK_LIGHTS;
                    ++differing;
                }
            if (width > 8) {
                EXPECT_GT(differing, probes.pixels());
                EXPECT_LT(differing, probes.lights() * probes.pixels() / 2);
            }
            for (const auto& executor : all)
                EXPECT_EQ(written_edges(*executor, probes), expected)
                    << executor->device().backend << ", " << executor->lanes() << " lanes";
        }
}

constexpr TileGrid images[] = {{1, 1}, {7, 3}, {8, 8}, {9, 1}, {1, 17}, {37, 21}, {64, 9}};
constexpr std::uint32_t light_counts[] = {1, 32, 33, 70};

/// What shadow_edges.cl could have written: few edges.
std::vector<std::uint32_t> random_words(std::size_t pixels, std::uint32_t lights,
                                        std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint32_t> words(shared::visibility_mask_words(lights) * pixels, 0);
    for (std::uint32_t light = 0; light < lights; ++light)
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            // The more lights, the fewer edges of each, so that pixels without any are left.
            if (random() % (8 * lights) != 0) continue;
            words[light / VISIBILITY_MASK_LIGHTS * pixels + pixel] |=
                1U << light % VISIBILITY_MASK_LIGHTS;
        }
    return words;
}

/// Of a pixel: full where the word of any 32 lights has an edge.
Level searched(const std::vector<std::uint32_t>& words, std::size_t pixels, std::size_t pixel) {
    for (std::size_t at = pixel; at < words.size(); at += pixels)
        if (words[at] != 0) return Level::full;
    return Level::coarse;
}

TEST(ShadowEdges, TilesHaveTheHighestLevelOfTheirPixels) {
    std::size_t of_level[3] = {};
    for (const TileGrid& grid : images)
        for (const std::uint32_t lights : light_counts) {
            SCOPED_TRACE(testing::Message()
                         << grid.width << " x " << grid.height << ", " << lights << " lights");
            const std::size_t pixels = std::size_t{grid.width} * grid.height;
            const auto words = random_words(pixels, lights, 3 * grid.width + lights);
            std::vector<Level> levels(grid.tiles(), Level::coarse);
            std::uint64_t full = 0;
            for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
                const std::size_t x = pixel % grid.width;
                const std::size_t y = pixel / grid.width;
                Level& tile = levels[y / TILE_EDGE * grid.columns() + x / TILE_EDGE];
                const Level level = searched(words, pixels, pixel);
                EXPECT_EQ(shadow_level(words, pixels, pixel), level) << pixel;
                tile = std::max(tile, level);
                full += level == Level::full ? 1 : 0;
                ++of_level[static_cast<std::size_t>(level)];
            }
            const ShadowEdges found = find_shadow_edges(grid, words);
            EXPECT_EQ(found.levels, levels);
            EXPECT_EQ(found.pixels, full);
        }
    EXPECT_GT(of_level[0], 0U);
    EXPECT_GT(of_level[2], 0U);
}

TEST(ShadowEdges, OneLightOfOnePixelRaisesItsTileOnly) {
    const TileGrid grid{19, 10};
    const std::size_t pixels = std::size_t{19} * 10;
    for (const std::uint32_t light : {0U, 31U, 32U, 63U})
        for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
            std::vector<std::uint32_t> words(2 * pixels, 0);
            words[light / VISIBILITY_MASK_LIGHTS * pixels + pixel] =
                1U << light % VISIBILITY_MASK_LIGHTS;
            std::vector<Level> levels(grid.tiles(), Level::coarse);
            levels[pixel / 19 / TILE_EDGE * grid.columns() + pixel % 19 / TILE_EDGE] = Level::full;
            const ShadowEdges found = find_shadow_edges(grid, words);
            EXPECT_EQ(found.levels, levels) << pixel;
            EXPECT_EQ(found.pixels, 1U);
        }
}

TEST(ShadowEdges, NothingToSampleAgainWhereAllSawTheSame) {
    const TileGrid grid{40, 24};
    const std::vector<std::uint32_t> words(2 * std::size_t{40} * 24, 0);
    const ShadowEdges found = find_shadow_edges(grid, words);
    EXPECT_EQ(found.levels, std::vector<Level>(grid.tiles(), Level::coarse));
    EXPECT_EQ(found.pixels, 0U);
}

}  // namespace
}  // namespace weft::shadow_edges_test
