// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/correct_preview.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace weft::correct_preview_test {
namespace {

constexpr std::uint32_t size = 96;
constexpr std::size_t pixels = std::size_t{size} * size;

using Value = std::function<double(double x, double y)>;

/// An image of `value` in all channels, x and y in [0, 1], plus noise of that standard deviation.
ColourPlanes image_of(const Value& value, double noise = 0.0, std::uint32_t seed = 0) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    ColourPlanes planes;
    for (Plane& plane : planes) {
        plane = {size, size, std::vector<float>(pixels)};
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x)
                plane.values[std::size_t{y} * size + x] = static_cast<float>(
                    value((x + 0.5) / size, (y + 0.5) / size) + noise * normal(random));
    }
    return planes;
}

const SurfaceRuns whole(size, size);

double mean_square_error(const ColourPlanes& image, const Value& truth) {
    double sum = 0.0;
    for (const Plane& plane : image)
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x)
                sum += std::pow(
                    static_cast<double>(plane.at(x, y)) - truth((x + 0.5) / size, (y + 0.5) / size),
                    2);
    return sum / (3.0 * pixels);
}

double truth(double x, double y) {
    return 1.0 + 0.5 * std::sin(9.0 * x) * std::cos(7.0 * y) + (x > 0.5 ? 0.3 : 0.0);
}

/// Darker than the truth in a wide corner, with a narrow step that is too bright.
double preview_value(double x, double y) {
    const double corner = 0.3 * std::exp(-20.0 * (x * x + y * y));
    return truth(x, y) - corner + (x > 0.5 && x < 0.53 ? 0.2 : 0.0);
}

TEST(CorrectPreview, SamplesWithoutNoiseReplaceThePreview) {
    const ColourPlanes exact = image_of(truth);
    const ColourPlanes result = corrected(image_of(preview_value), {exact, exact, 0.5F}, whole);
    EXPECT_LT(mean_square_error(result, truth), 1e-12);
}

// Bounds on errors are about half as much again as what these seeds give, over 27,648 values each,
// of which some hundred are independent at the widest scale.
TEST(CorrectPreview, NoiseOfSamplesDoesNotReachAPreviewThatIsRight) {
    constexpr double noise = 0.4;
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const ColourPlanes result = corrected(
            image_of(truth),
            {image_of(truth, noise, 10 + seed), image_of(truth, noise, 20 + seed), 0.5F}, whole);
        // The mean of both halves would err by half the square.
        EXPECT_LT(mean_square_error(result, truth), 0.01 * noise * noise) << seed;
    }
}

TEST(CorrectPreview, WideErrorsAreCorrectedByNoisySamples) {
    constexpr double noise = 0.4;
    const ColourPlanes preview = image_of(preview_value);
    const double before = mean_square_error(preview, truth);
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const ColourPlanes result = corrected(
            preview, {image_of(truth, noise, 30 + seed), image_of(truth, noise, 40 + seed), 0.5F},
            whole);
        const double after = mean_square_error(result, truth);
        EXPECT_LT(after, before) << seed;
        EXPECT_LT(after, 0.03 * noise * noise / 2.0) << seed;
    }
}

TEST(CorrectPreview, TheResultGoesToTheMeanOfTheSamples) {
    const ColourPlanes preview = image_of(preview_value);
    double before = mean_square_error(preview, truth);
    for (const double noise : {0.2, 0.1, 0.05, 0.025, 0.0125}) {
        const ColourPlanes result = corrected(
            preview, {image_of(truth, noise, 50), image_of(truth, noise, 60), 0.5F}, whole);
        const double after = mean_square_error(result, truth);
        EXPECT_LT(after, before) << noise;
        // A quarter of what the samples alone err.
        EXPECT_LT(after, 0.25 * noise * noise / 2.0) << noise;
        before = after;
    }
}

TEST(CorrectPreview, HalvesMayHaveAnyShare) {
    // Of 16 samples of noise 0.4, by how many are in the first half.
    const ColourPlanes preview = image_of(preview_value);
    for (const int first : {4, 8, 12}) {
        const ColourPlanes result = corrected(
            preview,
            {image_of(truth, 0.4 / std::sqrt(first), 70),
             image_of(truth, 0.4 / std::sqrt(16 - first), 80), static_cast<float>(first) / 16.0F},
            whole);
        EXPECT_LT(mean_square_error(result, truth), 0.001) << first;
    }
}

TEST(CorrectPreview, OneBrightSampleDoesNotShow) {
    ColourPlanes first = image_of(truth, 0.01, 90);
    for (Plane& plane : first) plane.values[size * size / 2 + size / 2] += 1e5F;
    const ColourPlanes preview = image_of(truth);
    const ColourPlanes result = corrected(preview, {first, image_of(truth, 0.01, 91), 0.5F}, whole);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < pixels; ++i)
            EXPECT_LT(std::abs(result[c].values[i] - preview[c].values[i]), 0.02F);
}

