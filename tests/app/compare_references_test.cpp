// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "tests/testing/compare_fixture.h"

// Pairs with a second reference, or with the halves of one.

namespace weft::compare_references_test {
namespace {

using nlohmann::json;
using test::compared_numbers;
using test::image_of_halves;
using test::keys_of;
using test::ProgramResult;

using CompareReferences = test::CompareFixture;

/// An image of one colour with noise of that deviation; as many samples, of that seed, are noted in
/// its metadata.
Image noisy_image(float value, float deviation, unsigned seed, int samples) {
    Image image = image_of_halves(48, 32, value);
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0.0F, deviation);
    for (float& x : image.layers[0].values) x += noise(random);
    image.metadata = {{"algorithm", "path"},
                      {"seed", std::to_string(seed)},
                      {"samples", std::to_string(samples)}};
    return image;
}

TEST_F(CompareReferences, TwoReferencesGiveUnbiasedErrorsAndFloors) {
    const std::string first = exr("a.exr", noisy_image(0.5F, 0.04F, 1, 16));
    const std::string second = exr("b.exr", noisy_image(0.5F, 0.02F, 2, 64));
    const std::string test = exr("c.exr", image_of_halves(48, 32, 0.52F));
    const json result = compare_json({first, test, "--second-reference", second});
    std::set<std::string> keys = compared_numbers;
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

TEST_F(CompareReferences, TheTableSaysWhatIsWithinTheFloor) {
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

TEST_F(CompareReferences, HalvesOfAReferenceAreUsed) {
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
    const std::string test = exr("test.exr", image_of_halves(48, 32, 0.52F));
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

TEST_F(CompareReferences, ReferencesThatAreNotIndependentAreRefused) {
    const Image image = noisy_image(0.5F, 0.02F, 1, 16);
    const std::string first = exr("a.exr", image);
    const std::string test = exr("c.exr", image_of_halves(48, 32, 0.52F));
    const auto refused = [&](const std::string& tested, const std::string& second, int code,
                             const std::string& part) {
        expect_error(compare({first, tested, "--second-reference", second}), code, part);
    };
    refused(test, first, 1, "--second-reference: names the same file as REF");
    refused(test, (folder_.path() / "." / "a.exr").string(), 1, "the same file as REF");
    std::filesystem::create_symlink("c.exr", file("link.exr"));
    refused(test, file("link.exr"), 1, "--second-reference: names the same file as TEST");
    refused(test, exr("copy.exr", image), 2, "copy.exr: has the same pixels as the reference");
    const std::string second = exr("b.exr", noisy_image(0.5F, 0.02F, 2, 16));
    refused(exr("again.exr", noisy_image(0.5F, 0.02F, 2, 16)), second, 2,
            "again.exr: has the same pixels as one of the references");
    refused(test, exr("small.exr", image_of_halves(48, 31, 0.5F)), 2,
            "small.exr: has 48 x 31 pixels, expected 48 x 32 as the reference");
    Image more = noisy_image(0.5F, 0.02F, 3, 32);
    more.metadata["seed"] = "1";
    refused(test, exr("more.exr", more), 2, "more.exr: has samples of the reference");
    refused(test, file("gone.exr"), 2, "gone.exr: cannot be opened");
}

TEST_F(CompareReferences, PartsOfDisjointSamplesAreIndependent) {
    const auto part = [&](const std::string& name, const std::string& samples) {
        const ProgramResult result =
            test::run_program({"render", test::shipped_scene("cornell-box.gltf"), "--algorithm",
                               "path", "--size", "16x16", "--samples", samples, "--backend",
                               "native", "--progress", "none", "-o", file(name)});
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

}  // namespace
}  // namespace weft::compare_references_test
