// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "film/film_sums_file.h"
#include "image/exr.h"
#include "tests/testing/run_program.h"

// What `weft render --denoise` makes of images, sums and statistics.
namespace weft::program_denoise_test {
namespace {

using test::ProgramResult;
using test::run_program;
using test::text_of_file;

class ProgramDenoise : public testing::Test {
  protected:
    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }

    /// Runs the program on the Cornell box in a small size.
    [[nodiscard]] ProgramResult run(const std::string& output, std::vector<std::string> more,
                                    const std::string& library = "") const {
        std::vector<std::string> arguments{"render",     test::shipped_scene("cornell-box.gltf"),
                                           "-o",         at(output),
                                           "--size",     "40x32",
                                           "--backend",  "native",
                                           "--progress", "none",
                                           "--stats",    at("stats.json")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run_program(arguments, {.environment = {{"WEFT_OIDN_LIBRARY", library}}});
    }

    [[nodiscard]] Image render(const std::string& output, const std::vector<std::string>& more,
                               const std::string& library = "") const {
        const ProgramResult result = run(output, more, library);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_exr(at(output));
    }

    [[nodiscard]] nlohmann::json stats() const {
        return nlohmann::json::parse(text_of_file(at("stats.json")));
    }

    TemporaryFolder folder_;
};

/// Red, green and blue of a layer, without alpha.
std::vector<float> colours(const Image& image, const std::string& layer) {
    const Layer* const found = image.find(layer);
    if (found == nullptr) return {};
    std::vector<float> values = found->values;
    values.resize(std::size_t{3} * image.width * image.height);
    return values;
}

TEST_F(ProgramDenoise, BeautyIsDenoisedAndAllElseIsAsRendered) {
    const Image plain = render("plain.exr", {"--algorithm", "path", "--spp", "8"});
    EXPECT_EQ(plain.find("noisy"), nullptr);
    EXPECT_FALSE(plain.metadata.contains("denoiser"));
    EXPECT_EQ(stats()["options"]["denoise"], "none");
    const Image clean =
        render("clean.exr", {"--algorithm", "path", "--spp", "8", "--denoise", "statistical"});
    EXPECT_EQ(clean.metadata.at("denoiser"), "statistical");
    EXPECT_EQ(stats()["options"]["denoise"], "statistical");
    EXPECT_EQ(stats()["settings"]["denoise"], "statistical");
    EXPECT_GT(stats()["times"]["denoise_ms"], 0.0);
    EXPECT_EQ(colours(clean, "noisy"), colours(plain, ""));
    EXPECT_NE(colours(clean, ""), colours(plain, ""));
    for (const char* const layer : {"direct", "indirect", "emission", "albedo", "variance"})
        EXPECT_EQ(colours(clean, layer), colours(plain, layer)) << layer;
    EXPECT_EQ(clean.layers.size(), plain.layers.size() + 1);
}

TEST_F(ProgramDenoise, PngFilesSayIt) {
    EXPECT_EQ(run("a.png", {"--algorithm=path", "--spp=4", "--denoise=statistical"}).exit_code, 0);
    const std::string text = text_of_file(at("a.png"));
    EXPECT_NE(text.find(std::string("denoiser\0statistical", 20)), std::string::npos);
}

TEST_F(ProgramDenoise, TheReferenceIsDenoisedAsWell) {
    const Image clean =
        render("a.exr", {"--algorithm", "reference", "--spp", "4", "--denoise", "statistical"});
    EXPECT_EQ(clean.metadata.at("denoiser"), "statistical");
    EXPECT_NE(colours(clean, ""), colours(clean, "noisy"));
}

TEST_F(ProgramDenoise, SumsStayRawAndGoOn) {
    const std::vector<std::string> path{"--algorithm", "path"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), path.begin(), path.end());
        return more;
    };
    const Image whole = render("whole.exr", with({"--spp", "8"}));
    (void)render("first.exr",
                 with({"--spp", "4", "--denoise", "statistical", "--resume", at("sums.exr")}));
    // The file of sums has their image as it was rendered.
    const Image sums = read_exr(at("sums.exr"));
    EXPECT_EQ(sums.find("noisy"), nullptr);
    EXPECT_FALSE(sums.metadata.contains("denoiser"));
    const Image resumed = render(
        "second.exr", with({"--spp", "8", "--denoise", "statistical", "--resume", at("sums.exr")}));
    EXPECT_EQ(colours(resumed, "noisy"), colours(whole, ""));
    const Image again = render("third.exr", with({"--spp", "8", "--resume", at("sums.exr")}));
    EXPECT_EQ(colours(again, ""), colours(whole, ""));
    // And so are those in an image of a part.
    (void)render("a.exr", with({"--samples", "0:4", "--denoise", "statistical"}));
    (void)render("b.exr", with({"--samples", "4:8", "--denoise", "statistical"}));
    EXPECT_EQ(run_program({"merge", at("a.exr"), at("b.exr"), "-o", at("ab.exr")}).exit_code, 0);
    const Image merged = read_exr(at("ab.exr"));
    EXPECT_EQ(colours(merged, ""), colours(whole, ""));
    EXPECT_FALSE(merged.metadata.contains("denoiser"));
    EXPECT_EQ(merged.find("noisy"), nullptr);
}

