// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/algorithm_options.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/options.h"
#include "plan/algorithm.h"
#include "tests/testing/parse_options.h"

namespace weft::algorithm_options_test {
namespace {

using test::render;
using test::render_refusal;

TEST(AlgorithmOptions, PathTracing) {
    const RenderOptions options =
        render({"--algorithm=path", "--samples", "8:24", "--target-error", "0.01", "--resume",
                "sums.exr", "--pixel-filter", "centre", "-o", "a.exr"});
    EXPECT_EQ(options.algorithm, Algorithm::path);
    EXPECT_EQ(*options.samples, (SampleRange{8, 24}));
    EXPECT_EQ(*options.target_error, 0.01);
    EXPECT_EQ(*options.resume, "sums.exr");
    EXPECT_TRUE(options.through_centres);
    EXPECT_FALSE(render({"--algorithm", "path"}).through_centres);
    for (const char* text : {"8", "8:", ":8", "8:8", "9:8", "-1:8", "0:16777217", "1:2:3", "a:b"})
        EXPECT_EQ(render_refusal({"--algorithm", "path", "--samples", text}).find("--samples: "),
                  0u)
            << text;
    for (const char* text : {"0", "-1", "2", "nan", "1%"})
        EXPECT_EQ(render_refusal({"--algorithm", "path", "--target-error", text})
                      .find("--target-error: "),
                  0u)
            << text;
    // Only references know these; samples are counted once, and kept where they fit.
    EXPECT_EQ(render_refusal({"--samples", "0:8"}).find("--samples: is for references"), 0u);
    EXPECT_EQ(render_refusal({"--resume", "a.exr"}).find("--resume: is for references"), 0u);
    EXPECT_NE(render_refusal({"--algorithm=path", "--samples", "0:8", "--spp", "8"}), "no failure");
    EXPECT_NE(render_refusal({"--algorithm=path", "--samples", "0:8", "-o", "a.png"}),
              "no failure");
    EXPECT_NE(render_refusal({"--algorithm=path", "--resume", "a.png"}), "no failure");
    EXPECT_NE(render_refusal({"--algorithm=path", "--resume", "./box.exr"}), "no failure");
}

TEST(AlgorithmOptions, Denoisers) {
    EXPECT_EQ(render({}).denoiser, Denoiser::none);
    EXPECT_EQ(render({"--denoise", "none"}).denoiser, Denoiser::none);
    EXPECT_EQ(render({"--denoise", "oidn"}).denoiser, Denoiser::oidn);
    for (const char* const algorithm : {"path", "reference"})
        EXPECT_EQ(render({"--denoise", "statistical", "--algorithm", algorithm}).denoiser,
                  Denoiser::statistical);
    for (const char* const algorithm : {"ais", "ir", "tic"})
        EXPECT_EQ(render_refusal({"--denoise", "statistical", "--algorithm", algorithm})
                      .find("--denoise: statistical needs the variance"),
                  0U);
    EXPECT_EQ(render_refusal({"--denoise", "opix"}).find("--denoise: "), 0U);
}

TEST(AlgorithmOptions, LongNamesMeanTheSameAsShortOnes) {
    for (std::size_t i = 0; i < algorithm_names.size(); ++i) {
        const std::string short_name(algorithm_names[i]);
        const std::string long_name(long_algorithm_names[i]);
        EXPECT_EQ(render({"--algorithm", long_name.c_str()}).algorithm, static_cast<Algorithm>(i));
        EXPECT_EQ(render({"--algorithm", short_name.c_str()}).algorithm, static_cast<Algorithm>(i));
    }
    EXPECT_EQ(render({"--indirect", "temporal-instant-caching"}).indirect, IndirectSource::tic);
    EXPECT_NE(render_refusal({"--algorithm", "adaptive "}), "no failure");
}

TEST(AlgorithmOptions, IndirectLightMayComeFromRecords) {
    EXPECT_FALSE(render({}).caches_indirect());
    EXPECT_TRUE(render({"--algorithm", "ic"}).caches_indirect());
    EXPECT_TRUE(render({"--indirect", "ic"}).caches_indirect());
    EXPECT_FALSE(render({"--algorithm", "amax", "--indirect", "vpl"}).caches_indirect());
    for (const char* const name : {"igi", "ir", "ic", "path"})
        EXPECT_EQ(render_refusal({"--algorithm", name, "--indirect", "ic"}),
                  "--indirect: is for adaptive sampling, expected --algorithm ais or amax");
    EXPECT_EQ(render_refusal({"--indirect", "cache"}),
              "--indirect: 'cache' is not valid, expected one of vpl, ic, tic, rays");
    for (const char* const name : {"--algorithm", "--indirect"})
        EXPECT_TRUE(render({name, "tic"}).caches_indirect() &&
                    render({name, "tic"}).keeps_records());
    EXPECT_FALSE(render({"--algorithm", "ic"}).keeps_records());
    EXPECT_TRUE(options_json(render({}))["indirect"].is_null());
    EXPECT_EQ(options_json(render({"--indirect", "rays"}))["indirect"], "rays");
    EXPECT_FALSE(render({"--indirect", "rays"}).caches_indirect());
    EXPECT_EQ(options_json(render({"--indirect", "ic"}))["indirect"], "ic");
}

TEST(AlgorithmOptions, RecordsThatOutlastTheirFrame) {
    const RenderOptions options =
        render({"--algorithm", "tic", "--cache-records", "1000", "--cache-masks", "off", "--frames",
                "0:2", "--edits", "edits.json"});
    EXPECT_EQ(options.cache_records, 1000U);
    EXPECT_FALSE(options.cache_masks);
    EXPECT_EQ(options.edits, "edits.json");
    EXPECT_TRUE(render({}).cache_masks);
    EXPECT_EQ(options_json(options)["cache_masks"], "off");
    EXPECT_EQ(options_json(options)["edits"], "edits.json");
    EXPECT_EQ(render_refusal({"--algorithm", "ic", "--cache-records", "9"}),
              "--cache-records: is for records that are kept from frame to frame, expected "
              "--algorithm tic or --indirect tic");
    EXPECT_EQ(render_refusal({"--cache-masks", "on"}).find("--cache-masks: is for"), 0U);
    for (const char* const text : {"0", "-1", "16777217", "x", "1.5"})
        EXPECT_EQ(render_refusal({"--algorithm", "tic", "--cache-records", text})
                      .find("--cache-records: "),
                  0U);
    EXPECT_EQ(render_refusal({"--edits", "edits.json"}),
              "--edits: is for animations, expected it together with --frames or --frame");
}

TEST(AlgorithmOptions, RecordsOfHemispheres) {
    const RenderOptions options =
        render({"--algorithm=irradiance-cache", "--cache-rays", "1024", "--cache-error", "0.25"});
    EXPECT_EQ(options.algorithm, Algorithm::irradiance_cache);
    EXPECT_EQ(options.cache_rays, 1024U);
    EXPECT_EQ(options.cache_error, 0.25);
    EXPECT_TRUE(options.caches_indirect());
    EXPECT_FALSE(options.keeps_records());
    EXPECT_EQ(options_json(options)["algorithm"], "irradiance-cache");
    EXPECT_EQ(options_json(options)["cache_rays"], 1024);
    EXPECT_EQ(options_json(options)["cache_error"], 0.25);
    EXPECT_TRUE(options_json(render({}))["cache_rays"].is_null());
    for (const char* const text : {"15", "16385", "-1", "x", "64.5"})
        EXPECT_EQ(render_refusal({"--algorithm=irradiance-cache", "--cache-rays", text})
                      .find("--cache-rays: "),
                  0U);
    for (const char* const text : {"-0.1", "1.1", "nan", "x"})
        EXPECT_EQ(render_refusal({"--algorithm=irradiance-cache", "--cache-error", text})
                      .find("--cache-error: "),
                  0U);
    EXPECT_EQ(render_refusal({"--algorithm", "ic", "--cache-rays", "64"}),
              "--cache-rays: is for irradiance caching, expected it together with --algorithm "
              "irradiance-cache");
    EXPECT_EQ(render_refusal({"--cache-error", "0.1"}).find("--cache-error: is for irradiance"),
              0U);
    EXPECT_NE(render_refusal({"--algorithm=irradiance-cache", "--vpl-compensation"})
                  .find("no virtual lights"),
              std::string::npos);
    EXPECT_NE(render_refusal({"--algorithm=irradiance-cache", "--indirect", "ic"}), "no failure");
}

TEST(AlgorithmOptions, CompensationIsForVirtualLights) {
    EXPECT_FALSE(render({}).compensation);
    EXPECT_TRUE(render({"--vpl-compensation"}).compensation);
    EXPECT_TRUE(render({"--algorithm", "ir", "--vpl-compensation"}).compensation);
    EXPECT_NE(render_refusal({"--vpl-compensation", "--algorithm", "ic"}).find("records"),
              std::string::npos);
    EXPECT_NE(render_refusal({"--vpl-compensation", "--indirect", "ic"}).find("records"),
              std::string::npos);
    EXPECT_EQ(
        render_refusal({"--vpl-compensation", "--algorithm", "path"}).find("--vpl-compensation: "),
        0u);
    EXPECT_NE(render_refusal({"--vpl-compensation=yes"}), "no failure");
    EXPECT_EQ(options_json(render({}))["vpl_compensation"], false);
    EXPECT_EQ(options_json(render({"--vpl-compensation"}))["vpl_compensation"], true);
}

}  // namespace
}  // namespace weft::algorithm_options_test
