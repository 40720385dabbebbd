// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "image/exr.h"
#include "tests/testing/environment_images.h"
#include "tests/testing/mitsuba_folder.h"

// The envmap of Mitsuba scenes: its texels are where Mitsuba 3 has them, by its formulas for the
// coordinates of a direction, whatever to_world says.
namespace weft::mitsuba_envmap_test {
namespace {

constexpr std::uint32_t width = 8;
constexpr std::uint32_t height = 5;

/// A folder with an image whose texel (i, j) is 1 + i + 10 j.
class EnvmapFolder : public MitsubaFolder {
  public:
    EnvmapFolder() {
        Image image;
        image.width = width;
        image.height = height;
        image.layers = {{"", "RGB", {}}};
        for (int c = 0; c < 3; ++c)
            for (std::uint32_t j = 0; j < height; ++j)
                for (std::uint32_t i = 0; i < width; ++i)
                    image.layers[0].values.push_back(static_cast<float>(1 + i + 10 * j));
        write_exr(folder().path() / "sky.exr", image);
    }

    Scene read_envmap(const std::string& content) {
        return read("<emitter type=\"envmap\">" + content + "</emitter>");
    }
};

const std::string sky = "<string name=\"filename\" value=\"sky.exr\"/>";

/// What Mitsuba shows in a direction of the emitter's own space (envmap.cpp of Mitsuba 3):
/// u = atan2(x, -z) / 2 pi, whose texels have their middles at odd multiples of 1 / 2 width, and
/// v = acos(y) / pi, whose rows lie at multiples of 1 / (height - 1).
double shown_by_mitsuba(const glm::dvec3& d) {
    double u = std::atan2(d.x, -d.z) / (2.0 * std::numbers::pi) - 0.5 / width;
    u -= std::floor(u);
    const double v = std::acos(d.y) / std::numbers::pi;
    const auto column = std::min(static_cast<std::uint32_t>(u * width), width - 1);
    const auto row = std::min(static_cast<std::uint32_t>(v * (height - 1)), height - 2);
    const double s = u * width - column;
    const double t = v * (height - 1) - row;
    const auto texel = [](std::uint32_t i, std::uint32_t j) { return 1.0 + i % width + 10.0 * j; };
    return (1 - t) * ((1 - s) * texel(column, row) + s * texel(column + 1, row)) +
           t * ((1 - s) * texel(column, row + 1) + s * texel(column + 1, row + 1));
}

double shown(const Environment& environment, const glm::dvec3& direction) {
    return test::radiance_from(*environment.image, glm::transpose(environment.to_world) * direction)
               .x *
           static_cast<double>(environment.radiance.x);
}

std::vector<glm::dvec3> directions() {
    std::vector<glm::dvec3> all{{1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}};
    for (int i = 0; i < 200; ++i)
        all.push_back(test::direction_at(std::fmod(0.5 + i * 0.754877666, 1.0),
                                         std::fmod(0.5 + i * 0.569840291, 1.0)));
    return all;
}

TEST(MitsubaEnvmap, TexelsAreWhereMitsubaHasThem) {
    EnvmapFolder folder;
    const Scene scene = folder.read_envmap(sky + "<float name=\"scale\" value=\"2.5\"/>");
    EXPECT_TRUE(folder.warnings().empty());
    ASSERT_TRUE(scene.environment && scene.environment->image);
    EXPECT_EQ(scene.environment->radiance, glm::vec3(2.5F));
    for (const glm::dvec3& d : directions())
        EXPECT_NEAR(shown(*scene.environment, d), 2.5 * shown_by_mitsuba(d), 1e-5)
            << d.x << ' ' << d.y << ' ' << d.z;
    // The middle of the image is +z.
    EXPECT_NEAR(shown(*scene.environment, {0, 0, 1}), 2.5 * (1 + 3.5 + 20), 1e-5);
}

TEST(MitsubaEnvmap, ToWorldTurnsAndMirrors) {
    EnvmapFolder folder;
    const glm::dmat3 about_x{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}};
    const glm::dmat3 mirror{{-1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (const auto& [transform, matrix] :
         {std::pair{"<rotate x=\"1\" angle=\"90\"/>", about_x},
          std::pair{"<scale x=\"-1\"/>", mirror},
          std::pair{"<scale value=\"3\"/><translate x=\"7\"/>", glm::dmat3(1.0)}}) {
        const Scene scene =
            folder.read_envmap(sky + "<transform name=\"to_world\">" + transform + "</transform>");
        ASSERT_TRUE(scene.environment && scene.environment->image);
        for (const glm::dvec3& d : directions())
            EXPECT_NEAR(shown(*scene.environment, matrix * d), shown_by_mitsuba(d), 1e-5)
                << transform;
    }
}

TEST(MitsubaEnvmap, WrongOnesAreRefused) {
    EnvmapFolder folder;
    const auto error = [&](const std::string& content) {
        return folder.error("<emitter type=\"envmap\">" + content + "</emitter>");
    };
    EXPECT_EQ(error(""), "s.xml:2: emitter 'envmap' without 'filename', expected one");
    EXPECT_EQ(error("<string name=\"filename\" value=\"s.xml\"/>"),
              "s.xml: is not an image, expected an OpenEXR, Radiance HDR or PNG file");
    EXPECT_EQ(error(sky + "<float name=\"scale\" value=\"-1\"/>"),
              "s.xml:2: bad scale of an envmap, expected 0 or more");
    EXPECT_EQ(error(sky + "<transform name=\"to_world\"><scale x=\"2\"/></transform>"),
              "s.xml:2: envmap that to_world distorts, expected a rotation");
    EXPECT_NE(error("<string name=\"filename\" value=\"../sky.exr\"/>"), "no error");
}

TEST(MitsubaEnvmap, TheFirstEnvironmentCounts) {
    EnvmapFolder folder;
    const std::string constant = "<emitter type=\"constant\"/>";
    const std::string envmap = "<emitter type=\"envmap\">" + sky + "</emitter>";
    EXPECT_FALSE(folder.read(constant + envmap).environment->image);
    EXPECT_EQ(folder.warnings().size(), 1U);
    EXPECT_TRUE(folder.read(envmap + constant).environment->image);
    EXPECT_EQ(folder.warnings().size(), 1U);
}

}  // namespace
}  // namespace weft::mitsuba_envmap_test
