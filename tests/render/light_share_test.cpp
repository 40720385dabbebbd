// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "tests/testing/counting_executor.h"
#include "tests/testing/render_fixture.h"

// What a first frame says of its light where it ends early.
namespace weft::light_share_test {
namespace {

using test::TestBackend;

/// An executor whose launches are quarters.
class QuarteredExecutor : public test::CountingExecutor {
  public:
    using CountingExecutor::CountingExecutor;
    bool run(const Launch& launch, const std::function<bool(double done)>& keep_going) override {
        return test::run_in_quarters(inner(), launch, keep_going);
    }
};

FlatScene lit_room() {
    test::SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material({0.7F, 0.6F, 0.5F}));
    builder.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0, 0}, {0, 0, 0.4F}),
                builder.material(glm::vec3(0.5F), {8.0F, 9.0F, 7.0F}));
    builder.add(test::icosphere(2, false), builder.material({0.4F, 0.5F, 0.8F}),
                test::placement(0.3, {-0.2, -0.5, -0.3}));
    return flatten(builder.scene);
}

bool is_black(const Layer& layer) {
    return std::all_of(layer.values.begin(), layer.values.end(), [](float v) { return v == 0.0F; });
}

TEST(LightShare, GrowsFromNothingToAll) {
    const FlatScene scene = lit_room();
    const Camera camera = test::look_at({0.2, 0.2, 0.9}, {-0.1, -0.2, 0.0}, 1.2);
    struct Case {
        Algorithm algorithm;
        bool bounce_rays = false;
    };
    for (const auto& [algorithm, bounce_rays] :
         {Case{Algorithm::ais}, Case{Algorithm::ais, true}, Case{Algorithm::amax},
          Case{Algorithm::igi}, Case{Algorithm::ic}, Case{Algorithm::irradiance_cache}}) {
        SCOPED_TRACE(static_cast<int>(algorithm));
        RenderSettings settings = test::small_settings(algorithm, 45, 38);
        settings.sampling.bounce_rays = bounce_rays;
        settings.sampling.vpls_per_set = 8;
        settings.sampling.threshold = 2.0;
        QuarteredExecutor executor(test::make_executor(TestBackend::embree));
        std::map<std::string, double> before{{"direct", 0.0}, {"indirect", 0.0}};
        bool indirect_in_part = false;
        bool complete = false;
        for (int ends = 0; !complete; ++ends) {
            SCOPED_TRACE(std::to_string(ends) + " calls");
            ASSERT_LT(ends, 1000);
            Renderer renderer(executor, scene, camera, settings);
            int calls = ends;
            complete = renderer.render_frame([&](Stage, double) { return calls-- > 0; });
            const std::vector<LightShare> light = renderer.light();
            if (ends == 0) {
                EXPECT_TRUE(is_dark(light));
            }
            if (light.empty()) continue;  // all of it is there
            ASSERT_FALSE(complete);
            ASSERT_EQ(light.size(), 2U);
            const Image image = renderer.image();
            for (const auto& [component, share] : light) {
                ASSERT_TRUE(before.contains(component)) << component;
                // Later rounds of records may take some of their light back.
                if (algorithm != Algorithm::irradiance_cache) {
                    EXPECT_GE(share, before[component]) << component;
                }
                EXPECT_LE(share, 1.0) << component;
                before[component] = share;
                if (share == 0.0 && algorithm != Algorithm::ic &&
                    algorithm != Algorithm::irradiance_cache) {
                    EXPECT_TRUE(is_black(*image.find(component))) << component;
                }
                if (share == 1.0) {
                    EXPECT_FALSE(is_black(*image.find(component))) << component;
                }
            }
            EXPECT_TRUE(before["indirect"] == 0.0 || before["direct"] == 1.0) << "comes first";
            indirect_in_part =
                indirect_in_part || (before["indirect"] > 0.0 && before["indirect"] < 1.0);
        }
        EXPECT_TRUE(indirect_in_part);
    }
}

TEST(LightShare, IsThatOfTheImageAlone) {
    const FlatScene scene = lit_room();
    const Camera camera = test::look_at({0.2, 0.2, 0.9}, {-0.1, -0.2, 0.0}, 1.2);
    const RenderSettings settings = test::small_settings(Algorithm::igi, 45, 38);
    Renderer renderer(test::shared_executor(TestBackend::embree), scene, camera, settings);
    const KeepGoing never = [](Stage, double) { return false; };
    EXPECT_FALSE(renderer.render_frame(never));
    EXPECT_FALSE(renderer.light().empty());
    renderer.set_camera(camera);
    EXPECT_TRUE(renderer.light().empty());
    EXPECT_TRUE(renderer.render_frame({}));
    EXPECT_FALSE(renderer.render_frame(never)) << "is dropped";
    EXPECT_EQ(renderer.samples(), 1U);
    EXPECT_TRUE(renderer.light().empty());
}

}  // namespace
}  // namespace weft::light_share_test
