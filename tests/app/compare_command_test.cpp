// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "image/load_image.h"
#include "tests/testing/compare_fixture.h"

namespace weft::compare_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::compared_numbers;
using test::image_of_halves;
using test::keys_of;
using test::ProgramResult;

using CompareCommand = test::CompareFixture;

TEST_F(CompareCommand, MeasuresAllOfAnExrPair) {
    const std::string reference = exr("a.exr", image_of_halves(32, 24, 0.5F));
    const std::string test = exr("b.exr", image_of_halves(32, 24, 0.5F, 0.25F));
    const json result = compare_json({reference, test});
    std::set<std::string> keys = compared_numbers;
    keys.insert({"hdrvdp", "hdrflip"});
    EXPECT_EQ(keys_of(result), keys);
    EXPECT_NEAR(result["mean_ratio"].get<double>(), 1.25, 1e-9);
    EXPECT_NEAR(result["bias"].get<double>(), 0.25, 1e-9);
    EXPECT_NEAR(result["relmse"].get<double>(), 0.5 * 0.25 / 1.01, 1e-9);
    EXPECT_NEAR(result["mape"].get<double>(), 0.5 * 0.5 / 1.01, 1e-9);
    EXPECT_NEAR(result["psnr"].get<double>(), -10.0 * std::log10(0.03125), 1e-9);
    EXPECT_EQ(result["hdrvdp"]["luminance_scale"], 100.0);
    EXPECT_EQ(result["hdrvdp"]["ppd"], 30.0);
    EXPECT_GT(result["hdrvdp"]["p75"], 1.0) << "a wide step of a half is seen";
    EXPECT_LE(result["hdrvdp"]["p95"], result["hdrvdp"]["p75"]);
    EXPECT_NEAR(result["hdrflip"]["ppd"].get<double>(), 67.0206, 1e-3);
    EXPECT_GT(result["hdrflip"]["mean"], 0.05);
}

TEST_F(CompareCommand, MeasuresAllOfAPngPair) {
    const std::string reference = png("a.png", image_of_halves(32, 24, 0.21404114F));
    const std::string test = png("b.png", image_of_halves(32, 24, 1.0F));
    const json result = compare_json({reference, test, "--metric", "all"});
    std::set<std::string> keys = compared_numbers;
    keys.insert({"hdrvdp", "flip"});
    EXPECT_EQ(keys_of(result), keys);
    // Codes 127 and 128 by dither against 255.
    EXPECT_NEAR(result["psnr"].get<double>(), 20.0 * std::log10(2.0), 0.05);
    EXPECT_EQ(result["hdrvdp"]["luminance_scale"], 80.0);
    EXPECT_GT(result["flip"]["mean"], 0.1);
    EXPECT_EQ(result["flip"].value("exposures", 0), 0);
}

TEST_F(CompareCommand, EqualImagesDifferByNothing) {
    const std::string reference = exr("a.exr", image_of_halves(32, 24, 0.5F, 0.25F));
    const json result = compare_json({reference, reference});
    EXPECT_EQ(result["hdrvdp"]["p75"], 0.0);
    EXPECT_EQ(result["hdrflip"]["mean"], 0.0);
    EXPECT_EQ(result["relmse"], 0.0);
    EXPECT_EQ(result["mape"], 0.0);
    EXPECT_EQ(result["bias"], 0.0);
    EXPECT_EQ(result["mean_ratio"], 1.0);
    EXPECT_EQ(result["ssim"], 1.0);
    EXPECT_TRUE(result["psnr"].is_null()) << "JSON has no infinity";
    EXPECT_TRUE(result["pu21_psnr"].is_null());
    const ProgramResult table = compare({reference, reference});
    EXPECT_EQ(table.exit_code, 0);
    EXPECT_NE(table.out.find("inf"), std::string::npos);
}

TEST_F(CompareCommand, BlackReferencesHaveNoRelativeErrors) {
    const std::string black = exr("black.exr", image_of_halves(32, 24, 0.0F));
    const std::string grey = exr("grey.exr", image_of_halves(32, 24, 0.5F));
    const json result = compare_json({black, grey});
    for (const char* key : {"relmse", "relmse_trimmed", "mape", "bias", "mean_ratio"})
        EXPECT_TRUE(result[key].is_null()) << key;
    EXPECT_NEAR(result["psnr"].get<double>(), 20.0 * std::log10(2.0), 1e-9);
    EXPECT_TRUE(result["hdrflip"]["mean"].is_number());
    EXPECT_TRUE(result["hdrvdp"]["p75"].is_number());
    EXPECT_NE(compare({black, grey}).out.find("undefined"), std::string::npos);
    const json same = compare_json({black, black});
    EXPECT_EQ(same["relmse"], 0.0);
    EXPECT_TRUE(same["mean_ratio"].is_null());
    EXPECT_EQ(compare({black, grey, "--metric", "relmse", "--map", file("map.png")}).exit_code, 0);
}

