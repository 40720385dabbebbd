// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "adaptive/level_overlay.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "adaptive/level_layers.h"
#include "app/options.h"
#include "base/file.h"
#include "image/exr.h"
#include "image/read_png.h"
#include "metrics/heat_map.h"
#include "metrics/numeric.h"
#include "session/overlay_files.h"
#include "tests/testing/made_up_frames.h"
#include "tests/testing/run_program.h"

// Images of the scheduler's decisions: the layers, what overlays make of them, and the files.
namespace weft::level_overlay_test {
namespace {

using test::run_program;

constexpr std::uint32_t width = 8;
constexpr std::uint32_t height = 2;

/// Grey that grows to the right, with one layer of values.
Image make_image(const std::string& layer, const std::vector<float>& values) {
    Image image;
    image.width = width;
    image.height = height;
    Layer beauty{"", "RGB", {}};
    for (int channel = 0; channel < 3; ++channel)
        for (std::uint32_t i = 0; i < width * height; ++i)
            beauty.values.push_back(static_cast<float>(i % width) / 10.0F);
    image.layers = {beauty, {layer, "Y", values}};
    image.layers.back().values.resize(std::size_t{width} * height, 0.0F);
    return image;
}

/// Display value of the overlay and, of the image alone, what it should be under a colour.
void expect_colour(const Image& overlay, std::size_t pixel, double under,
                   const std::array<std::uint8_t, 3>& colour) {
    const std::vector<float> shown = srgb_encode(overlay.find("")->values);
    const std::array<float, 1> linear{static_cast<float>(under)};
    const double grey = static_cast<double>(srgb_encode(linear).front());
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(shown[c * width * height + pixel]),
                    0.5 * (grey + colour.at(c) / 255.0), 1e-5)
            << "pixel " << pixel << ", channel " << c;
}

void expect_grey(const Image& overlay, std::size_t pixel, double under) {
    const std::vector<float>& shown = overlay.find("")->values;
    for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(static_cast<double>(shown[c * width * height + pixel]), under, 1e-5) << pixel;
}

TEST(LevelOverlay, LevelsHaveThreeColours) {
    const Image image = make_image("indirect.level", {0, 1, 2, 0, 1, 2, 0, 1});
    const Image overlay = level_overlay(image, "indirect.level", 0.0);
    EXPECT_EQ(overlay.width, width);
    EXPECT_EQ(overlay.height, height);
    ASSERT_EQ(overlay.layers.size(), 1U);
    for (std::size_t pixel = 0; pixel < width; ++pixel)
        expect_colour(overlay, pixel, static_cast<double>(pixel) / 10.0,
                      viridis(static_cast<double>(pixel % 3) / 2.0));
}

TEST(LevelOverlay, SamplesAreMarkedAndTheRestIsGrey) {
    const Image overlay =
        level_overlay(make_image("direct.samples", {0, 1, 0, 1}), "direct.samples", 0.0);
    expect_grey(overlay, 0, 0.0);
    expect_colour(overlay, 1, 0.1, viridis(1.0));
    expect_grey(overlay, 2, 0.2);
    expect_colour(overlay, 3, 0.3, viridis(1.0));
    expect_grey(overlay, 7, 0.7);
}

TEST(LevelOverlay, ErrorsHaveALogarithmicScale) {
    const float largest = std::numeric_limits<float>::max();
    for (const std::string layer : {"media.error", "media.error_middle"}) {
        const Image overlay =
            level_overlay(make_image(layer, {0.0F, 0.1F, 0.5F, 8.0F, 128.0F, largest}), layer, 0.0);
        expect_grey(overlay, 0, 0.0);
        expect_colour(overlay, 1, 0.1, viridis(0.0));
        expect_colour(overlay, 2, 0.2, viridis(0.0));
        expect_colour(overlay, 3, 0.3, viridis(0.5));
        expect_colour(overlay, 4, 0.4, viridis(1.0));
        expect_colour(overlay, 5, 0.5, viridis(1.0));
    }
}

TEST(LevelOverlay, TheImageUnderItIsExposed) {
    const Image image = make_image("direct.samples", {});
    expect_grey(level_overlay(image, "direct.samples", 1.0), 3, 0.6);
    expect_grey(level_overlay(image, "direct.samples", -1.0), 3, 0.15);
    expect_grey(level_overlay(image, "direct.samples", 10.0), 3, 1.0);
}

TEST(LevelOverlay, FindsItsLayers) {
    Image image = make_image("direct.level", {});
    image.layers.push_back({"indirect.error_middle", "Y", image.layers.back().values});
    image.layers.push_back({"direct", "RGB", image.layers.front().values});
    image.layers.push_back({".level", "Y", image.layers[1].values});
    EXPECT_EQ(overlay_layers(image),
              (std::vector<std::string>{"direct.level", "indirect.error_middle"}));
    EXPECT_THROW(static_cast<void>(level_overlay(image, "direct", 0.0)), std::invalid_argument);
    EXPECT_THROW(static_cast<void>(level_overlay(image, "media.level", 0.0)),
                 std::invalid_argument);
}

TEST(LevelOverlay, ErrorLayersHoldWhatWasJudged) {
    // One tile has a value that is no number; the others are even.
    const TileGrid grid{96, 64};
    const auto scene = test::plain(grid);
    LevelScheduler scheduler(grid, test::settings_of(1.0), scene.records);
    static_cast<void>(scheduler.next_round());
    const auto sampled = scheduler.sampled();
    static_cast<void>(
        scheduler.refine(Level::coarse,
                         test::lattice_signal(grid, 4, {sampled.begin(), sampled.end()},
                                              [](std::uint32_t x, std::uint32_t y) {
                                                  if (x == 20 && y == 20) return NAN;
                                                  return x > 60 ? 10.0F : 0.1F;
                                              }),
                         BrightnessSlope(100.0)));
    Image image;
    image.width = grid.width;
    image.height = grid.height;
    add_level_layers("direct", scheduler, image);
    const auto value = [&](const char* name, std::uint32_t x, std::uint32_t y) {
        return image.find(name)->values[y * grid.width + x];
    };
    EXPECT_EQ(value("direct.error", 20, 20), std::numeric_limits<float>::max());
    EXPECT_EQ(value("direct.level", 20, 20), 2.0F);
    EXPECT_GT(value("direct.error", 60, 50), 4.0F) << "an edge";
    EXPECT_EQ(value("direct.error", 60, 50), scheduler.errors(Level::coarse)[6 * 12 + 7]);
    EXPECT_LT(value("direct.error", 90, 50), 1e-3F) << "nothing there";
    for (const float error : image.find("direct.error_middle")->values) EXPECT_EQ(error, 0.0F);
}

class LevelOverlayFiles : public testing::Test {
  protected:
    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }
    [[nodiscard]] test::ProgramResult render(std::vector<std::string> more) const {
        // Enough lights, at that quality, for direct light to adapt as well.
        std::vector<std::string> arguments{"render",      test::shipped_scene("gallery.gltf"),
                                           "--size",      "40x32",
                                           "--quality",   "high",
                                           "--backend",   "embree",
                                           "--progress",  "none",
                                           "--algorithm", "ais"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments);
    }
    TemporaryFolder folder_;
};

