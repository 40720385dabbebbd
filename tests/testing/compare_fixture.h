// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Pairs of images and runs of `weft compare` on them, for its tests.
#ifndef WEFT_TESTS_TESTING_COMPARE_FIXTURE_H
#define WEFT_TESTS_TESTING_COMPARE_FIXTURE_H

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "image/exr.h"
#include "image/png.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::test {
using CompareArguments = std::vector<std::string>;

/// An image of one colour; `shift` is added to the pixels of its right half.
inline Image image_of_halves(std::uint32_t width, std::uint32_t height, float value,
                             float shift = 0.0F) {
    Image image;
    image.width = width;
    image.height = height;
    const std::size_t pixels = std::size_t{width} * height;
    image.layers = {{"", "RGB", std::vector<float>(3 * pixels, value)}};
    for (std::size_t i = 0; i < 3 * pixels; ++i)
        if (i % width >= width / 2) image.layers[0].values[i] += shift;
    return image;
}

/// Runs `weft compare` on images in a folder of its own.
class CompareFixture : public testing::Test {
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

    static ProgramResult compare(CompareArguments arguments) {
        arguments.insert(arguments.begin(), "compare");
        return run_program(arguments);
    }
    static nlohmann::json compare_json(CompareArguments arguments) {
        arguments.emplace_back("--json");
        const ProgramResult result = compare(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        nlohmann::json parsed = nlohmann::json::parse(result.out, nullptr, false);
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

inline std::set<std::string> keys_of(const nlohmann::json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.insert(key);
    return keys;
}

/// What the JSON of every pair holds as single numbers.
inline const std::set<std::string> compared_numbers = {"relmse", "relmse_trimmed", "mape",
                                                       "bias",   "mean_ratio",     "psnr",
                                                       "ssim",   "pu21_psnr",      "pu21_ssim"};

}  // namespace weft::test

#endif
