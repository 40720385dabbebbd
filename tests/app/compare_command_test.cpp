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
#include <random>
#include <set>
#include <string>
#include <vector>

#include "app/options.h"
#include "base/error.h"
#include "image/exr.h"
#include "image/load_image.h"
#include "image/png.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::compare_command_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::ProgramResult;
using test::run_program;

using Arguments = std::vector<std::string>;

/// An image of one colour; `shift` is added to the pixels of its right half.
Image make_image(std::uint32_t width, std::uint32_t height, float value, float shift = 0.0F) {
    Image image;
    image.width = width;
    image.height = height;
    const std::size_t pixels = std::size_t{width} * height;
    image.layers = {{"", "RGB", std::vector<float>(3 * pixels, value)}};
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        if (i % width >= width / 2) image.layers[0].values[i] += shift;
    return image;
}

class CompareCommand : public testing::Test {
  protected:
    [[nodiscard]] std::string exr(const std::string& name, const Image& image) const {
        write_exr(folder_.path() / name, image);
        return folder_.path() / name;
    }
    [[nodiscard]] std::string png(const std::string& name, const Image& image) const {
        write_png(folder_.path() / name, image, 0.0);
        return folder_.path() / name;
    }
    [[nodiscard]] std::string file(const std::string& name) const { return folder_.path() / name; }

