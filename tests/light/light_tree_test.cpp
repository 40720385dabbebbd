// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "scene/flat_scene.h"
#include "tests/testing/environment_images.h"
#include "tests/testing/floor_scenes.h"

#define NATIVE_KERNELS "kernels/light/light_tree.h"
#include "tests/testing/native_kernels.h"

// The choice of lights by the tree: its probabilities are those with which it chooses, no light
// that shines on a point has the probability 0, and far from lights they go by irradiance. That
// paths which choose so find the light of closed forms is tested in path_lights_test.cpp and
// path_roulette_test.cpp.
namespace weft::light_tree_test {
namespace {

using test::SceneBuilder;

enum class Kind : std::uint8_t { panel, two_sided, bent, point, spot, sun };
constexpr std::array kinds{Kind::panel, Kind::two_sided, Kind::bent,
                           Kind::point, Kind::spot,      Kind::sun};

/// A tree over the lights of a scene.
struct Tree {
    std::vector<native::LightNode> nodes;
    std::vector<shared::LightRecord> lights;
    native::RenderParams params{};

    [[nodiscard]] float probability(const native::LitPoint& at, std::size_t light) const {
        return native::light_probability_at(&params, nodes.data(), &at, lights[light].node);
    }
};

Tree tree_of(const Scene& scene) {
    const FlatScene flat = flatten(scene);
    Tree tree;
    tree.lights = flat.lights;
    tree.params.scene.extent = flat.extent;
    static_assert(sizeof(native::LightNode) == sizeof(shared::LightNode));
    tree.nodes.resize(flat.light_nodes.size());
    std::memcpy(tree.nodes.data(), flat.light_nodes.data(),
                flat.light_nodes.size() * sizeof(shared::LightNode));
    return tree;
}

/// Random numbers, the same ones each time.
class Dice {
  public:
    explicit Dice(std::uint32_t seed) : random_(seed) {}
    float between(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }
    glm::vec3 place(float most) {
        const float x = between(-most, most);
        const float y = between(-most, most);
        return {x, y, between(-most, most)};
    }
    glm::vec3 direction() {
        glm::vec3 found(0.0F);
        while (!(glm::length(found) > 0.1F && glm::length(found) < 1.0F)) found = place(1.0F);
        return glm::normalize(found);
    }

