// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/matte_pass.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "film/cryptomatte.h"
#include "image/background.h"
#include "tests/testing/half_plane.h"
#include "tests/testing/session_fixture.h"

namespace weft::matte_pass_test {
namespace {

using test::CountedSession;
using test::KeptOutput;
using test::TestBackend;

constexpr std::uint32_t width = 48;
constexpr std::uint32_t height = 36;

/// Two half-planes that meet at a line, before nothing on the lower side of another line.
Scene two_halves(const test::Line& line) {
    test::SceneBuilder builder;
    const std::uint32_t red = builder.material({0.7F, 0.1F, 0.1F});
    const std::uint32_t blue = builder.material({0.1F, 0.1F, 0.7F});
    builder.scene.materials[red].name = "red";
    builder.scene.materials[blue].name = "blue";
    builder.add(test::half_plane(line, 0.0, width, height), red);
    builder.add(test::quad_mesh({-2, -2, -0.5F}, {4, 0, 0}, {0, 1.5F, 0}), blue);
    builder.scene.instances[0].name = "half";
    builder.scene.instances[1].name = "panel";
    builder.light(LightType::directional, {0, 0, 9}, {1.0F, 1.0F, 1.0F});
    return builder.scene;
}

/// Renders an image with identifiers as the session hands it over.
Image with_mattes(TestBackend backend, const Scene& scene, const Camera& camera,
                  const ImageSettings& settings, const MatteSettings& mattes = {true, true}) {
    CountedSession made = test::counted_session(backend, scene, camera, settings);
    KeptOutput output;
    made.session->set_output(&output);
    made.session->set_mattes(mattes);
    EXPECT_EQ(made.session->render({}), SessionEnd::complete);
    EXPECT_EQ(output.images.size(), 1U);
    return output.images.at(0).image;
}

/// Coverage of a pixel by identifier.
std::map<std::uint32_t, double> shares(const Image& image, const std::string& layer,
                                       std::size_t pixel) {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    std::map<std::uint32_t, double> found;
    double before = 1.0;
    for (const char* const number : {"00", "01", "02"}) {
        const std::vector<float>& values = image.find(layer + number)->values;
        for (const std::size_t first : {std::size_t{0}, 2 * pixels}) {
            const auto share = static_cast<double>(values[first + pixels + pixel]);
            if (share == 0.0) continue;
            EXPECT_LE(share, before) << "ranks are not in order";
            before = share;
            found[std::bit_cast<std::uint32_t>(values[first + pixel])] += share;
        }
    }
    return found;
}

TEST(MattePass, CoverageIsThatOfTheImage) {
    const test::Line line = test::line_at(33.0, width, height);
    const Scene scene = two_halves(line);
    RenderSettings ais = test::small_settings(Algorithm::ais, width, height);
    for (const TestBackend backend : test::backends())
        for (const ImageSettings& settings :
             {ImageSettings(ais), ImageSettings(test::small_path(width, height, 64))}) {
            SCOPED_TRACE(test::backend_name(backend));
            const Image image = with_mattes(backend, scene, test::front_camera(), settings);
            double off = 0.0;
            for (std::uint32_t y = 0; y < height; ++y)
                for (std::uint32_t x = 0; x < width; ++x) {
                    const std::size_t pixel = std::size_t{y} * width + x;
                    const auto objects = shares(image, "CryptoObject", pixel);
                    const auto materials = shares(image, "CryptoMaterial", pixel);
                    double sum = 0.0;
                    for (const auto& [id, share] : objects) {
                        EXPECT_TRUE(id == cryptomatte_id("half") || id == cryptomatte_id("panel"));
                        sum += share;
                    }
                    const auto alpha = static_cast<double>(alpha_of(image)[pixel]);
                    if (alpha == 0.0 || alpha == 1.0) {
                        ASSERT_NEAR(sum, alpha, 0.13) << x << ", " << y;
                    }
                    // The nearer one covers what it covers.
                    const double exact = test::coverage(line, x, y);
                    const auto half = objects.find(cryptomatte_id("half"));
                    const double found = half != objects.end() ? half->second : 0.0;
                    if (exact == 0.0 || exact == 1.0) {
                        ASSERT_EQ(found, exact);
                    }
                    off = std::max(off, std::abs(found - exact));
                    // Here every object has a material of its own.
                    ASSERT_EQ(materials.size(), objects.size());
                    if (half != objects.end()) {
                        ASSERT_EQ(materials.at(cryptomatte_id("red")), found);
                    }
                }
            // 16 points of a Halton sequence: within three of them.
            EXPECT_LT(off, 0.19);
        }
}

TEST(MattePass, ImagesWithoutSmoothEdgesHaveNone) {
    const test::Line line = test::line_at(33.0, width, height);
    const Image image = with_mattes(TestBackend::own_bvh, two_halves(line), test::front_camera(),
                                    test::small_settings(Algorithm::igi, width, height));
    for (std::size_t pixel = 0; pixel < std::size_t{width} * height; ++pixel) {
        const auto objects = shares(image, "CryptoObject", pixel);
        ASSERT_EQ(objects.size(), alpha_of(image)[pixel] > 0.0F ? 1U : 0U);
        if (!objects.empty()) {
            ASSERT_EQ(objects.begin()->second, 1.0);
        }
    }
}

TEST(MattePass, OnlyWhatIsAskedForIsThereAndCosts) {
    const Scene scene = two_halves(test::line_at(33.0, width, height));
    const ImageSettings settings(test::small_path(width, height, 2));
    const Image objects =
        with_mattes(TestBackend::own_bvh, scene, test::front_camera(), settings, {true, false});
    EXPECT_NE(objects.find("CryptoObject00"), nullptr);
    EXPECT_EQ(objects.find("CryptoMaterial00"), nullptr);
    CountedSession made =
        test::counted_session(TestBackend::own_bvh, scene, test::front_camera(), settings);
    KeptOutput output;
    made.session->set_output(&output);
    ASSERT_EQ(made.session->render({}), SessionEnd::complete);
    EXPECT_EQ(made.allocations("G-buffer of identifiers"), 0U);
    EXPECT_FALSE(made.has_built("gbuffer"));
    // And the light is the same with them.
    const Image& plain = output.images.at(0).image;
    for (const Layer& layer : plain.layers)
        EXPECT_EQ(layer.values, objects.find(layer.name)->values) << layer.name;
}

TEST(MattePass, NamesAreUniqueAndPartsOfAMeshAreOneObject) {
    Scene scene;
    scene.materials.resize(3);
    scene.materials[0].name = "wood";
    scene.materials[2].name = "wood";
    const auto add = [&](const std::string& name, std::uint32_t mesh, double x,
                         std::uint32_t material) {
        Instance instance;
        instance.name = name;
        instance.mesh = mesh;
        instance.material = material;
        instance.to_world = test::placement(1.0, {x, 0.0, 0.0});
        scene.instances.push_back(instance);
    };
    add("chair", 0, 0.0, 0);
    add("chair", 1, 0.0, 1);  // a second part
    add("chair", 0, 5.0, 2);  // another chair
    add("", 2, 0.0, 0);
    add("chair#2", 2, 9.0, 0);
    EXPECT_EQ(object_names(scene),
              (std::vector<std::string>{"chair", "chair", "chair#2", "object 3", "chair#2#2"}));
    EXPECT_EQ(material_names(scene),
              (std::vector<std::string>{"wood", "material 1", "wood#2", "wood", "wood"}));
}

TEST(MattePass, FindsTheInstanceThatAPixelShows) {
    for (const TestBackend backend : test::backends()) {
        CountedSession made = test::counted_session(
            backend, two_halves({{width / 2.0, height / 2.0}, {1.0, 0.0}}), test::front_camera(),
            test::small_settings(Algorithm::igi, width, height));
        KeptOutput output;
        made.session->set_output(&output);
        made.session->set_mattes({true, false});
        ASSERT_EQ(made.session->render({}), SessionEnd::complete);
        const Image& image = output.images.at(0).image;
        const std::vector<std::string> names = object_names(made.session->scene().at_rest());
        std::size_t seen = 0;
        for (std::uint32_t y = 0; y < height; y += 5)
            for (std::uint32_t x = 0; x < width; x += 5) {
                const auto found = made.session->instance_at(x, y);
                const auto all = shares(image, "CryptoObject", std::size_t{y} * width + x);
                if (all.size() > 1) continue;  // an edge
                ASSERT_EQ(found.has_value(), !all.empty()) << x << ' ' << y;
                if (!found) continue;
                ++seen;
                EXPECT_EQ(cryptomatte_id(names.at(*found)), all.begin()->first) << x << ' ' << y;
            }
        EXPECT_GT(seen, 10U);
        EXPECT_FALSE(made.session->instance_at(width, 0));
        EXPECT_FALSE(made.session->instance_at(0, height));
    }
}

}  // namespace
}  // namespace weft::matte_pass_test