TEST_F(ProgramDenoise, ASingleSampleKeepsItsNoiseAndIsSaidTo) {
    const ProgramResult result =
        run("one.exr", {"--algorithm=path", "--spp=1", "--denoise=statistical"});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_NE(result.err.find("a single sample has no variance"), std::string::npos) << result.err;
    const Image image = read_exr(at("one.exr"));
    EXPECT_FALSE(image.metadata.contains("denoiser"));
    EXPECT_EQ(image.find("noisy"), nullptr);
    EXPECT_EQ(stats()["options"]["denoise"], "none");
}

TEST_F(ProgramDenoise, EveryFrameOfAnAnimationIsDenoised) {
    const ProgramResult result =
        run("f.exr", {"--frames=0:2", "--algorithm=path", "--spp=2", "--denoise=statistical"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    for (const char* const file : {"f.0000.exr", "f.0001.exr"})
        EXPECT_EQ(read_exr(at(file)).metadata.at("denoiser"), "statistical");
}

TEST_F(ProgramDenoise, OpenImageDenoiseIsForAllAlgorithms) {
    for (const char* const algorithm : {"ais", "path"}) {
        const Image image =
            render("a.exr", {"--algorithm", algorithm, "--spp", "1", "--denoise", "oidn"},
                   WEFT_OIDN_STUB_2);
        EXPECT_EQ(image.metadata.at("denoiser"), "oidn 2.9.7");
        std::vector<float> halved = colours(image, "noisy");
        for (float& value : halved) value *= 0.5F;  // what the library that stands in does
        EXPECT_EQ(colours(image, ""), halved);
    }
    // A background goes behind both.
    const Image white =
        render("w.exr", {"--denoise=oidn", "--background=white", "--spp=1"}, WEFT_OIDN_STUB_2);
    EXPECT_EQ(colours(white, "noisy").front(), 1.0F);
    EXPECT_EQ(colours(white, "").front(), 1.0F);
}

TEST_F(ProgramDenoise, SaysWhatIsWrongBeforeItRenders) {
    const ProgramResult preview = run("a.exr", {"--denoise", "statistical"});
    EXPECT_EQ(preview.exit_code, 1);
    EXPECT_EQ(preview.err.find("weft: --denoise: statistical needs the variance"), 0U);
    const ProgramResult missing = run("a.exr", {"--denoise", "oidn"}, at("none.so"));
    EXPECT_EQ(missing.exit_code, 3);
    EXPECT_EQ(std::count(missing.err.begin(), missing.err.end(), '\n'), 1) << missing.err;
    EXPECT_NE(missing.err.find("none.so"), std::string::npos) << missing.err;
    EXPECT_FALSE(std::filesystem::exists(at("a.exr")));
}

}  // namespace
}  // namespace weft::program_denoise_test
