// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/warning.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/shorten.h"
#include "base/warning_collector.h"

namespace weft::warning_test {
namespace {

using Strings = std::vector<std::string>;

constexpr WarningUnit material{"material", "materials"};

/// A warning that counts materials, at `place` and at another one.
Warning warning_at(const std::string& place, const std::string& message = "gloss is left out") {
    Diagnostics diagnostics;
    WarningCollector report(diagnostics);
    report.count(place, material, message);
    report.count("other", material, message);
    return diagnostics.list().at(0);
}

TEST(WarningLine, DropsFoldersBeforeItCutsNames) {
    const std::string tail = "materials: gloss is left out; first: ";
    const auto line = [](const std::string& place, std::size_t longest) {
        return warning_line(warning_at(place), longest);
    };
    const std::string place = "data/my/models/car.gltf#/materials/0";
    EXPECT_EQ(line(place, 2 + tail.size() + place.size()), "2 " + tail + place);
    EXPECT_EQ(line(place, 2 + tail.size() + place.size() - 1),
              "2 " + tail + ".../my/models/car.gltf#/materials/0");
    EXPECT_EQ(line(place, 70), "2 " + tail + ".../car.gltf#/materials/0");
    EXPECT_EQ(line("a/b/a-very-long-name-indeed.gltf#/materials/10", 72),
              "2 " + tail + "a-very-l...eed.gltf#/materials/10");
    EXPECT_EQ(line("a/b/a-very-long-name-indeed.obj:17 'wood'", 62),
              "2 " + tail + "a-ver...d.obj:17 'wood'");
}

TEST(WarningLine, NeverCutsItsSense) {
    const std::string name(80, 'n');
    const std::string message = "type '" + name + "' is not supported, grey is rendered instead";
    const std::string place = "scenes/a-rather-long-name-of-a-scene.xml:1234";
    for (std::size_t longest = 100; longest <= 200; ++longest) {
        const std::string line = warning_line(warning_at(place, message), longest);
        EXPECT_LE(line.size(), longest);
        EXPECT_TRUE(line.starts_with("2 materials: type 'nn")) << line;
        EXPECT_NE(line.find("' is not supported, grey is rendered instead"), std::string::npos);
        EXPECT_TRUE(line.ends_with(":1234")) << line;
    }
    // Where there is room for nothing else, the message remains.
    const std::string plain = "gloss is left out since nothing is known of it";
    EXPECT_EQ(warning_line(warning_at(place, plain), 60), "2 materials: " + plain);
    EXPECT_EQ(warning_line(warning_at(place, plain), 10), "2 materials: " + plain);
}

TEST(WarningLine, CountsAndKeepsCharacters) {
    std::string name;
    for (int i = 0; i < 60; ++i) name += "\u00e9";
    EXPECT_EQ(count_characters(name), 60U);
    const Warning warning = warning_at(name + ".gltf#/materials/0");
    EXPECT_EQ(warning_line(warning, 117), warning_line(warning))
        << "117 characters, but more bytes";
    for (std::size_t longest = 70; longest < 117; ++longest) {
        const std::string line = warning_line(warning, longest);
        EXPECT_EQ(count_characters(line), longest);
        // Both bytes of each letter are there.
        std::string rest = line;
        for (std::size_t at = rest.find("\u00e9"); at != std::string::npos;
             at = rest.find("\u00e9"))
            rest.erase(at, 2);
        for (const char c : rest) EXPECT_LT(static_cast<unsigned char>(c), 0x80);
    }
}

TEST(WarningDetails, NameEveryPlace) {
    Diagnostics diagnostics;
    WarningCollector report(diagnostics);
    report.count("a.ply", {"face", "faces"}, "fewer than three corners, left out", 12);
    EXPECT_EQ(warning_details(diagnostics.list()[0]),
              Strings{"12 faces: fewer than three corners, left out; at a.ply"});
    report.count("b.ply", {"face", "faces"}, "fewer than three corners, left out");
    EXPECT_EQ(warning_details(diagnostics.list()[0]),
              (Strings{"13 faces: fewer than three corners, left out", "  a.ply (12)", "  b.ply"}));
}

TEST(WarningTitle, EndsAtTheFirstComma) {
    EXPECT_EQ(warning_title(warning_at("a", "type 'a, b' is not known, left out")),
              "type 'a, b' is not known");
    EXPECT_EQ(warning_title(warning_at("a", "texts are ignored")), "texts are ignored");
}

}  // namespace
}  // namespace weft::warning_test