TEST_F(CompareCommand, ImagesOfOnePixelAreMeasured) {
    const std::string one = exr("one.exr", image_of_halves(1, 1, 0.5F));
    const json result = compare_json({one, one});
    EXPECT_TRUE(result["hdrvdp"]["p75"].is_null());
    EXPECT_TRUE(result["ssim"].is_null()) << "no window fits";
    EXPECT_EQ(result["hdrflip"]["mean"], 0.0);
    expect_error(compare({one, one, "--metric", "hdrvdp", "--map", file("map.png")}), 2,
                 "too small for a map");
}

TEST_F(CompareCommand, MetricsAreChosen) {
    const std::string a = exr("a.exr", image_of_halves(32, 24, 0.5F));
    const std::string b = exr("b.exr", image_of_halves(32, 24, 0.5F, 0.25F));
    const json two = compare_json({a, b, "--metric", "ssim", "--metric", "bias"});
    EXPECT_EQ(keys_of(two), (std::set<std::string>{"ssim", "bias"}));
    EXPECT_EQ(keys_of(compare_json({a, b, "--metric", "flip"})), (std::set<std::string>{"hdrflip"}))
        << "FLIP as it suits the pair";
    const std::string c = png("c.png", image_of_halves(32, 24, 0.5F));
    EXPECT_EQ(keys_of(compare_json({c, c, "--metric", "flip", "--metric", "hdrflip"})),
              (std::set<std::string>{"flip", "hdrflip"}));
    EXPECT_EQ(keys_of(compare_json({c, b, "--metric", "flip"})), (std::set<std::string>{"hdrflip"}))
        << "a mixed pair is one of scenes";
}

