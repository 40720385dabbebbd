// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "base/limits.h"
#include "base/warning_collector.h"

namespace weft::diagnostics_test {
namespace {

using Strings = std::vector<std::string>;

constexpr WarningUnit material{"material", "materials"};

TEST(Diagnostics, CountAKindAndNameItsFirstPlace) {
    Diagnostics diagnostics;
    WarningCollector report(diagnostics);
    report.count("a.gltf#/materials/2", material, "gloss is left out");
    EXPECT_EQ(diagnostics.warnings(),
              Strings{"1 material: gloss is left out; at a.gltf#/materials/2"});
    report.count("a.gltf#/materials/5", material, "gloss is left out", 3);
    report.count("a.gltf#/materials/6", material, "gloss is left out", 0);
    report.once("b.mtl:7", "texts are ignored");
    report.once("b.mtl:7", "texts are ignored");
    diagnostics.warn("a.gltf", "no camera");
    diagnostics.warn("a.gltf", "no camera");
    diagnostics.warn("b.gltf", "no camera");
    diagnostics.warn("", "interrupted");
    EXPECT_EQ(diagnostics.warnings(),
              (Strings{"4 materials: gloss is left out; first: a.gltf#/materials/2",
                       "b.mtl:7: texts are ignored", "a.gltf: no camera", "b.gltf: no camera",
                       "interrupted"}));
    report.once("b.mtl:8", "texts are ignored");
    EXPECT_EQ(diagnostics.warnings()[1], "b.mtl:7: texts are ignored (and at 1 more place)");
    report.once("b.mtl:9", "texts are ignored");
    EXPECT_EQ(diagnostics.warnings()[1], "b.mtl:7: texts are ignored (and at 2 more places)");
}

TEST(Diagnostics, HandOutEachKindOnce) {
    Diagnostics diagnostics;
    diagnostics.warn("", "one");
    diagnostics.warn("", "two");
    EXPECT_EQ(diagnostics.take_new().size(), 2U);
    EXPECT_TRUE(diagnostics.take_new().empty());
    diagnostics.warn("", "two");
    diagnostics.warn("", "three");
    ASSERT_EQ(diagnostics.take_new().size(), 1U);
    EXPECT_EQ(diagnostics.list().back().message, "three");
}

TEST(Diagnostics, TellWhatComesFromTheFile) {
    Diagnostics diagnostics;
    diagnostics.warn("a.gltf", "no camera");
    WarningCollector(diagnostics).once("a.gltf", "data is ignored");
    EXPECT_FALSE(diagnostics.list()[0].of_file);
    EXPECT_TRUE(diagnostics.list()[1].of_file);
}

TEST(Diagnostics, BoundWhatAHostileFileSays) {
    Diagnostics diagnostics;
    WarningCollector report(diagnostics);
    for (std::size_t i = 0; i < limits::max_warnings + 9; ++i)
        report.once("a:1", "kind " + std::to_string(i));
    ASSERT_EQ(diagnostics.list().size(), limits::max_warnings + 1);
    EXPECT_EQ(diagnostics.warnings().back(), "a:1: further kinds of warnings are left out");
    for (std::size_t i = 0; i < limits::max_warning_places + 5; ++i)
        report.once("a:" + std::to_string(i), "kind 0");
    report.once("b", "kind 0");
    const Warning& many = diagnostics.list().front();
    EXPECT_LE(many.places.size(), limits::max_warning_places);
    EXPECT_GE(many.places_left_out, 6U);
    EXPECT_EQ(many.places.size() + many.places_left_out, limits::max_warning_places + 7);
    EXPECT_EQ(warning_details(many).back(),
              "  and " + std::to_string(many.places_left_out) + " more places");
}

}  // namespace
}  // namespace weft::diagnostics_test