/// The truth by samples of which one in 250 brings half of the light.
ColourPlanes rarely_lit(std::uint32_t seed) {
    constexpr double chance = 0.004;
    std::mt19937 random(seed);
    std::bernoulli_distribution lit(chance);
    ColourPlanes planes = image_of(truth);
    for (std::size_t i = 0; i < pixels; ++i) {
        const float factor = lit(random) ? static_cast<float>(1.0 / chance) : 0.0F;
        for (Plane& plane : planes) plane.values[i] *= 0.5F + 0.5F * factor;
    }
    return planes;
}

// Some 37 of the 9216 pixels of each half are bright. That none is so in both halves has a chance
// of 86 %, and holds for these seeds; where one is, nothing can tell it from the truth. The mean of
// the halves has an error of about 40.
TEST(CorrectPreview, RareBrightSamplesStayOut) {
    const ColourPlanes preview = image_of(truth);
    for (const std::uint32_t seed : {1U, 2U, 3U}) {
        const ExactHalves exact{rarely_lit(100 + seed), rarely_lit(200 + seed), 0.5F};
        EXPECT_LT(mean_square_error(corrected(preview, exact, whole), truth), 0.02) << seed;
    }
}

/// The truth by samples that are mostly darker and now and then much brighter.
ColourPlanes unevenly_lit(std::uint32_t seed, double spread) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    ColourPlanes planes = image_of(truth);
    for (std::size_t i = 0; i < pixels; ++i) {
        const auto factor =
            static_cast<float>(std::exp(spread * normal(random) - 0.5 * spread * spread));
        for (Plane& plane : planes) plane.values[i] *= factor;
    }
    return planes;
}

// Some of the 9216 pixels are bright in both halves. If these were what is agreed on, they would be
// up to 3.4 times as bright as the preview for these seeds.
TEST(CorrectPreview, SamplesThatAreBrightInBothHalvesByChanceDoNotShow) {
    const ColourPlanes preview = image_of(truth);
    for (const double spread : {1.0, 1.5, 2.0})
        for (const std::uint32_t seed : {1U, 2U, 3U}) {
            const ExactHalves exact{unevenly_lit(300 + seed, spread),
                                    unevenly_lit(400 + seed, spread), 0.5F, 2};
            const ColourPlanes result = corrected(preview, exact, whole);
            for (std::size_t i = 0; i < pixels; ++i)
                ASSERT_LT(result[1].values[i], 1.25F * preview[1].values[i])
                    << spread << ' ' << seed;
        }
}

/// A disc of radius 0.2.
bool is_on_disc(double x, double y) {
    return std::hypot(x - 0.4, y - 0.55) < 0.2;
}

/// The runs of a disc in front of a wall.
SurfaceRuns runs_of_disc(bool by_depth) {
    Image image{size, size, {}, {}};
    Layer features =
        by_depth ? Layer{"depth", "Z", {}, false, false} : Layer{"normal", "XYZ", {}, false, false};
    for (std::size_t c = 0; c < features.channels.size(); ++c)
        for (std::size_t i = 0; i < pixels; ++i) {
            const auto x = static_cast<double>(i % size);
            const auto y = static_cast<double>(i / size);
            const bool disc = is_on_disc((x + 0.5) / size, (y + 0.5) / size);
            features.values.push_back(by_depth ? (disc ? 2.0F : 3.0F) : (disc == (c == 0)));
        }
    image.layers.push_back(features);
    return find_surface_runs(image);
}

TEST(CorrectPreview, AnErrorOnOneObjectDoesNotReachAnother) {
    const auto wrong_disc = [](double x, double y) {
        return truth(x, y) + (is_on_disc(x, y) ? 20.0 : 0.0);
    };
    // Noise on the disc alone, so that what is known of its error differs with size.
    const auto sampled = [](std::uint32_t seed) {
        ColourPlanes planes = image_of(truth, 10.0, seed);
        const ColourPlanes exact = image_of(truth);
        for (std::size_t c = 0; c < 3; ++c)
            for (std::uint32_t y = 0; y < size; ++y)
                for (std::uint32_t x = 0; x < size; ++x)
                    if (!is_on_disc((x + 0.5) / size, (y + 0.5) / size))
                        planes[c].values[std::size_t{y} * size + x] = exact[c].at(x, y);
        return planes;
    };
    const ExactHalves exact{sampled(1), sampled(2), 0.5F};
    const ColourPlanes preview = image_of(wrong_disc);
    for (const bool by_depth : {true, false}) {
        const ColourPlanes result = corrected(preview, exact, runs_of_disc(by_depth));
        double on_disc = 0.0;
        double count = 0.0;
        for (std::uint32_t y = 0; y < size; ++y)
            for (std::uint32_t x = 0; x < size; ++x) {
                const double u = (x + 0.5) / size;
                const double v = (y + 0.5) / size;
                if (is_on_disc(u, v)) {
                    on_disc += static_cast<double>(result[1].at(x, y)) - truth(u, v);
                    count += 1.0;
                } else {
                    ASSERT_NEAR(result[1].at(x, y), truth(u, v), 1e-5) << x << " " << y;
                }
            }
        EXPECT_LT(std::abs(on_disc / count), 2.0) << by_depth;  // of 20
    }
}