  private:
    std::mt19937 random_;
};

/// A scene of `count` lights of all kinds in a cube of edge 2, dim and bright, small and large.
Scene many_lights(std::size_t count, std::uint32_t seed) {
    Dice dice(seed);
    SceneBuilder builder;
    builder.add(test::quad_mesh({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}),
                builder.material(glm::vec3(0.5F)));
    for (std::size_t i = 0; i < count; ++i) {
        const glm::vec3 at = dice.place(1.0F);
        const glm::vec3 radiance(std::exp2(dice.between(-8.0F, 8.0F)));
        const glm::vec3 edge = dice.direction() * std::exp2(dice.between(-6.0F, 0.0F));
        const glm::vec3 other = glm::cross(edge, dice.direction());
        const Kind kind = kinds[i % kinds.size()];
        switch (kind) {
            case Kind::panel:
            case Kind::two_sided:
            case Kind::bent: {
                Mesh mesh = test::quad_mesh(at, edge, other);
                if (kind == Kind::bent)
                    mesh.positions[3] += glm::cross(edge, other) / glm::length(edge);
                const std::uint32_t material = builder.material(glm::vec3(0.0F), radiance);
                builder.scene.materials[material].emission.both_sides = kind == Kind::two_sided;
                builder.add(mesh, material);
                break;
            }
            case Kind::point:
                builder.light(LightType::point, glm::dvec3(at), radiance);
                break;
            case Kind::spot: {
                PunctualLight& spot = builder.light(LightType::spot, glm::dvec3(at), radiance);
                spot.direction = glm::dvec3(dice.direction());
                spot.cos_outer = dice.between(-0.5F, 0.95F);
                spot.cos_inner = spot.cos_outer + 0.04F;
                spot.linear_edge = i % 2 == 0;
                break;
            }
            case Kind::sun:
                builder.light(LightType::directional, {}, radiance).direction =
                    glm::dvec3(dice.direction());
                break;
        }
    }
    return std::move(builder.scene);
}

native::LitPoint lit_point(const glm::vec3& position, const glm::vec3& normal) {
    native::LitPoint lit{};
    lit.position = native::f3(position.x, position.y, position.z);
    lit.normal = native::f3(normal.x, normal.y, normal.z);
    lit.shading = lit.normal;
    return lit;
}

TEST(LightTree, NodesReferToEachOther) {
    for (const std::size_t count : {2U, 7U, 8U, 9U, 65U, 600U}) {
        const Tree tree = tree_of(many_lights(count, 1));
        ASSERT_EQ(tree.lights.size(), count);
        std::vector<int> met(count, 0);
        for (std::uint32_t i = 0; i < tree.nodes.size(); ++i) {
            const native::LightNode& node = tree.nodes[i];
            if (node.count == 0) {
                ++met.at(node.first);
                EXPECT_EQ(tree.lights[node.first].node, i);
                continue;
            }
            ASSERT_LE(node.count, LIGHT_CHILDREN);
            ASSERT_LE(node.first + node.count, tree.nodes.size());
            for (std::uint32_t k = 0; k < node.count; ++k) {
                EXPECT_EQ(tree.nodes[node.first + k].parent, i);
                EXPECT_GT(node.first, i);
            }
        }
        EXPECT_EQ(std::count(met.begin(), met.end(), 1), static_cast<std::ptrdiff_t>(count));
    }
    EXPECT_TRUE(flatten(many_lights(1, 1)).light_nodes.empty());
    EXPECT_TRUE(flatten(many_lights(0, 1)).light_nodes.empty());
}

TEST(LightTree, ChoosesWithTheProbabilitiesThatItStates) {
    constexpr int steps = 1 << 14;
    for (const std::size_t count : {2U, 8U, 60U}) {
        const Tree tree = tree_of(many_lights(count, 2));
        Dice dice(3);
        for (int trial = 0; trial < 20; ++trial) {
            const glm::vec3 at = dice.place(1.5F);
            const native::LitPoint lit = lit_point(at, dice.direction());
            std::vector<int> chosen(count, 0);
            int none = 0;
            for (int k = 0; k < steps; ++k) {
                const float u = (static_cast<float>(k) + 0.5F) / static_cast<float>(steps);
                float probability = -1.0F;
                const std::uint32_t light =
                    native::choose_light_at(&tree.params, tree.nodes.data(), &lit, u, &probability);
                if (!(probability > 0.0F)) {
                    ++none;
                    continue;
                }
                ASSERT_LT(light, count);
                ++chosen[light];
                ASSERT_NEAR(probability, tree.probability(lit, light), 1e-5F * probability);
            }
            double sum = static_cast<double>(none) / steps;
            for (std::size_t i = 0; i < count; ++i) {
                // At equal steps, each node on the way to a light is met as often as it should be
                // but for one step at either end.
                const float expected = tree.probability(lit, i);
                EXPECT_NEAR(static_cast<float>(chosen[i]) / steps, expected, 2.5F / steps);
                sum += static_cast<double>(expected);
            }
            EXPECT_NEAR(sum, 1.0, 4.0 / steps);
            // Nothing is lost where all lights are children of the root.
            if (count <= LIGHT_CHILDREN && none > 0) {
                EXPECT_EQ(none, steps);
            }
        }
    }
}

/// Whether a corner of an area light, or a light without area, shines on a point.
bool shines_on(const FlatScene& flat, std::size_t light, const glm::vec3& at,
               const glm::vec3& normal) {
    // Nearer to the edge of what shines than this, rounding decides.
    constexpr double edge = 1e-5;
    const shared::LightRecord& record = flat.lights[light];
    const glm::dvec3 n(normal);
    const glm::dvec3 x(at);
    if (record.kind == EMITTER_DIRECTIONAL)
        return -glm::dot(n, glm::dvec3(record.axis.x, record.axis.y, record.axis.z)) > edge;
    if (record.kind != EMITTER_AREA) {
        const glm::dvec3 d =
            glm::dvec3(record.position.x, record.position.y, record.position.z) - x;
        const glm::dvec3 axis(record.axis.x, record.axis.y, record.axis.z);
        return glm::dot(n, d) > edge * glm::length(d) &&
               (record.kind == EMITTER_POINT ||
                -glm::dot(axis, d) >
                    (static_cast<double>(record.cos_outer) + edge) * glm::length(d));
    }
    const bool both_sides = record.both_sides != 0;
    for (std::uint32_t k = 0; k < record.count; ++k) {
        const shared::Triangle& triangle = flat.triangles[flat.emissive[record.first + k].triangle];
        const auto corner = [&](std::uint32_t vertex) {
            const shared::float4& p = flat.positions[vertex];
            return glm::dvec3(p.x, p.y, p.z);
        };
        const std::array corners{corner(triangle.v0), corner(triangle.v1), corner(triangle.v2)};
        const glm::dvec3 up =
            glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
        for (const glm::dvec3& from : corners) {
            const glm::dvec3 d = from - x;
            const double cosine = -glm::dot(up, d);
            if (glm::dot(n, d) > edge * glm::length(d) &&
                (both_sides ? std::abs(cosine) : cosine) > edge * glm::length(d))
                return true;
        }
    }
    return false;
}

TEST(LightTree, EveryLightThatShinesOnAPointMayBeChosen) {
    int shine = 0;
    int never = 0;
    for (const std::size_t count : {2U, 8U, 60U, 300U}) {
        const Scene scene = many_lights(count, 4);
        const FlatScene flat = flatten(scene);
        const Tree tree = tree_of(scene);
        Dice dice(5);
        for (int trial = 0; trial < 100; ++trial) {
            const glm::vec3 at = dice.place(1.5F);
            const glm::vec3 normal = dice.direction();
            const native::LitPoint lit = lit_point(at, normal);
            for (std::size_t i = 0; i < count; ++i) {
                const float probability = tree.probability(lit, i);
                ASSERT_GE(probability, 0.0F);
                ASSERT_LE(probability, 1.00001F);
                never += probability == 0.0F ? 1 : 0;
                if (!shines_on(flat, i, at, normal)) continue;
                ++shine;
                ASSERT_GT(probability, 0.0F) << count << " lights, light " << i;
            }
        }
    }
    // Both happen often.
    EXPECT_GT(shine, 5000);
    EXPECT_GT(never, 5000);
}

TEST(LightTree, FarLightsAreChosenByTheirIrradiance) {
    // Panels so small that all of their points bring the same. All of the probability but the equal
    // part goes by radiance times area, cosines and distance.
    SceneBuilder builder = test::floor_scene();
    std::vector<double> irradiances;
    for (int i = 0; i < 5; ++i) {
        const glm::dvec3 place(0.3 * i - 0.7, 0.1 * i, 0.5 + 0.1 * i);
        const double radiance = 1.0 + i;
        const auto edge = static_cast<float>(0.002 * (1 + i));
        builder.add(test::quad_mesh(glm::vec3(place), {0, edge, 0}, {edge, 0, 0}),
                    builder.material(glm::vec3(0.0F), glm::vec3(static_cast<float>(radiance))));
        const double distance = glm::length(place);
        const double cosine = place.z / distance;
        const double area = static_cast<double>(edge) * static_cast<double>(edge);
        irradiances.push_back(radiance * area * cosine * cosine / (distance * distance));
    }
    const Tree tree = tree_of(builder.scene);
    const glm::vec3 origin(flatten(builder.scene).units.point(glm::dvec3(0.0)));
    const native::LitPoint lit = lit_point(origin, {0.0F, 0.0F, 1.0F});
    double sum = 0.0;
    for (const double irradiance : irradiances) sum += irradiance;
    for (std::size_t i = 0; i < irradiances.size(); ++i) {
        const double expected =
            static_cast<double>(LIGHT_EQUAL_SHARE) / 5.0 +
            (1.0 - static_cast<double>(LIGHT_EQUAL_SHARE)) * irradiances[i] / sum;
        // The middle of a panel is up to 0.01 from its corner, 0.5 away.
        EXPECT_NEAR(tree.probability(lit, i), expected, 0.03 * expected) << i;
    }
}

TEST(LightTree, AnImageOfTheEnvironmentIsChosenByItsMeanIrradiance) {
    SceneBuilder builder = test::floor_scene();
    builder.light(LightType::directional, {}, glm::vec3(3.0F), {0.0, 0.0, -1.0});
    const auto set_image = [&](const EnvironmentImage& image) {
        builder.scene.environment =
            Environment{glm::vec3(1.0F), std::make_shared<const EnvironmentImage>(image)};
    };
    set_image(test::constant_image(glm::vec3(2.0F)));
    const Tree tree = tree_of(builder.scene);
    const double equal = static_cast<double>(LIGHT_EQUAL_SHARE);
    const double share = 2.0 * std::numbers::pi / (2.0 * std::numbers::pi + 3.0);
    EXPECT_NEAR(tree.probability(lit_point(glm::vec3(0.0F), {0, 0, 1}), 1),
                0.5 * equal + (1.0 - equal) * share, 1e-5);
    // The sun does not shine on what faces down, the sky does.
    EXPECT_EQ(tree.probability(lit_point(glm::vec3(0.0F), {0, 0, -1}), 0), 0.0F);
    EXPECT_EQ(tree.probability(lit_point(glm::vec3(0.0F), {0, 0, -1}), 1), 1.0F);
    // More where a surface faces what is bright, and never nothing.
    set_image(test::one_texel(8, 4, 5, 1, glm::vec3(100.0F)));
    const Tree one_side = tree_of(builder.scene);
    const glm::vec3 towards(test::texel_direction(*builder.scene.environment->image, 5, 1));
    const glm::vec3 aside = glm::normalize(glm::cross(towards, glm::vec3(0.0F, 1.0F, 0.0F)));
    const float facing = one_side.probability(lit_point(glm::vec3(0.0F), towards), 1);
    const float across = one_side.probability(lit_point(glm::vec3(0.0F), aside), 1);
    EXPECT_GT(facing, across);
    // The sun shines alike on what faces away and what faces across.
    builder.scene.lights[0].direction = glm::dvec3(glm::normalize(towards - aside));
    const Tree from_between = tree_of(builder.scene);
    const float behind = from_between.probability(lit_point(glm::vec3(0.0F), -towards), 1);
    EXPECT_GT(from_between.probability(lit_point(glm::vec3(0.0F), aside), 1), behind);
    EXPECT_GT(behind, 0.0F);
}

TEST(LightTree, AnImageOfTheEnvironmentMayBeChosenAmongAllKindsOfLights) {
    for (const std::size_t count : {1U, 8U, 60U}) {
        Scene scene = many_lights(count, 9);
        scene.environment = Environment{
            glm::vec3(0.01F), std::make_shared<const EnvironmentImage>(test::sunny_sky())};
        const Tree tree = tree_of(scene);
        ASSERT_EQ(tree.lights.size(), count + 1);
        Dice dice(10);
        for (int trial = 0; trial < 50; ++trial) {
            const glm::vec3 at = dice.place(1.5F);
            const native::LitPoint lit = lit_point(at, dice.direction());
            EXPECT_GT(tree.probability(lit, count), 0.0F);
            double sum = 0.0;
            for (std::size_t i = 0; i <= count; ++i)
                sum += static_cast<double>(tree.probability(lit, i));
            // Less where a node that is chosen turns out to bring nothing.
            EXPECT_LE(sum, 1.00001);
            if (count < LIGHT_CHILDREN) {
                EXPECT_NEAR(sum, 1.0, 1e-5);
            }
        }
    }
}

TEST(LightTree, ExtremeLightsKeepProbabilitiesFinite) {
    // The same place and brightnesses at the ends of the range, on the point itself and far away.
    SceneBuilder builder = test::floor_scene();
    for (const float intensity : {1e-30F, 1.0F, 1e30F})
        for (const glm::dvec3& at : {glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1e-7), glm::dvec3(0.3)})
            builder.light(LightType::point, at, glm::vec3(intensity));
    const Tree tree = tree_of(builder.scene);
    for (const glm::vec3& at :
         {glm::vec3(0.0F), glm::vec3(0.0F, 0.0F, -1e-30F), glm::vec3(1e15F)}) {
        const native::LitPoint lit = lit_point(at, {0.0F, 0.0F, 1.0F});
        double sum = 0.0;
        for (std::size_t i = 0; i < tree.lights.size(); ++i) {
            const float probability = tree.probability(lit, i);
            ASSERT_TRUE(std::isfinite(probability) && probability >= 0.0F);
            sum += static_cast<double>(probability);
        }
        EXPECT_LE(sum, 1.00001);
    }
}

}  // namespace
}  // namespace weft::light_tree_test