TEST_F(CompareCommand, TheProtocolIsStatedAndChangesTheResult) {
    const std::string a = exr("a.exr", image_of_halves(64, 48, 0.5F));
    Image speckled = image_of_halves(64, 48, 0.5F, 0.02F);
    for (std::size_t i = 0; i < speckled.layers[0].values.size(); i += 5)
        speckled.layers[0].values[i] += 0.01F;
    const std::string b = exr("b.exr", speckled);
    const auto mean = [&](const test::CompareArguments& more) {
        test::CompareArguments arguments = {a, b, "--metric", "hdrvdp", "--metric", "flip"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return compare_json(arguments);
    };
    const json display = mean({});
    const json published = mean({"--luminance-scale", "1"});
    const json near = mean({"--ppd", "10"});
    EXPECT_EQ(published["hdrvdp"]["luminance_scale"], 1.0);
    EXPECT_LT(published["hdrvdp"]["mean"], display["hdrvdp"]["mean"]);
    EXPECT_EQ(near["hdrvdp"]["ppd"], 10.0);
    EXPECT_EQ(near["hdrflip"]["ppd"], 10.0);
    EXPECT_NE(near["hdrflip"]["mean"], display["hdrflip"]["mean"]);
    EXPECT_NE(mean({"--legacy-fan"})["hdrvdp"]["mean"], display["hdrvdp"]["mean"]);
    EXPECT_TRUE(mean({"--legacy-otf-grid"})["hdrvdp"]["legacy_otf_grid"].get<bool>());
    const std::string table = compare({a, b, "--luminance-scale", "1", "--ppd", "45"}).out;
    EXPECT_NE(table.find("1 cd/m2 at value 1, 45 pixels per degree"), std::string::npos) << table;
}

TEST_F(CompareCommand, LayersAreChosen) {
    Image image = image_of_halves(16, 16, 0.5F);
    image.layers.push_back({"depth", "Z", std::vector<float>(256, 2.0F)});
    image.layers.push_back({"normal", "XYZ", std::vector<float>(768, 0.5F)});
    const std::string a = exr("a.exr", image);
    image.layers[1].values.assign(256, 3.0F);
    const std::string b = exr("b.exr", image);
    EXPECT_EQ(compare_json({a, b, "--metric", "bias"})["bias"], 0.0);
    EXPECT_EQ(compare_json({a, b, "--metric", "bias", "--layer", "depth"})["bias"], 0.5);
    expect_error(compare({a, b, "--layer", "direct"}), 2,
                 "a.exr: has no layer 'direct', its layers are: beauty, 'depth', 'normal'");
    expect_error(compare({a, b, "--layer", "normal"}), 2, "channels 'XYZ'");
    image.layers.erase(image.layers.begin());
    expect_error(compare({exr("c.exr", image), b}), 2, "c.exr: has no beauty layer");
}

TEST_F(CompareCommand, MapsAreWritten) {
    const std::string a = exr("a.exr", image_of_halves(120, 40, 0.5F));
    const std::string b = exr("b.exr", image_of_halves(120, 40, 0.5F, 0.25F));
    std::set<std::vector<float>> seen;
    for (const char* metric : {"hdrvdp", "flip", "hdrflip", "relmse"}) {
        const std::string map = file(std::string(metric) + ".PNG");
        ASSERT_EQ(compare({a, b, "--metric", "psnr", "--metric", metric, "--map", map}).exit_code,
                  0);
        const Image image = load_image(map);
        EXPECT_EQ(image.width, 120u);
        EXPECT_GT(image.height, 40u) << "the scale is below";
        seen.insert(image.layers[0].values);
    }
    EXPECT_EQ(seen.size(), 3u) << "flip is hdrflip here";
    ASSERT_EQ(compare({a, b, "--map", file("all.png")}).exit_code, 0);
    EXPECT_EQ(test::text_of_file(file("all.png")), test::text_of_file(file("hdrvdp.PNG")))
        << "of all metrics HDR-VDP comes first";
}

TEST_F(CompareCommand, OutputsThatCannotBeWrittenAreCodeFive) {
    const std::string a = exr("a.exr", image_of_halves(16, 16, 0.5F));
    expect_error(compare({a, a, "--metric", "flip", "--map", file("missing/map.png")}), 5,
                 "map.png");
    if (!fs::exists("/dev/full")) return;
    test::RunningProgram::Settings settings;
    settings.standard_output = "/dev/full";
    EXPECT_EQ(run_program({"compare", a, a, "--metric", "psnr"}, settings).exit_code, 5);
}

TEST_F(CompareCommand, RefusesImagesThatCannotBeCompared) {
    const std::string a = exr("a.exr", image_of_halves(16, 16, 0.5F));
    const std::string b = exr("b.exr", image_of_halves(16, 15, 0.5F));
    expect_error(compare({a, b}), 2,
                 "b.exr: has 16 x 15 pixels, expected 16 x 16 as the reference");
    Image image = image_of_halves(16, 16, 0.5F);
    image.layers[0].values[16 * 3 + 5] = std::numeric_limits<float>::quiet_NaN();
    image.layers[0].values[16 * 16 + 16 * 3 + 5] = std::numeric_limits<float>::infinity();
    image.layers[0].values[2 * 16 * 16 + 16 * 9] = -std::numeric_limits<float>::infinity();
    const std::string c = exr("c.exr", image);
    expect_error(compare({a, c}), 2,
                 "c.exr: 2 of 256 pixels are NaN or infinite, the first at column 5, row 3");
    expect_error(compare({c, a}), 2, "c.exr: 2 of 256 pixels");
    expect_error(compare({a, file("missing.exr")}), 2, "missing.exr: cannot be opened");
    expect_error(compare({a, folder_.write("x.png", "nonsense")}), 2, "x.png: is not an image");
    expect_error(compare({a, folder_.path()}), 2, "not a regular file");
}

/// The folder of published images; empty where it is not at hand.
fs::path published_images() {
    const char* shared = std::getenv("WEFT_SHARED");
    const fs::path folder =
        (shared != nullptr ? fs::path(shared) : fs::path(WEFT_SOURCE_DIR) / "../shared") /
        "data/metrics";
    return fs::exists(folder) ? folder : fs::path();
}

TEST_F(CompareCommand, FlipOfAPublishedPair) {
    const fs::path folder = published_images();
    if (folder.empty()) GTEST_SKIP() << "the published images are not there";
    const fs::path tree = folder / "flip-tree/etc";
    const json result = compare_json(
        {tree / "tree-ref.png", tree / "tree-test.png", "--metric", "flip", "--ppd", "67"});
    EXPECT_NEAR(result["flip"]["mean"].get<double>(), 0.133285, 1e-4);
    EXPECT_EQ(result["flip"]["ppd"], 67.0);
}

// What the authors' program says of the pair they publish it with.
TEST_F(CompareCommand, HdrVdpOfAPublishedPair) {
    const fs::path folder = published_images();
    if (folder.empty()) GTEST_SKIP() << "the published images are not there";
    const fs::path pair = folder / "hdrvdp-pair/test";
    const json result =
        compare_json({pair / "memorial_mask.hdr", pair / "memorial_sinnoise.hdr", "--metric",
                      "hdrvdp", "--luminance-scale", "1", "--legacy-fan", "--legacy-otf-grid"});
    EXPECT_NEAR(result["hdrvdp"]["p75"].get<double>(), 29.107, 0.05);
    EXPECT_NEAR(result["hdrvdp"]["p95"].get<double>(), 24.129, 0.05);
    EXPECT_NEAR(result["hdrvdp"]["mean"].get<double>(), 0.355684, 0.001);
}

}  // namespace
}  // namespace weft::compare_command_test