    static ProgramResult compare(Arguments arguments) {
        arguments.insert(arguments.begin(), "compare");
        return run_program(arguments);
    }
    static json compare_json(Arguments arguments) {
        arguments.emplace_back("--json");
        const ProgramResult result = compare(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        json parsed = json::parse(result.out, nullptr, false);
        EXPECT_FALSE(parsed.is_discarded()) << result.out;
        return parsed;
    }
    static void expect_error(const ProgramResult& result, int code, const std::string& part) {
        EXPECT_EQ(result.exit_code, code);
        EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_EQ(result.out, "");
    }

    TemporaryFolder folder_;
};

std::set<std::string> keys_of(const json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.insert(key);
    return keys;
}

const std::set<std::string> numbers = {"relmse", "relmse_trimmed", "mape",
                                       "bias",   "mean_ratio",     "psnr",
                                       "ssim",   "pu21_psnr",      "pu21_ssim"};

TEST_F(CompareCommand, MeasuresAllOfAnExrPair) {
    const std::string reference = exr("a.exr", make_image(32, 24, 0.5F));
    const std::string test = exr("b.exr", make_image(32, 24, 0.5F, 0.25F));
    const json result = compare_json({reference, test});
    std::set<std::string> keys = numbers;
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
    const std::string reference = png("a.png", make_image(32, 24, 0.21404114F));
    const std::string test = png("b.png", make_image(32, 24, 1.0F));
    const json result = compare_json({reference, test, "--metric", "all"});
    std::set<std::string> keys = numbers;
    keys.insert({"hdrvdp", "flip"});
    EXPECT_EQ(keys_of(result), keys);
    // Codes 127 and 128 by dither against 255.
    EXPECT_NEAR(result["psnr"].get<double>(), 20.0 * std::log10(2.0), 0.05);
    EXPECT_EQ(result["hdrvdp"]["luminance_scale"], 80.0);
    EXPECT_GT(result["flip"]["mean"], 0.1);
    EXPECT_EQ(result["flip"].value("exposures", 0), 0);
}

TEST_F(CompareCommand, EqualImagesDifferByNothing) {
    const std::string reference = exr("a.exr", make_image(32, 24, 0.5F, 0.25F));
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
    const std::string black = exr("black.exr", make_image(32, 24, 0.0F));
    const std::string grey = exr("grey.exr", make_image(32, 24, 0.5F));
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
    const std::string one = exr("one.exr", make_image(1, 1, 0.5F));
    const json result = compare_json({one, one});
    EXPECT_TRUE(result["hdrvdp"]["p75"].is_null());
    EXPECT_TRUE(result["ssim"].is_null()) << "no window fits";
    EXPECT_EQ(result["hdrflip"]["mean"], 0.0);
    expect_error(compare({one, one, "--metric", "hdrvdp", "--map", file("map.png")}), 2,
                 "too small for a map");
}

TEST_F(CompareCommand, MetricsAreChosen) {
    const std::string a = exr("a.exr", make_image(32, 24, 0.5F));
    const std::string b = exr("b.exr", make_image(32, 24, 0.5F, 0.25F));
    const json two = compare_json({a, b, "--metric", "ssim", "--metric", "bias"});
    EXPECT_EQ(keys_of(two), (std::set<std::string>{"ssim", "bias"}));
    EXPECT_EQ(keys_of(compare_json({a, b, "--metric", "flip"})), (std::set<std::string>{"hdrflip"}))
        << "FLIP as it suits the pair";
    const std::string c = png("c.png", make_image(32, 24, 0.5F));
    EXPECT_EQ(keys_of(compare_json({c, c, "--metric", "flip", "--metric", "hdrflip"})),
              (std::set<std::string>{"flip", "hdrflip"}));
    EXPECT_EQ(keys_of(compare_json({c, b, "--metric", "flip"})), (std::set<std::string>{"hdrflip"}))
        << "a mixed pair is one of scenes";
}

TEST_F(CompareCommand, TheProtocolIsStatedAndChangesTheResult) {
    const std::string a = exr("a.exr", make_image(64, 48, 0.5F));
    Image speckled = make_image(64, 48, 0.5F, 0.02F);
    for (std::size_t i = 0; i < speckled.layers[0].values.size(); i += 5)
        speckled.layers[0].values[i] += 0.01F;
    const std::string b = exr("b.exr", speckled);
    const auto mean = [&](const Arguments& more) {
        Arguments arguments = {a, b, "--metric", "hdrvdp", "--metric", "flip"};
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
    Image image = make_image(16, 16, 0.5F);
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

/// An image of one colour with noise of that deviation; as many samples, of that seed, are noted in
/// its metadata.
Image noisy_image(float value, float deviation, unsigned seed, int samples) {
    Image image = make_image(48, 32, value);
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0.0F, deviation);
    for (float& x : image.layers[0].values) x += noise(random);
    image.metadata = {{"algorithm", "path"},
                      {"seed", std::to_string(seed)},
                      {"samples", std::to_string(samples)}};
    return image;
}

TEST_F(CompareCommand, TwoReferencesGiveUnbiasedErrorsAndFloors) {
    const std::string first = exr("a.exr", noisy_image(0.5F, 0.04F, 1, 16));
    const std::string second = exr("b.exr", noisy_image(0.5F, 0.02F, 2, 64));
    const std::string test = exr("c.exr", make_image(48, 32, 0.52F));
    const json result = compare_json({first, test, "--second-reference", second});
    std::set<std::string> keys = numbers;
    keys.insert({"hdrvdp", "hdrflip", "unbiased_mse", "unbiased_relmse"});
    EXPECT_EQ(keys_of(result), keys);
    // The mean of 1536 pixels and 3 channels of (e - a)(e - b) has a standard error of 1.8e-5; that
    // of a, which bias has as well, is 0.0006. One seed in 10,000 is four of these off.
    const json& mse = result["unbiased_mse"];
    EXPECT_NEAR(mse["value"].get<double>(), 0.02 * 0.02, 4.0 * 1.8e-5);
    EXPECT_LT(mse["low"], mse["value"]);
    EXPECT_LT(mse["value"], mse["high"]);
    EXPECT_NEAR(mse["high"].get<double>() - mse["low"].get<double>(), 2.0 * 1.96 * 1.8e-5, 5e-6);
    // Of the mean of the samples of both, which the metadata state: 80 of them.
    EXPECT_NEAR(mse["noise"].get<double>(), 0.04 * 0.04 * 16.0 / 80.0, 2.7e-5);
    const double size = 0.5 * 0.5 * 1.01;
    EXPECT_NEAR(result["unbiased_relmse"]["value"].get<double>(), 0.02 * 0.02 / size,
                4.0 * 1.8e-5 / size);
    EXPECT_GT(result["relmse"].get<double>(), 0.04 * 0.04 / size) << "which has the noise as well";
    const json direct = compare_json({first, second});
    EXPECT_EQ(result["hdrvdp"]["floor"]["p75"], direct["hdrvdp"]["p75"]);
    EXPECT_EQ(result["hdrvdp"]["floor"]["p95"], direct["hdrvdp"]["p95"]);
    EXPECT_EQ(result["hdrflip"]["floor"], direct["hdrflip"]["mean"]);
    EXPECT_FALSE(direct.contains("unbiased_mse"));
    EXPECT_FALSE(direct["hdrflip"].contains("floor"));
    const json one =
        compare_json({first, test, "--second-reference", second, "--metric", "unbiased_relmse"});
    EXPECT_EQ(keys_of(one), (std::set<std::string>{"unbiased_relmse"}));
}

TEST_F(CompareCommand, TheTableSaysWhatIsWithinTheFloor) {
    const std::string first = exr("a.exr", noisy_image(0.5F, 0.02F, 1, 16));
    const std::string second = exr("b.exr", noisy_image(0.5F, 0.02F, 4, 16));
    const auto table = [&](float value, float deviation) {
        return compare({first, exr("c.exr", noisy_image(value, deviation, 3, 1)),
                        "--second-reference", second, "--metric", "hdrflip", "--metric",
                        "unbiased_mse"})
            .out;
    };
    const std::string near = table(0.5F, 0.001F);
    EXPECT_NE(near.find("the second reference against REF; TEST differs by no more"),
              std::string::npos)
        << near;
    EXPECT_NE(near.find("with a confidence of 95 %; 0 is among these"), std::string::npos) << near;
    const std::string far = table(0.5F, 0.2F);
    EXPECT_NE(far.find("the second reference against REF\n"), std::string::npos) << far;
    EXPECT_NE(far.find("with a confidence of 95 %\n"), std::string::npos) << far;
}

TEST_F(CompareCommand, HalvesOfAReferenceAreUsed) {
    Image reference = noisy_image(0.5F, 0.03F, 1, 32);
    const Image other = noisy_image(0.5F, 0.03F, 2, 32);
    const std::string first = exr("first.exr", reference);
    const std::string second = exr("second.exr", other);
    std::vector<float> whole = reference.layers[0].values;
    for (std::size_t i = 0; i < whole.size(); ++i)
        whole[i] = 0.5F * (whole[i] + other.layers[0].values[i]);
    reference.layers.push_back({"first_half", "RGB", reference.layers[0].values});
    reference.layers.push_back({"second_half", "RGB", other.layers[0].values});
    reference.layers[0].values = whole;
    const std::string halves = exr("halves.exr", reference);
    const std::string test = exr("test.exr", make_image(48, 32, 0.52F));
    const json split = compare_json({halves, test});
    const json pair = compare_json({first, test, "--second-reference", second});
    EXPECT_EQ(split["unbiased_mse"], pair["unbiased_mse"]);
    EXPECT_EQ(split["hdrvdp"]["floor"], pair["hdrvdp"]["floor"]);
    EXPECT_LT(split["hdrflip"]["mean"], pair["hdrflip"]["mean"]) << "of the whole, not of a half";
    const json plain = compare_json({exr("whole.exr",
                                         [&] {
                                             Image image = reference;
                                             image.layers.resize(1);
                                             return image;
                                         }()),
                                     test});
    EXPECT_EQ(split["hdrflip"]["mean"], plain["hdrflip"]["mean"]);
    EXPECT_NE(compare({halves, test})
                  .out.find("one half of REF against the other; the whole has "
                            "less noise"),
              std::string::npos);
    const json itself = compare_json({halves, halves});
    EXPECT_TRUE(itself["unbiased_mse"].is_null()) << "an image is not independent of itself";
    EXPECT_TRUE(itself["unbiased_relmse"].is_null());
    EXPECT_EQ(itself["hdrflip"]["mean"], 0.0);
    // Of other layers there are no halves, and a second reference goes before them.
    EXPECT_FALSE(
        compare_json({halves, halves, "--layer", "first_half", "--metric", "flip"})["hdrflip"]
            .contains("floor"));
    const json both =
        compare_json({halves, test, "--second-reference", second, "--metric", "unbiased_mse"});
    EXPECT_NE(both["unbiased_mse"], split["unbiased_mse"]);
    expect_error(compare({first, test, "--metric", "unbiased_mse"}), 2,
                 "first.exr: holds no halves, without which there is no unbiased_mse");
}

TEST_F(CompareCommand, ReferencesThatAreNotIndependentAreRefused) {
    const Image image = noisy_image(0.5F, 0.02F, 1, 16);
    const std::string first = exr("a.exr", image);
    const std::string test = exr("c.exr", make_image(48, 32, 0.52F));
    const auto refused = [&](const std::string& tested, const std::string& second, int code,
                             const std::string& part) {
        expect_error(compare({first, tested, "--second-reference", second}), code, part);
    };
    refused(test, first, 1, "--second-reference: names the same file as REF");
    refused(test, (folder_.path() / "." / "a.exr").string(), 1, "the same file as REF");
    fs::create_symlink("c.exr", file("link.exr"));
    refused(test, file("link.exr"), 1, "--second-reference: names the same file as TEST");
    refused(test, exr("copy.exr", image), 2, "copy.exr: has the same pixels as the reference");
    const std::string second = exr("b.exr", noisy_image(0.5F, 0.02F, 2, 16));
    refused(exr("again.exr", noisy_image(0.5F, 0.02F, 2, 16)), second, 2,
            "again.exr: has the same pixels as one of the references");
    refused(test, exr("small.exr", make_image(48, 31, 0.5F)), 2,
            "small.exr: has 48 x 31 pixels, expected 48 x 32 as the reference");
    Image more = noisy_image(0.5F, 0.02F, 3, 32);
    more.metadata["seed"] = "1";
    refused(test, exr("more.exr", more), 2, "more.exr: has samples of the reference");
    refused(test, file("gone.exr"), 2, "gone.exr: cannot be opened");
}

TEST_F(CompareCommand, PartsOfDisjointSamplesAreIndependent) {
    const auto part = [&](const std::string& name, const std::string& samples) {
        const ProgramResult result =
            run_program({"render", test::shipped_scene("cornell-box.gltf"), "--algorithm", "path",
                         "--size", "16x16", "--samples", samples, "--backend", "native",
                         "--progress", "none", "-o", file(name)});
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return file(name);
    };
    const std::string first = part("a.exr", "0:8");
    const std::string second = part("b.exr", "8:16");
    const std::string shared = part("c.exr", "7:15");
    const std::string test = part("d.exr", "100:101");
    EXPECT_GT(compare_json({first, test, "--second-reference", second, "--metric",
                            "unbiased_mse"})["unbiased_mse"]["value"],
              0.0);
    expect_error(compare({first, test, "--second-reference", shared}), 2,
                 "c.exr: has samples of the reference");
}

TEST_F(CompareCommand, MapsAreWritten) {
    const std::string a = exr("a.exr", make_image(120, 40, 0.5F));
    const std::string b = exr("b.exr", make_image(120, 40, 0.5F, 0.25F));
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
    const std::string a = exr("a.exr", make_image(16, 16, 0.5F));
    expect_error(compare({a, a, "--metric", "flip", "--map", file("missing/map.png")}), 5,
                 "map.png");
    if (!fs::exists("/dev/full")) return;
    test::RunningProgram::Settings settings;
    settings.standard_output = "/dev/full";
    EXPECT_EQ(run_program({"compare", a, a, "--metric", "psnr"}, settings).exit_code, 5);
}

TEST_F(CompareCommand, RefusesImagesThatCannotBeCompared) {
    const std::string a = exr("a.exr", make_image(16, 16, 0.5F));
    const std::string b = exr("b.exr", make_image(16, 15, 0.5F));
    expect_error(compare({a, b}), 2,
                 "b.exr: has 16 x 15 pixels, expected 16 x 16 as the reference");
    Image image = make_image(16, 16, 0.5F);
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

CompareOptions parse(Arguments arguments) {
    arguments.insert(arguments.begin(), {"weft", "compare"});
    std::vector<const char*> argv;
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    return std::get<CompareOptions>(parse_command_line(static_cast<int>(argv.size()), argv.data()));
}

std::string refusal(const Arguments& arguments) {
    try {
        static_cast<void>(parse(arguments));
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::usage);
        return error.what();
    }
    return "no failure";
}

TEST(CompareCommandOptions, AreRead) {
    const CompareOptions plain = parse({"a.exr", "b.exr"});
    EXPECT_EQ(plain.reference, "a.exr");
    EXPECT_EQ(plain.test, "b.exr");
    EXPECT_FALSE(plain.second_reference.has_value());
    EXPECT_TRUE(plain.metrics.empty() && !plain.luminance_scale && !plain.ppd && !plain.map &&
                !plain.layer && !plain.json && !plain.legacy_fan && !plain.legacy_otf_grid);
    const CompareOptions all = parse({"--metric",
                                      "ssim",
                                      "a.exr",
                                      "--luminance-scale=1",
                                      "b.exr",
                                      "--ppd",
                                      "60.5",
                                      "--map",
                                      "m.png",
                                      "--metric",
                                      "flip",
                                      "--metric",
                                      "ssim",
                                      "--layer",
                                      "direct",
                                      "--json",
                                      "--legacy-fan",
                                      "--legacy-otf-grid",
                                      "--second-reference",
                                      "c.exr"});
    EXPECT_EQ(all.second_reference, "c.exr");
    EXPECT_EQ(all.metrics, (std::vector<Metric>{Metric::ssim, Metric::flip}));
    EXPECT_EQ(all.luminance_scale, 1.0);
    EXPECT_EQ(all.ppd, 60.5);
    EXPECT_EQ(all.map, "m.png");
    EXPECT_EQ(all.layer, "direct");
    EXPECT_TRUE(all.json && all.legacy_fan && all.legacy_otf_grid);
    EXPECT_TRUE(parse({"a", "b", "--metric", "psnr", "--metric", "all"}).metrics.empty());
    EXPECT_EQ(to_string(Metric::pu21_ssim), "pu21_ssim");
    EXPECT_EQ(to_string(Metric::unbiased_relmse), "unbiased_relmse");
}

TEST(CompareCommandOptions, RefusesBadLines) {
    EXPECT_NE(refusal({}).find("two images are needed"), std::string::npos);
    EXPECT_NE(refusal({"a.exr"}).find("two images are needed"), std::string::npos);
    EXPECT_NE(refusal({"a", "b", "c"}).find("unexpected argument 'c'"), std::string::npos);
    EXPECT_NE(refusal({"a", "b", "--metric", "flop"}).find("did you mean 'flip'"),
              std::string::npos);
    for (const char* bad : {"0", "-1", "nan", "inf", "x", "1e9"}) {
        EXPECT_EQ(refusal({"a", "b", "--luminance-scale", bad}).find("--luminance-scale"), 0u);
        EXPECT_EQ(refusal({"a", "b", "--ppd", bad}).find("--ppd"), 0u);
    }
    EXPECT_EQ(refusal({"a", "b", "--map", "m.exr"}).find("--map"), 0u);
    EXPECT_EQ(refusal({"a.png", "b.png", "--map", "./b.png"}).find("--map: names the same"), 0u);
    EXPECT_EQ(refusal({"a.png", "b.png", "--second-reference", "c.png", "--map", "c.png"})
                  .find("--map: names the same"),
              0u);
    EXPECT_EQ(refusal({"a", "b", "--map", "m.png", "--metric", "ssim"}).find("--map: no metric"),
              0u);
    EXPECT_EQ(refusal({"a", "b", "--ppd", "1", "--ppd", "2"}), "--ppd: is given more than once");
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
