// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/emission_means.h"

#include <gtest/gtest.h>

#include <cstddef>

#include "tests/testing/scene_builder.h"

namespace weft::emission_means_test {
namespace {

Texture grey(std::uint32_t width, std::uint32_t height, std::uint8_t value) {
    Texture texture;
    texture.width = width;
    texture.height = height;
    texture.srgb = false;
    texture.rgba.assign(std::size_t{4} * width * height, value);
    return texture;
}

void set(Texture& texture, std::uint32_t x, std::uint32_t y, std::uint8_t value) {
    for (std::size_t k = 0; k < 4; ++k)
        texture.rgba[4 * (std::size_t{y} * texture.width + x) + k] = value;
}

/// The unit square with texture coordinates from 0 to 1, in n x n cells of two triangles.
Mesh cells(std::uint32_t n) {
    return test::quad_mesh({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, n);
}

/// Those of a mesh in a scene that has no other texture.
std::vector<glm::vec3> emission_means(const Mesh& mesh, const Texture& texture) {
    Scene scene;
    scene.textures.push_back(texture);
    return EmissionMeans(scene).of(mesh, 0);
}

double mean_of(const std::vector<glm::vec3>& means) {
    double sum = 0.0;
    for (const glm::vec3& mean : means) sum += static_cast<double>(mean.g);
    return sum / static_cast<double>(means.size());
}

TEST(EmissionMeans, OfOneColourAreThatColour) {
    Texture texture = grey(7, 3, 0);
    for (std::size_t i = 0; i < texture.rgba.size(); i += 4) {
        texture.rgba[i] = 255;
        texture.rgba[i + 1] = 51;
    }
    for (const glm::vec3& mean : emission_means(cells(3), texture)) {
        EXPECT_NEAR(mean.r, 1.0F, 1e-6F);
        EXPECT_NEAR(mean.g, 0.2F, 1e-6F);
        EXPECT_EQ(mean.b, 0.0F);
    }
}

TEST(EmissionMeans, AddUpToTheTexture) {
    // A gradient, by cells much larger than texels, about as large, and much smaller.
    Texture texture = grey(64, 64, 0);
    for (std::uint32_t y = 0; y < 64; ++y)
        for (std::uint32_t x = 0; x < 64; ++x)
            set(texture, x, y, static_cast<std::uint8_t>(2 * x + y));
    const double expected = 3.0 * 31.5 / 255.0;
    for (const std::uint32_t n : {1U, 5U, 48U, 200U})
        EXPECT_NEAR(mean_of(emission_means(cells(n), texture)), expected, 0.02 * expected) << n;
}

TEST(EmissionMeans, FindASingleBrightTexel) {
    // Wherever it lies, and however large the triangles are beside it.
    for (const std::uint32_t edge : {1U, 13U, 256U})
        for (const std::uint32_t n : {1U, 3U, 40U}) {
            Texture texture = grey(edge, edge, 0);
            const std::uint32_t x = edge / 3;
            const std::uint32_t y = edge * 2 / 3;
            set(texture, x, y, 255);
            const Mesh mesh = cells(n);
            const std::vector<glm::vec3> means = emission_means(mesh, texture);
            // The triangle that the middle of the texel lies in.
            const double u = (x + 0.5) / edge * n;
            const double v = (y + 0.5) / edge * n;
            const auto i = static_cast<std::size_t>(u);
            const auto j = static_cast<std::size_t>(v);
            const bool upper = v - static_cast<double>(j) > u - static_cast<double>(i);
            EXPECT_GT(means.at(2 * (j * n + i) + (upper ? 1 : 0)).g, 0.0F) << edge << " " << n;
            EXPECT_NEAR(mean_of(means), 1.0 / edge / edge, 0.5 / edge / edge) << edge << " " << n;
        }
}

TEST(EmissionMeans, FollowWrappingAndTheirOwnCoordinates) {
    Texture texture = grey(4, 1, 0);
    set(texture, 0, 0, 255);
    Mesh mesh = cells(1);
    mesh.emission_uvs = mesh.uvs;
    for (glm::vec2& uv : mesh.emission_uvs) uv = glm::vec2(0.125F + 3.0F, 0.5F);
    const auto mean = [&](Wrap wrap) {
        texture.wrap_u = wrap;
        return emission_means(mesh, texture).at(0).r;
    };
    EXPECT_EQ(mean(Wrap::repeat), 1.0F);
    EXPECT_EQ(mean(Wrap::clamp), 0.0F);
    EXPECT_EQ(mean(Wrap::mirror), 0.0F);
    mesh.emission_uvs.assign(mesh.uvs.size(), glm::vec2(-0.125F, 0.5F));
    EXPECT_EQ(mean(Wrap::repeat), 0.0F);
    EXPECT_EQ(mean(Wrap::clamp), 1.0F);
    EXPECT_EQ(mean(Wrap::mirror), 1.0F);
}

TEST(EmissionMeans, AreThoseOfTheFirstTexelWithoutCoordinates) {
    Texture texture = grey(2, 2, 0);
    set(texture, 0, 0, 255);
    texture.wrap_u = texture.wrap_v = Wrap::clamp;
    Mesh mesh = cells(1);
    mesh.uvs.clear();
    EXPECT_EQ(emission_means(mesh, texture).at(1).g, 1.0F);
}

TEST(EmissionMeans, AreThoseOfEachTextureInTurn) {
    Scene scene;
    for (const std::uint8_t value : {std::uint8_t{0}, std::uint8_t{51}, std::uint8_t{255}})
        scene.textures.push_back(grey(4, 4, value));
    EmissionMeans means(scene);
    const Mesh mesh = cells(1);
    for (const int texture : {2, 1, 1, 0, 2}) {
        const float expected = texture == 0 ? 0.0F : (texture == 1 ? 0.2F : 1.0F);
        EXPECT_NEAR(means.of(mesh, texture).at(0).r, expected, 1e-6F) << texture;
    }
}

}  // namespace
}  // namespace weft::emission_means_test
