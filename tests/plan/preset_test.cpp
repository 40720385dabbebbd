// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/preset.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "image/exr.h"
#include "plan/algorithm.h"
#include "plan/quality.h"
#include "tests/testing/parse_options.h"
#include "tests/testing/run_program.h"
#include "tests/testing/temporary_folder.h"

namespace weft::preset_test {
namespace {

using nlohmann::json;

class PresetFile : public testing::Test {
  protected:
    [[nodiscard]] Preset read(const std::string& text) const {
        return read_preset(folder_.write("preset.json", text));
    }

    /// The message of a file that must be refused, from its name on.
    [[nodiscard]] std::string refusal(const std::string& text) const {
        try {
            (void)read(text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            const std::string message = error.what();
            EXPECT_EQ(message.find('\n'), std::string::npos);
            const std::size_t name = message.find("preset.json");
            return name == std::string::npos ? message : message.substr(name);
        }
        return "no failure";
    }

    TemporaryFolder folder_;
};

/// A file with one more key.
std::string with(const std::string& key, const std::string& value) {
    return R"({"weft_preset": 1, ")" + key + R"(": )" + value + "}";
}

TEST_F(PresetFile, HoldsEverySetting) {
    SamplingSettings sampling;
    sampling.interleave = 5;
    sampling.vpls_per_set = 17;
    sampling.candidates = 3;
    sampling.bounces = 2;
    sampling.samples_per_light = 3;
    sampling.max_samples_per_set = 99;
    sampling.bound_spacing = 1.5;
    sampling.filter_radius = 2;
    sampling.filter_cosine = 0.25;
    sampling.filter_planes = 3.5;
    sampling.threshold = 0.1;
    sampling.luminance_scale = 80.0;
    sampling.enough_support = 0.9;
    sampling.roulette = 0.0;
    sampling.cached = sampling.temporal = true;
    sampling.cache_masks = false;
    sampling.cache_records = 1000;
    sampling.cache_error = 0.3;
    sampling.cache_rays = 64;
    sampling.edge_samples = 8;
    sampling.local_bounds = sampling.vpl_tail = false;
    sampling.near_residual = sampling.threshold_falls = true;
    const Preset read_back = read(preset_json({Algorithm::amax, sampling, 12}).dump());
    EXPECT_EQ(read_back.algorithm, Algorithm::amax);
    EXPECT_EQ(read_back.samples, 12U);
    const SamplingSettings& found = read_back.sampling;
    EXPECT_EQ(found.interleave, 5U);
    EXPECT_EQ(found.vpls_per_set, 17U);
    EXPECT_EQ(found.candidates, 3U);
    EXPECT_EQ(found.bounces, 2U);
    EXPECT_EQ(found.samples_per_light, 3U);
    EXPECT_EQ(found.max_samples_per_set, 99U);
    EXPECT_EQ(found.bound_spacing, 1.5);
    EXPECT_EQ(found.filter_radius, 2U);
    EXPECT_EQ(found.filter_cosine, 0.25);
    EXPECT_EQ(found.filter_planes, 3.5);
    EXPECT_EQ(found.threshold, 0.1);
    EXPECT_EQ(found.luminance_scale, 80.0);
    EXPECT_EQ(found.enough_support, 0.9);
    EXPECT_EQ(found.roulette, 0.0);
    EXPECT_TRUE(found.cached && found.temporal);
    EXPECT_FALSE(found.cache_masks);
    EXPECT_EQ(found.cache_records, 1000U);
    EXPECT_EQ(found.cache_error, 0.3);
    EXPECT_EQ(found.cache_rays, 64U);
    EXPECT_EQ(found.edge_samples, 8U);
    EXPECT_FALSE(found.local_bounds);
    EXPECT_FALSE(found.vpl_tail);
    EXPECT_TRUE(found.near_residual);
    EXPECT_TRUE(found.threshold_falls);
    EXPECT_EQ(read_back.refined_after, 0U);
    EXPECT_EQ(read(with("refined_after", "6")).refined_after, 6U);
    EXPECT_FALSE(found.compensation);
    EXPECT_TRUE(read(with("compensation", "true")).sampling.compensation);
}

TEST_F(PresetFile, WhatIsMissingHasItsDefault) {
    const Preset preset = read(R"({"weft_preset": 1})");
    EXPECT_EQ(preset_json(preset), preset_json(Preset{}));
    EXPECT_EQ(preset.algorithm, default_algorithm);
    EXPECT_EQ(preset.samples, 1U);
}

TEST_F(PresetFile, NamesThePlaceOfWhatIsWrong) {
    EXPECT_EQ(refusal(with("vpl", "64")).find("preset.json#: has the unknown key 'vpl'"), 0U);
    EXPECT_EQ(refusal(with("spp", "0")),
              "preset.json#/spp: is 0, expected a whole number from 1 to 16777216");
    EXPECT_EQ(refusal(with("algorithm", R"("igl")")).find("preset.json#/algorithm: is 'igl'"), 0U);
    EXPECT_EQ(refusal(with("threshold", "true")).find("preset.json#/threshold: is of type"), 0U);
    EXPECT_EQ(refusal("{\n\n oops}").find("preset.json:3: JSON syntax error"), 0U);
}

TEST_F(PresetFile, RefusesWhatIsOutOfRange) {
    const std::vector<std::pair<std::string, std::vector<std::string>>> cases{
        {"weft_preset", {"2", "0", "null", "\"1\""}},
        {"algorithm", {"1", "\"\"", "null"}},
        {"indirect", {"\"path\"", "0"}},
        {"spp", {"-1", "1.5", "16777217", "1e300", "[]"}},
        {"interleave", {"0", "2", "4", "17", "4294967299"}},
        {"vpls", {"0", "65537", "-64"}},
        {"bounces", {"0", std::to_string(MAX_BOUNCES + 1)}},
        {"light_samples", {"0", "16385"}},
        {"max_light_samples", {"0", "16385"}},
        {"filter_radius", {"17", "0.5"}},
        {"edge_samples", {std::to_string(MAX_EDGE_SAMPLES + 1), "-2"}},
        {"cache_records", {"0", std::to_string(limits::max_cache_records + 1)}},
        {"cache_rays", {"15", std::to_string(limits::max_cache_rays + 1)}},
        {"bound_spacing", {"-0.1", "1001"}},
        {"filter_cosine", {"-0.1", "1.1"}},
        {"filter_planes", {"-1"}},
        {"threshold", {"-1", "1e7"}},
        {"luminance_scale", {"0", "-1"}},
        {"support", {"-0.1", "1.1"}},
        {"roulette", {"-0.1", "1001"}},
        {"cache_error", {"-0.1", "1.1"}},
        {"cache_masks", {"1", "\"on\""}},
        {"local_bounds", {"1"}},
        {"vpl_tail", {"\"on\""}},
        {"threshold_falls", {"0"}},
        {"near_residual", {"1", "\"near\""}},
        {"candidates", {"0", "65", "1.5"}},
        {"refined_after", {"-1", "true", "16777217"}},
        {"compensation", {"0"}}};
    for (const auto& [key, values] : cases)
        for (const std::string& value : values) {
            const std::string text =
                key == "weft_preset" ? "{\"weft_preset\": " + value + "}" : with(key, value);
            EXPECT_EQ(refusal(text).find("preset.json#/" + key + ": "), 0U)
                << key << " " << value << " " << refusal(text);
        }
}

TEST_F(PresetFile, RefusesWhatDoesNotFitTogether) {
    EXPECT_NE(refusal(R"({"weft_preset": 1, "interleave": 15, "vpls": 65536})")
                  .find("in all 225 sample sets"),
              std::string::npos);
    EXPECT_EQ(
        refusal(R"({"weft_preset": 1, "denoise": "statistical"})").find("preset.json#/denoise: "),
        0U);
    EXPECT_EQ(refusal(R"({"weft_preset": 1, "denoise": "much"})").find("preset.json#/denoise: "),
              0U);
    EXPECT_EQ(refusal(R"({"weft_preset": 1, "algorithm": "igi", "indirect": "ic"})")
                  .find("preset.json#/indirect: "),
              0U);
    for (const char* const more :
         {R"("algorithm": "path")", R"("algorithm": "ic")", R"("indirect": "ic")"})
        EXPECT_EQ(refusal(std::string(R"({"weft_preset": 1, "compensation": true, )") + more + "}")
                      .find("preset.json#/compensation: "),
                  0U)
            << more;
}

TEST_F(PresetFile, RefusesOtherFiles) {
    for (const char* const text : {"", "[]", "null", "1", "{}", "\"weft_preset\"", "{\"a\":1}"})
        EXPECT_NE(refusal(text), "no failure") << text;
    EXPECT_NE(refusal(std::string(1000, '[')).find("nested deeper"), std::string::npos);
    EXPECT_NE(refusal("{\"weft_preset\": 1, \"a\": \"" + std::string(2 << 20, 'a') + "\"}"),
              "no failure");
    EXPECT_THROW((void)read_preset(folder_.path()), Error);
    EXPECT_THROW((void)read_preset(folder_.path() / "missing.json"), Error);
}

TEST_F(PresetFile, AlgorithmsMayHaveTheirLongNames) {
    const Preset preset = read(
        R"({"weft_preset": 1, "algorithm": "adaptive-maximum", "indirect": "instant-caching"})");
    EXPECT_EQ(preset.algorithm, Algorithm::amax);
    EXPECT_EQ(source_of(preset.sampling), IndirectSource::ic);
}

TEST_F(PresetFile, TheCommandLineWins) {
    SamplingSettings sampling;
    sampling.compensation = true;
    sampling.vpls_per_set = 32;
    const std::string file =
        folder_.write("p.json", preset_json({Algorithm::igi, sampling, 4}).dump());
    const RenderOptions plain = test::render({"--preset", file.c_str()});
    EXPECT_EQ(plain.algorithm, Algorithm::igi);
    EXPECT_EQ(plain.spp, 4U);
    EXPECT_FALSE(plain.compensation) << "what the command line says itself";
    ASSERT_TRUE(plain.preset);
    EXPECT_TRUE(plain.preset->sampling.compensation);
    EXPECT_EQ(plain.preset->sampling.vpls_per_set, 32U);
    const RenderOptions given =
        test::render({"--spp", "2", "--preset", file.c_str(), "--algorithm", "ic"});
    EXPECT_EQ(given.algorithm, Algorithm::ic);
    EXPECT_EQ(given.spp, 2U);
    EXPECT_FALSE(test::render({"--preset", file.c_str(), "--time", "1s"}).spp);
    EXPECT_EQ(test::render_refusal({"--preset", file.c_str(), "--quality", "high"}),
              "--quality: says what --preset says, expected one of them");
    const std::string cached =
        folder_.write("c.json", R"({"weft_preset": 1, "indirect": "tic", "cache_masks": false})");
    EXPECT_EQ(test::render({"--preset", cached.c_str()}).indirect, IndirectSource::tic);
    EXPECT_FALSE(test::render({"--preset", cached.c_str()}).cache_masks);
    EXPECT_TRUE(test::render({"--preset", cached.c_str(), "--cache-masks", "on"}).cache_masks);
    EXPECT_EQ(test::render({"--preset", cached.c_str(), "--indirect", "vpl"}).indirect,
              IndirectSource::vpl);
    EXPECT_FALSE(test::render({"--preset", cached.c_str(), "--algorithm", "path"}).indirect);
}

TEST_F(PresetFile, MayDenoise) {
    const Preset preset{Algorithm::path, {}, 4, Denoiser::statistical};
    const std::string text = preset_json(preset).dump();
    EXPECT_EQ(read(text).denoiser, Denoiser::statistical);
    EXPECT_EQ(read(R"({"weft_preset": 1})").denoiser, Denoiser::none);
    const std::string file = folder_.write("d.json", text);
    EXPECT_EQ(test::render({"--preset", file.c_str()}).denoiser, Denoiser::statistical);
    EXPECT_EQ(test::render({"--preset", file.c_str(), "--denoise", "none"}).denoiser,
              Denoiser::none);
    // Which previews cannot be.
    EXPECT_EQ(test::render({"--preset", file.c_str(), "--algorithm", "ais"}).denoiser,
              Denoiser::none);
}

class PresetImage : public PresetFile {
  protected:
    /// Renders a small image with these options.
    [[nodiscard]] Image make_image(const std::string& name, std::vector<std::string> more) const {
        const std::string output = folder_.path() / name;
        std::vector<std::string> arguments{"render",     test::shipped_scene("cornell-box.gltf"),
                                           "-o",         output,
                                           "--size",     "40x32",
                                           "--backend",  "native",
                                           "--progress", "none"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const test::ProgramResult result = test::run_program(arguments);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_exr(output);
    }

    static void expect_same(const Image& a, const Image& b) {
        ASSERT_EQ(a.layers.size(), b.layers.size());
        for (std::size_t i = 0; i < a.layers.size(); ++i)
            EXPECT_EQ(a.layers[i].values, b.layers[i].values) << a.layers[i].name;
    }
};

TEST_F(PresetImage, DefaultsMakeTheDefaultImage) {
    const Preset preset{Algorithm::ais, sampling_of_image(Quality::preview, false), 1};
    const std::string file = folder_.write("p.json", preset_json(preset).dump());
    expect_same(make_image("a.exr", {"--spp", "1"}), make_image("b.exr", {"--preset", file}));
}

TEST_F(PresetImage, AQualityCanBeWrittenDown) {
    const std::string file = folder_.write(
        "p.json", preset_json({Algorithm::ais, sampling_of_image(Quality::high, false), 2}).dump());
    expect_same(make_image("a.exr", {"--quality", "high", "--spp", "2"}),
                make_image("b.exr", {"--preset", file}));
}

TEST_F(PresetImage, StatisticsSayWhatTookEffect) {
    SamplingSettings sampling;
    sampling.threshold = 21.0;
    sampling.cache_error = 0.25;
    const std::string file =
        folder_.write("p.json", preset_json({Algorithm::ic, sampling, 2}).dump());
    const std::string stats = folder_.path() / "stats.json";
    (void)make_image("a.exr", {"--preset", file, "--cache-error", "0.5", "--stats", stats});
    const json found = json::parse(test::text_of_file(stats));
    EXPECT_EQ(found["options"]["preset"], file);
    EXPECT_TRUE(found["options"]["quality"].is_null());
    EXPECT_EQ(found["settings"]["algorithm"], "ic");
    EXPECT_EQ(found["settings"]["threshold"], 21.0);
    EXPECT_EQ(found["settings"]["cache_error"], 0.5);
    EXPECT_EQ(found["settings"]["spp"], 2);
}

}  // namespace
}  // namespace weft::preset_test
