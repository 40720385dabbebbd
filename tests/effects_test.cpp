// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "device/executor.h"
#include "render_fixture.h"

// A frame does what its scene calls for, and nothing else: for each scene the kernels that its plan
// builds, the stages that a frame runs, and the rays that components trace are written out here. A
// component that joins the program must not change any of these lists.
namespace weft {
namespace {

using test::Rendering;
using test::SceneBuilder;

/// What a scene has.
struct Contents {
    bool lamp = false;  ///< an area light
    bool point = false;
    bool sun = false;
    bool sky = false;
    bool black = false;  ///< surfaces reflect nothing
};

FlatScene flat_scene(const Contents& contents) {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(contents.black ? 0.0F : 0.6F)));
    if (contents.lamp)
        builder.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F}),
                    builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    if (contents.point) builder.light(LightType::point, glm::dvec3(0.3, 0.2, 0.1), glm::vec3(1.0F));
    if (contents.sun)
        builder.light(LightType::directional, glm::dvec3(0.0, 1.0, 0.0), glm::vec3(1.0F));
    if (contents.sky) builder.scene.environment = Environment{glm::vec3(0.5F)};
    validate_scene(builder.scene);
    return flatten(builder.scene);
}

RenderSettings settings() {
    RenderSettings small = test::small_settings(Algorithm::ais, 48, 32);
    small.sampling.vpls_per_set = 16;
    return small;
}

std::set<std::string> kernel_names(const FlatScene& flat, const RenderSettings& how) {
    std::set<std::string> names;
    for (const KernelId kernel : kernels_of(plan_for(flat, how)))
        names.insert(std::string(kernel_name(kernel)));
    return names;
}

const std::set<std::string> always{"gbuffer", "receivers", "compose", "edge_masks", "edge_samples"};
const std::set<std::string> area{"tile_geometry", "light_samples",  "soft_shadows",
                                 "tile_shadows",  "lattice_signal", "reconstruct_tiles"};
const std::set<std::string> punctual{"light_samples", "vpl_gather"};
const std::set<std::string> indirect{"tile_geometry", "vpl_walk", "vpl_gather", "lattice_signal",
                                     "reconstruct_tiles"};
const std::set<std::string> sky{"light_samples", "distant_light", "reconstruct"};
const std::set<std::string> sun{"distant_light"};

std::set<std::string> joined(std::initializer_list<std::set<std::string>> parts) {
    std::set<std::string> all = always;
    for (const auto& part : parts) all.insert(part.begin(), part.end());
    return all;
}

struct Case {
    const char* name;
    Contents contents;
    bool direct, indirect;  ///< wanted by the user
    std::set<std::string> kernels;
};

std::vector<Case> cases() {
    const Contents lamp{.lamp = true};
    const Contents point{.point = true};
    const Contents black_lamp{.lamp = true, .black = true};
    return {{"lamp", lamp, true, true, joined({area, indirect})},
            {"lamp, direct alone", lamp, true, false, joined({area})},
            {"lamp, indirect alone", lamp, false, true, joined({indirect})},
            {"point light", point, true, true, joined({punctual, indirect})},
            {"point light, direct alone", point, true, false, joined({punctual})},
            {"sun", {.sun = true}, true, false, joined({sun})},
            {"sky", {.sky = true}, true, false, joined({sky})},
            {"nothing reflects", black_lamp, true, true, joined({area})},
            {"lamp and point light",
             {.lamp = true, .point = true},
             true,
             true,
             joined({area, punctual, indirect})},
            {"no light", {}, true, true, joined({})}};
}

RenderSettings settings_of(const Case& of) {
    RenderSettings how = settings();
    how.direct = of.direct;
    how.indirect = of.indirect;
    return how;
}

TEST(Effects, PlansBuildTheKernelsThatTheSceneCallsFor) {
    for (const Case& of : cases())
        EXPECT_EQ(kernel_names(flat_scene(of.contents), settings_of(of)), of.kernels) << of.name;
}

TEST(Effects, FramesTraceRaysOfTheirComponentsAlone) {
    for (const Case& of : cases()) {
        SCOPED_TRACE(of.name);
        const Rendering rendering = test::render_flat(
            test::shared_executor(test::Backend::own_bvh), flat_scene(of.contents),
            test::look_at({0.1, 0.05, 0.9}, {0.0, 0.0, 0.0}, 1.2), settings_of(of));
        std::set<std::string> components;
        for (const StageStats& stage : rendering.stats[0].stages)
            if (stage.rays > 0 && !stage.component.empty()) components.insert(stage.component);
        const Contents& c = of.contents;
        const bool lit = c.lamp || c.point || c.sun || c.sky;
        EXPECT_EQ(components.count("direct"), of.direct && lit && !c.black ? 1U : 0U);
        EXPECT_EQ(components.count("indirect"), of.indirect && lit && !c.black ? 1U : 0U);
        EXPECT_LE(components.size(), 2U);
        test::expect_clean(rendering);
    }
}

TEST(Effects, NoBufferForWhatIsNotThere) {
    const auto bytes = [](const Contents& contents, bool direct, bool wants_indirect) {
        const auto executor = test::make_executor(test::Backend::own_bvh);
        const FlatScene flat = flat_scene(contents);
        RenderSettings how = settings();
        how.direct = direct;
        how.indirect = wants_indirect;
        const Renderer renderer(*executor, flat, test::look_at({0, 0, 0.9}, {0, 0, 0}, 1.0), how);
        return executor->allocated_bytes();
    };
    const Contents lamp{.lamp = true};
    const std::size_t both = bytes(lamp, true, true);
    const std::size_t direct = bytes(lamp, true, false);
    const std::size_t none = bytes(lamp, false, false);
    EXPECT_GT(both, direct);
    EXPECT_GT(direct, none);
    // Without lights or reflection it is as if the component had not been asked for.
    EXPECT_EQ(bytes({}, true, true), bytes({}, false, false));
    EXPECT_EQ(bytes({.lamp = true, .black = true}, true, true),
              bytes({.lamp = true, .black = true}, true, false));
}

}  // namespace
}  // namespace weft