TEST_F(LevelOverlayFiles, LieBesideTheOutput) {
    const auto result = render({"--overlays", "--frames", "0:2", "-o", at("out.exr")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(folder_.entry_count(), 2U + 2U * 6U);
    for (const char* frame : {"0000", "0001"})
        for (const char* component : {"direct", "indirect"})
            for (const std::string kind : {"level", "samples", "error", "error_middle"}) {
                // Direct light has no lattice that could err.
                if (component == std::string("direct") && kind.starts_with("error")) continue;
                const std::string name =
                    std::string("out.") + frame + '.' + component + '.' + kind + ".png";
                ASSERT_TRUE(std::filesystem::exists(at(name))) << name;
                const Image overlay = decode_png(read_file(at(name), 1 << 20), name);
                EXPECT_EQ(overlay.width, 40U);
                EXPECT_EQ(overlay.height, 32U);
            }
    // The file is what level_overlay makes of the image, to the rounding of a PNG.
    const Image image = read_exr(at("out.0001.exr"));
    const Image expected = level_overlay(image, "indirect.level", 0.0);
    const Image found =
        decode_png(read_file(at("out.0001.indirect.level.png"), 1 << 20), "overlay");
    const std::vector<float> a = srgb_encode(expected.find("")->values);
    const std::vector<float> b = srgb_encode(found.find("")->values);
    for (std::size_t i = 0; i < a.size(); ++i) ASSERT_NEAR(a[i], b[i], 1.01F / 255.0F) << i;
}

TEST_F(LevelOverlayFiles, AreNotThereUnlessAskedFor) {
    ASSERT_EQ(render({"-o", at("out.png")}).exit_code, 0);
    EXPECT_EQ(folder_.entry_count(), 1U);
}

TEST_F(LevelOverlayFiles, AreOfTheComponentsThatAdapt) {
    ASSERT_EQ(render({"--overlays", "--components", "direct", "-o", at("out.png")}).exit_code, 0);
    EXPECT_EQ(folder_.entry_count(), 1U + 2U);
    Diagnostics diagnostics;
    Image image = make_image("direct", {});
    write_overlays(at("still.exr"), image, 0.0, diagnostics);
    write_overlays(at("still.exr"), image, 0.0, diagnostics);
    EXPECT_EQ(diagnostics.warnings().size(), 1U) << "nothing adapts there";
    EXPECT_EQ(folder_.entry_count(), 1U + 2U);
}

TEST_F(LevelOverlayFiles, WrongUseIsRefused) {
    for (const char* algorithm : {"igi", "amax", "ir", "path"}) {
        const auto result =
            run_program({"render", "none.gltf", "--algorithm", algorithm, "--overlays"});
        EXPECT_EQ(result.exit_code, 1) << algorithm;
        EXPECT_EQ(result.err,
                  "weft: --overlays: shows adaptive sampling, expected --algorithm ais\n");
    }
    for (const char* name : {"out.direct.level.png", "out.0003.indirect.error.png"}) {
        const auto result =
            render({"--overlays", "--frames", "0:4", "-o", at("out.exr"), "--stats", at(name)});
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_EQ(result.err,
                  "weft: --stats: names the same file as one of the images of --overlays\n");
    }
    EXPECT_EQ(folder_.entry_count(), 0U);
}

TEST_F(LevelOverlayFiles, ThatCannotBeWrittenAreAnOutputFailure) {
    std::filesystem::create_directories(at("out.direct.level.png/in-the-way"));
    const auto result = render({"--overlays", "-o", at("out.exr")});
    EXPECT_EQ(result.exit_code, 5);
    EXPECT_NE(result.err.find("out.direct.level.png"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace weft::level_overlay_test
