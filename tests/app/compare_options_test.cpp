// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "app/options.h"
#include "base/error.h"

namespace weft::compare_options_test {
namespace {

using Arguments = std::vector<std::string>;

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

TEST(CompareOptions, AreRead) {
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

TEST(CompareOptions, RefusesBadLines) {
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

}  // namespace
}  // namespace weft::compare_options_test
