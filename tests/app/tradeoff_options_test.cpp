// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/tradeoff_options.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/testing/parse_options.h"
#include "tradeoff/tradeoff_result.h"

namespace weft::tradeoff_options_test {
namespace {

using test::parse;
using test::refusal;

TradeoffOptions tradeoff(std::initializer_list<const char*> arguments) {
    std::vector<const char*> argv = {"weft", "tradeoff", "scenes/box.gltf"};
    argv.insert(argv.end(), arguments);
    return std::get<TradeoffOptions>(
        parse_command_line(static_cast<int>(argv.size()), argv.data()));
}

TEST(TradeoffOptions, Defaults) {
    const TradeoffOptions options = tradeoff({});
    EXPECT_EQ(options.scene, "scenes/box.gltf");
    EXPECT_EQ(options.output, "box-tradeoff");
    EXPECT_EQ(options.repetitions, 5U);
    EXPECT_EQ(options.reference_spp, 1024U);
    EXPECT_EQ(options.seed, 0U);
    EXPECT_EQ(options.measure, ErrorMeasure::hdrflip);
    EXPECT_EQ(options.progress, ProgressMode::automatic);
    EXPECT_FALSE(options.quick || options.verify || options.backend || options.device ||
                 options.threads || options.size || options.camera || options.references ||
                 options.others);
    EXPECT_TRUE(options.algorithms.empty() && options.budgets_ms.empty() && options.errors.empty());
}

TEST(TradeoffOptions, QuickChangesWhatIsNotGiven) {
    EXPECT_EQ(tradeoff({"--quick"}).repetitions, 3U);
    EXPECT_EQ(tradeoff({"--quick"}).reference_spp, 256U);
    EXPECT_EQ(tradeoff({"--quick", "--repetitions", "7"}).repetitions, 7U);
    EXPECT_EQ(tradeoff({"--reference-spp", "64", "--quick"}).reference_spp, 64U);
    EXPECT_TRUE(tradeoff({"--reference-spp", "64"}).reference_spp_given);
    EXPECT_FALSE(tradeoff({"--quick"}).reference_spp_given);
}

TEST(TradeoffOptions, ReadsEveryOption) {
    const TradeoffOptions options = tradeoff({"-o",
                                              "out",
                                              "--algorithms",
                                              "path,ais",
                                              "--measure",
                                              "vdp75_display",
                                              "--budget",
                                              "1s",
                                              "--budget",
                                              "50ms",
                                              "--budget",
                                              "1000ms",
                                              "--error",
                                              "0.5",
                                              "--error",
                                              "0.1",
                                              "--peers",
                                              "peers.json",
                                              "--verify",
                                              "--size",
                                              "64x48",
                                              "--camera",
                                              "top",
                                              "--backend",
                                              "native",
                                              "--device",
                                              "1",
                                              "--threads",
                                              "3",
                                              "--seed",
                                              "9",
                                              "--references",
                                              "refs",
                                              "--progress",
                                              "none",
                                              "--verbose"});
    EXPECT_EQ(options.output, "out");
    EXPECT_EQ(options.algorithms, (std::vector<std::string>{"ais", "path"}));
    EXPECT_EQ(options.measure, ErrorMeasure::vdp75_display);
    EXPECT_EQ(options.budgets_ms, (std::vector<double>{50.0, 1000.0}));
    EXPECT_EQ(options.errors, (std::vector<double>{0.1, 0.5}));
    EXPECT_EQ(options.others, "peers.json");
    EXPECT_TRUE(options.verify);
    ASSERT_TRUE(options.size);
    EXPECT_EQ(options.size->width, 64U);
    EXPECT_EQ(options.size->height, 48U);
    EXPECT_EQ(options.camera, "top");
    EXPECT_EQ(options.backend, Backend::native);
    EXPECT_EQ(options.device, "1");
    EXPECT_EQ(options.threads, 3U);
    EXPECT_EQ(options.seed, 9U);
    EXPECT_EQ(options.references, "refs");
    EXPECT_EQ(options.progress, ProgressMode::none);
    EXPECT_TRUE(options.verbose);
}

TEST(TradeoffOptions, RefusesWhatMakesNoSense) {
    const auto refused = [](std::initializer_list<const char*> arguments) {
        return test::failure([&] { return tradeoff(arguments); });
    };
    EXPECT_EQ(refusal({"tradeoff"}), "no scene given, expected weft tradeoff SCENE");
    for (const char* const text : {"0", "1", "1001", "x"})
        EXPECT_EQ(refused({"--repetitions", text}).find("--repetitions: "), 0U) << text;
    for (const char* const text : {"0", "1", "-4"})
        EXPECT_EQ(refused({"--reference-spp", text}).find("--reference-spp: "), 0U) << text;
    EXPECT_EQ(tradeoff({"--algorithms", "instant-caching,adaptive,igi"}).algorithms,
              (std::vector<std::string>{"ais", "igi", "ic"}));
    for (const char* const text : {"tic", "ais,ais", "adaptive,ais", "ais,", "", "all"})
        EXPECT_EQ(refused({"--algorithms", text}).find("--algorithms: "), 0U) << text;
    for (const char* const text : {"0", "-1", "nan", "five"})
        EXPECT_EQ(refused({"--error", text}).find("--error: "), 0U) << text;
    for (const char* const text : {"300", "0s", "-1s"})
        EXPECT_EQ(refused({"--budget", text}).find("--budget: "), 0U) << text;
    EXPECT_EQ(refused({"--measure", "psnr"}).find("--measure: "), 0U);
    EXPECT_EQ(refused({"--size", "16384x16384"}).find("--size: "), 0U);
    EXPECT_EQ(refused({"--size", "1x2"}).find("--size: "), 0U);
    EXPECT_EQ(refused({"--quality", "high"}).find("unknown option '--quality'"), 0U);
}

TEST(TradeoffOptions, TheCommandLineMeasuresTheSameAgain) {
    TradeoffOptions options = tradeoff({"--quick", "--size", "64x48", "--camera", "it's", "--error",
                                        "0.1", "--budget", "50ms", "--verify"});
    const std::string line = tradeoff_command_line(options);
    EXPECT_EQ(line,
              "weft tradeoff scenes/box.gltf --quick --size 64x48 --camera 'it'\\''s' --measure "
              "hdrflip --repetitions 3 --seed 0 --budget 50ms --error 0.1 --verify");
    options = tradeoff({"--reference-spp", "64"});
    EXPECT_NE(tradeoff_command_line(options).find(" --reference-spp 64 "), std::string::npos);
}

}  // namespace
}  // namespace weft::tradeoff_options_test