TEST(CorrectPreview, FlatFeaturesGiveTheSameAsNone) {
    const ExactHalves exact{image_of(truth, 0.4, 1), image_of(truth, 0.4, 2), 0.5F};
    const ColourPlanes preview = image_of(preview_value);
    Image flat{size, size, {}, {}};
    flat.layers = {{"depth", "Z", std::vector<float>(pixels, 3.0F), false, false},
                   {"normal", "XYZ", std::vector<float>(3 * pixels, 0.5F), false, false}};
    const ColourPlanes with = corrected(preview, exact, find_surface_runs(flat));
    const ColourPlanes without = corrected(preview, exact, whole);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(with[c].values, without[c].values);
}

TEST(CorrectPreview, ValuesThatAreNotNumbersStayOut) {
    ColourPlanes first = image_of(truth, 0.1, 1);
    first[0].values[7] = std::nanf("");
    first[1].values[size * 50 + 50] = HUGE_VALF;
    const ColourPlanes preview = image_of(preview_value);
    const ColourPlanes result = corrected(preview, {first, image_of(truth, 0.1, 2), 0.5F}, whole);
    for (const Plane& plane : result)
        for (const float value : plane.values) ASSERT_TRUE(std::isfinite(value));
}

Layer layer(const char* name, const char* channels, float value) {
    Layer made{name, channels, {}, false, false};
    made.values.assign(made.channels.size() * pixels, value);
    return made;
}

Image image_with(std::initializer_list<Layer> layers) {
    Image image;
    image.width = image.height = size;
    image.layers = layers;
    return image;
}

TEST(CorrectPreview, BeautyIsTheSumOfWhatIsCorrectedAndAveraged) {
    Image preview = image_with({layer("", "RGB", 1.0F), layer("alpha", "A", 0.5F),
                                layer("direct", "RGB", 0.5F), layer("indirect", "RGB", 0.4F),
                                layer("emission", "RGB", 0.1F), layer("depth", "Z", 3.0F)});
    const Image exact = image_with({layer("", "RGB", 1.3F), layer("alpha", "A", 1.0F),
                                    layer("direct", "RGB", 0.7F), layer("indirect", "RGB", 0.6F),
                                    layer("emission", "RGB", 0.0F), layer("depth", "Z", 4.0F)});
    correct_preview(preview, {exact, exact, 0.5, 64, 0.5});
    const auto expect = [&](const char* name, float value) {
        for (const float found : preview.find(name)->values) ASSERT_NEAR(found, value, 1e-5F);
    };
    expect("", 1.35F);
    expect("direct", 0.7F);
    expect("indirect", 0.6F);
    expect("emission", 0.05F);
    expect("alpha", 0.75F);
    expect("depth", 3.0F);
}

TEST(CorrectPreview, LightIsNeverNegative) {
    Image preview = image_with({layer("", "RGB", 0.1F), layer("direct", "RGB", 0.1F)});
    const Image exact = image_with({layer("", "RGB", -0.5F), layer("direct", "RGB", -0.5F)});
    correct_preview(preview, {exact, exact, 0.5, 64, 0.5});
    for (const Layer& found : preview.layers)
        for (const float value : found.values) ASSERT_EQ(value, 0.0F);
}

// Paths have this light in the layers of direct, indirect and emitted light.
TEST(CorrectPreview, WithLightThatPathsCountElsewhereBeautyAloneIsCorrected) {
    for (const char* const name : {"media", "reflection", "refraction", "glossy"}) {
        Image preview = image_with(
            {layer("", "RGB", 1.0F), layer("direct", "RGB", 0.5F), layer(name, "RGB", 0.5F)});
        const Image exact = image_with({layer("", "RGB", 2.0F), layer("direct", "RGB", 1.5F)});
        correct_preview(preview, {exact, exact, 0.5, 64, 0.5});
        EXPECT_NEAR(preview.find("")->values[7], 2.0F, 1e-5F) << name;
        EXPECT_EQ(preview.find("direct")->values[7], 0.5F) << name;
        EXPECT_EQ(preview.find(name)->values[7], 0.5F);
    }
}

}  // namespace
}  // namespace weft::correct_preview_test
