// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The shipped scenes that have more than diffuse surfaces.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/testing/run_program.h"

namespace weft::shipped_materials_test {
namespace {

using nlohmann::json;
using test::ProgramResult;
using test::run_program;
using test::shipped_scene;

/// What `weft info` says of a scene, which loads without a word.
json info_of(const std::string& scene) {
    const ProgramResult result = run_program({"info", "--json", shipped_scene(scene)});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_EQ(result.err, "");
    return json::parse(result.out);
}

/// The names of all lobes of the surface of a material.
std::set<std::string> lobes_of(const json& info, const std::string& material) {
    std::set<std::string> names;
    for (const json& surface : info.at("surfaces")) {
        if (surface.at("name") != material) continue;
        for (const json& lobe : surface.at("lobes")) names.insert(lobe.at("name"));
    }
    return names;
}

using Names = std::set<std::string>;

TEST(ShippedMaterials, StillLifeIsLitByTheSkyInItsFile) {
    const json info = info_of("still-life.gltf");
    EXPECT_TRUE(info.at("approximations").empty());
    ASSERT_EQ(info.at("light_list").size(), 1u);
    EXPECT_EQ(info.at("light_list")[0].at("default"), false);
    EXPECT_EQ(lobes_of(info, "copper"), Names{"metal"});
    EXPECT_EQ(lobes_of(info, "red plastic"), (Names{"dielectric", "diffuse"}));
    EXPECT_EQ(lobes_of(info, "bottle glass"), (Names{"dielectric", "glass"}));
    EXPECT_EQ(lobes_of(info, "wine"), (Names{"dielectric", "glass"}));
}

TEST(ShippedMaterials, BathroomHasAMirrorGlassAndWater) {
    const json info = info_of("bathroom.gltf");
    EXPECT_TRUE(info.at("approximations").empty());
    EXPECT_EQ(lobes_of(info, "mirror"), Names{"metal"});
    EXPECT_EQ(lobes_of(info, "tile"), (Names{"dielectric", "diffuse"}));
    EXPECT_EQ(lobes_of(info, "water"), (Names{"dielectric", "glass"}));
    EXPECT_EQ(lobes_of(info, "plaster"), Names{}) << "is diffuse";
}

TEST(ShippedMaterials, CarPaintHasACoatOverMetal) {
    const json info = info_of("car-paint.gltf");
    EXPECT_TRUE(info.at("approximations").empty());
    EXPECT_EQ(lobes_of(info, "paint"), (Names{"clear coat", "metal"}));
    EXPECT_EQ(lobes_of(info, "lens"), (Names{"dielectric", "glass"}));
    EXPECT_EQ(lobes_of(info, "pane"), (Names{"dielectric", "thin glass"}));
}

}  // namespace
}  // namespace weft::shipped_materials_test
