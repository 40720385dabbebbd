// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <png.h>

#include "image/png.h"
#include "tests/testing/session_fixture.h"
#include "tests/testing/smoky_room.h"

namespace weft::display_test {
namespace {

using test::KeptDisplay;
using test::TestBackend;

/// The 8-bit values of an image as a PNG file has them.
std::vector<png_byte> png_values(const Image& image, double exposure_ev, ToneCurve tone) {
    const std::vector<std::byte> bytes = png_bytes(image, PngSettings{exposure_ev, tone, {}});
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()) == 0) return {};
    EXPECT_EQ(png.format, png_uint_32{PNG_FORMAT_RGB});
    std::vector<png_byte> values(PNG_IMAGE_SIZE(png));
    if (png_image_finish_read(&png, nullptr, values.data(), 0, nullptr) == 0) return {};
    return values;
}

/// Compares what a display gets with a PNG file of the same film. PNG files are made in double
/// precision, displays in float: where a value lies on the step between two codes they may choose
/// different ones, which must be rare.
void expect_png_colours(TestBackend backend, const Scene& scene, const ImageSettings& settings,
                        std::uint32_t samples, double exposure, ToneCurve tone = ToneCurve::none) {
    auto made = test::counted_session(backend, scene, test::room_camera(), settings);
    KeptDisplay display;
    display.exposure = exposure;
    display.curve = tone;
    made.session->set_display(&display);
    RenderBudget budget;
    budget.samples = samples;
    ASSERT_EQ(made.session->render(budget), SessionEnd::complete);
    const Image image = made.session->image().image;
    const std::vector<png_byte> expected = png_values(image, exposure, tone);
    ASSERT_EQ(expected.size(), 3 * display.colours.size());
    std::size_t different = 0;
    std::size_t lit = 0;
    for (std::size_t i = 0; i < display.colours.size(); ++i) {
        EXPECT_EQ(display.colours[i] >> 24, 255U);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const int shown = static_cast<int>(display.colours[i] >> (8 * c) & 255U);
            const int wanted = expected[3 * i + c];
            ASSERT_LE(std::abs(shown - wanted), 1) << "pixel " << i << " channel " << c;
            different += shown != wanted ? 1 : 0;
            lit += wanted > 0 ? 1 : 0;
        }
    }
    EXPECT_GT(lit, expected.size() / 4) << "a dark image compares nothing";
    EXPECT_LE(different, expected.size() / 1000);
}

TEST(Display, GetsThePreviewThatAPngFileWouldHold) {
    for (const TestBackend backend : test::backends())
        for (const std::uint32_t samples : {1U, 3U}) {
            RenderSettings settings = test::small_settings(Algorithm::igi, 61, 47);
            settings.samples = samples;
            expect_png_colours(backend, test::moving_room(2).scene, settings, samples,
                               samples == 1 ? 0.0 : 1.3);
        }
}

TEST(Display, GetsLightInMedia) {
    for (const TestBackend backend : test::backends())
        expect_png_colours(backend, test::smoky_room(),
                           test::small_settings(Algorithm::igi, 40, 32), 1, 0.5);
}

TEST(Display, GetsPathTracingThatAPngFileWouldHold) {
    for (const TestBackend backend : test::backends())
        for (const double exposure : {0.0, -1.7})
            expect_png_colours(backend, test::moving_room(2).scene, test::small_path(61, 47, 5), 5,
                               exposure);
}

TEST(Display, GetsTheToneCurveOfAPngFile) {
    for (const TestBackend backend : test::backends())
        for (const ToneCurve tone : {ToneCurve::filmic, ToneCurve::agx}) {
            expect_png_colours(backend, test::moving_room(2).scene,
                               test::small_settings(Algorithm::igi, 61, 47), 1, 2.0, tone);
            expect_png_colours(backend, test::moving_room(2).scene, test::small_path(31, 23, 5), 5,
                               2.0, tone);
        }
}

}  // namespace
}  // namespace weft::display_test
