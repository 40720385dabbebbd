// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/file_output.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "image/exr.h"
#include "tests/testing/temporary_folder.h"

namespace weft::file_output_test {
namespace {

namespace fs = std::filesystem;

SessionImage grey_image(std::uint32_t width, std::uint32_t height) {
    SessionImage image;
    image.image.width = width;
    image.image.height = height;
    const std::size_t pixels = std::size_t{width} * height;
    image.image.layers = {{"", "RGB", std::vector<float>(3 * pixels, 0.5F)},
                          {"depth", "Z", std::vector<float>(pixels, 2.0F)}};
    image.samples = 1;
    return image;
}

FileOutputSettings settings_for(const fs::path& file) {
    FileOutputSettings settings;
    settings.file = file;
    settings.scene = "scene";
    return settings;
}

TEST(FileOutput, ARehearsalTakesTimeAndLeavesNoTrace) {
    for (const char* const name : {"x.exr", "x.png"})
        for (const std::uint32_t height : {1U, 39U, 40U, 41U, 333U}) {
            const TemporaryFolder folder;
            const fs::path old = folder.write(name, "old");
            Diagnostics diagnostics;
            FileOutput output(settings_for(old), diagnostics);
            EXPECT_GT(output.write_ms(grey_image(17, height)), 0.0) << name << " " << height;
            EXPECT_EQ(folder.entry_count(), 1U);
            std::ifstream file(old);
            EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "old");
            EXPECT_TRUE(diagnostics.warnings().empty());
        }
}

TEST(FileOutput, WhatCannotBeWrittenIsToldByTheWriteAlone) {
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    FileOutput output(settings_for(folder.path() / "missing" / "x.exr"), diagnostics);
    EXPECT_EQ(output.write_ms(grey_image(8, 8)), 0.0);
    EXPECT_ANY_THROW(output.write(grey_image(8, 8)));
}

/// An image by adaptive sampling.
SessionImage rendered_image() {
    SessionImage rendered;
    rendered.image.width = 3;
    rendered.image.height = 2;
    rendered.image.layers = {{"", "RGB", std::vector<float>(18, 0.5F)}};
    rendered.algorithm = Algorithm::ais;
    rendered.samples = 1;
    return rendered;
}

TEST(FileOutput, StatesTheLightOfImagesThatHoldAPartOfIt) {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / "x.exr";
    Diagnostics diagnostics;
    FileOutput output(settings_for(file), diagnostics);
    output.write(rendered_image());
    EXPECT_FALSE(read_exr(file).metadata.contains("light"));
    SessionImage part = rendered_image();
    part.complete = false;
    part.light = {{"direct", 1.0}, {"indirect", 0.389}};
    output.write(part);
    EXPECT_EQ(read_exr(file).metadata.at("light"), "direct 100 %, indirect 38 %");
    EXPECT_EQ(read_exr(file).metadata.at("samples"), "1");
}

}  // namespace
}  // namespace weft::file_output_test
