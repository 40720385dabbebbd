// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/background.h"
#include "image/exr.h"
#include "tests/testing/program_backends.h"
#include "tests/testing/run_program.h"

// What `weft render` and `weft merge` write for --background, --tone and --cryptomatte.
namespace weft::program_images_test {
namespace {

using test::program_backends;
using test::run_program;

class ProgramImages : public testing::Test {
  protected:
    [[nodiscard]] std::string at(const std::string& name) const { return folder_.path() / name; }

    /// A white square of 2 x 2 before an environment of radiance 0.5, seen from the front by an
    /// orthographic camera that shows 4 x 4, in 32 x 32 pixels.
    void SetUp() override {
        const nlohmann::json scene = {
            {"asset", {{"version", "2.0"}}},
            {"scene", 0},
            {"scenes", {{{"nodes", {0, 1}}}}},
            {"nodes",
             {{{"mesh", 0}, {"name", "square"}}, {{"camera", 0}, {"translation", {0, 0, 3}}}}},
            {"cameras",
             {{{"type", "orthographic"},
               {"orthographic", {{"xmag", 2}, {"ymag", 2}, {"znear", 0.1}, {"zfar", 9}}}}}},
            {"materials", {{{"name", "paper"}, {"emissiveFactor", {0.5, 0.25, 0.0}}}}},
            {"meshes",
             {{{"primitives",
                {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}}},
            {"accessors",
             {{{"bufferView", 0}, {"componentType", 5126}, {"type", "VEC3"}, {"count", 4}},
              {{"bufferView", 1}, {"componentType", 5123}, {"type", "SCALAR"}, {"count", 6}}}},
            {"bufferViews",
             {{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", 48}},
              {{"buffer", 0}, {"byteOffset", 48}, {"byteLength", 12}}}},
            {"buffers", {{{"byteLength", 60}, {"uri", "square.bin"}}}}};
        std::string bytes;
        for (const float value :
             {-1.0F, -1.0F, 0.0F, 1.0F, -1.0F, 0.0F, 1.0F, 1.0F, 0.0F, -1.0F, 1.0F, 0.0F})
            bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
        constexpr std::uint16_t indices[] = {0, 1, 2, 0, 2, 3};
        for (const std::uint16_t index : indices)
            bytes.append(reinterpret_cast<const char*>(&index), sizeof(index));
        folder_.write("square.bin", bytes);
        folder_.write("square.gltf", scene.dump());
    }

    /// Renders the square to a file, which has to succeed.
    void render(const std::string& output, const std::vector<std::string>& more) const {
        std::vector<std::string> arguments{"render", at("square.gltf"), "-o",         at(output),
                                           "--size", "32x32",           "--progress", "none"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto result = run_program(arguments);
        ASSERT_EQ(result.exit_code, 0) << result.err;
    }

    /// Values of an 8-bit file, 3 or 4 a pixel.
    [[nodiscard]] std::vector<png_byte> png_values(const std::string& name) const {
        png_image png{};
        png.version = PNG_IMAGE_VERSION;
        if (png_image_begin_read_from_file(&png, at(name).c_str()) == 0) return {};
        std::vector<png_byte> values(PNG_IMAGE_SIZE(png));
        if (png_image_finish_read(&png, nullptr, values.data(), 0, nullptr) == 0) return {};
        return values;
    }

    TemporaryFolder folder_;
};

constexpr std::size_t pixels = 32 * 32;
constexpr std::size_t corner = 0;
constexpr std::size_t middle = 16 * 32 + 16;

TEST_F(ProgramImages, PngFilesHaveAlphaWhereTheyAreToBeTransparent) {
    for (const std::string& backend : program_backends()) {
        render("a.png", {"--backend", backend, "--background", "transparent"});
        const std::vector<png_byte> values = png_values("a.png");
        ASSERT_EQ(values.size(), 4 * pixels);
        EXPECT_EQ(values[4 * corner + 3], 0);
        EXPECT_EQ(values[4 * middle + 3], 255);
        EXPECT_NEAR(values[4 * middle], 188, 8) << "0.5 and a little light that is reflected";
        std::size_t covered = 0;
        for (std::size_t i = 0; i < pixels; ++i) covered += values[4 * i + 3] == 255 ? 1 : 0;
        EXPECT_EQ(covered, pixels / 4);
        render("b.png", {"--backend", backend, "--background=#ff8000", "--exposure", "-2"});
        const std::vector<png_byte> opaque = png_values("b.png");
        ASSERT_EQ(opaque.size(), 3 * pixels);
        EXPECT_EQ(opaque[0], 255);
        EXPECT_NEAR(opaque[1], 128, 1);
        EXPECT_EQ(opaque[2], 0);
        render("c.png", {"--backend", backend});
        EXPECT_EQ(png_values("c.png").size(), 3 * pixels);
    }
}

TEST_F(ProgramImages, ExrFilesAlwaysHaveAlpha) {
    for (const std::string algorithm : {"ais", "path"}) {
        render("a.exr", {"--algorithm", algorithm, "--background", "transparent"});
        const Image hidden = read_exr(at("a.exr"));
        EXPECT_EQ(hidden.find("")->channels, "RGBA");
        EXPECT_EQ(hidden.metadata.at("background"), "transparent");
        EXPECT_EQ(alpha_of(hidden)[corner], 0.0F);
        EXPECT_EQ(hidden.find("")->values[corner], 0.0F);
        EXPECT_EQ(alpha_of(hidden)[middle], 1.0F);
        render("b.exr", {"--algorithm", algorithm, "--background", "0,2,0.5"});
        const Image coloured = read_exr(at("b.exr"));
        EXPECT_EQ(alpha_of(coloured)[corner], 1.0F);
        EXPECT_EQ(coloured.find("")->values[pixels + corner], 2.0F);
        EXPECT_EQ(coloured.find("emission")->values[pixels + corner], 2.0F);
        EXPECT_EQ(coloured.find("")->values[middle], hidden.find("")->values[middle]);
        render("c.exr", {"--algorithm", algorithm});
        EXPECT_EQ(read_exr(at("c.exr")).find("")->channels, "RGBA");
    }
}

TEST_F(ProgramImages, PartsKeepBackgroundAndIdentifiersWhenMerged) {
    const std::vector<std::string> common{"--algorithm", "path",   "--background",  "0,2,0.5",
                                          "--backend",   "native", "--cryptomatte", "object"};
    const auto with = [&](const std::string& samples) {
        std::vector<std::string> all = common;
        all.insert(all.end(), {"--samples", samples});
        return all;
    };
    render("whole.exr", with("0:4"));
    render("a.exr", with("0:1"));
    render("b.exr", with("1:4"));
    ASSERT_EQ(run_program({"merge", at("a.exr"), at("b.exr"), "-o", at("merged.exr")}).exit_code,
              0);
    const Image whole = read_exr(at("whole.exr"));
    const Image merged = read_exr(at("merged.exr"));
    EXPECT_EQ(merged.find("")->values, whole.find("")->values);
    EXPECT_EQ(merged.find("emission")->values, whole.find("emission")->values);
    ASSERT_NE(merged.find("CryptoObject00"), nullptr);
    EXPECT_EQ(merged.metadata.at("cryptomatte/3ae39a5/manifest"),
              whole.metadata.at("cryptomatte/3ae39a5/manifest"));
    std::vector<std::string> other = with("4:5");
    other[3] = "1,1,1";
    render("c.exr", other);
    const auto result = run_program({"merge", at("a.exr"), at("c.exr"), "-o", at("no.exr")});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("another --background"), std::string::npos) << result.err;
}

TEST_F(ProgramImages, IdentifiersNameWhatTheFileNames) {
    for (const std::string& backend : program_backends()) {
        render("a.exr", {"--backend", backend, "--cryptomatte", "material,object"});
        const Image image = read_exr(at("a.exr"));
        const auto objects =
            nlohmann::json::parse(image.metadata.at("cryptomatte/3ae39a5/manifest"));
        EXPECT_TRUE(objects.contains("square"));
        const auto materials =
            nlohmann::json::parse(image.metadata.at("cryptomatte/be359d6/manifest"));
        EXPECT_TRUE(materials.contains("paper"));
        EXPECT_EQ(image.find("CryptoObject00")->values[pixels + middle], 1.0F);
        EXPECT_EQ(image.find("CryptoObject00")->values[pixels + corner], 0.0F);
    }
}

TEST_F(ProgramImages, IdentifiersNeedAFileWithLayers) {
    const auto result =
        run_program({"render", at("square.gltf"), "-o", at("a.png"), "--cryptomatte", "object"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_NE(result.err.find("--cryptomatte: "), std::string::npos) << result.err;
}

}  // namespace
}  // namespace weft::program_images_test
