// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <vector>

#include "components/component.h"
#include "device/executor.h"
#include "render/path_renderer.h"
#include "tests/testing/counting_executor.h"
#include "tests/testing/gltf_builder.h"
#include "tests/testing/media_builder.h"
#include "tests/testing/render_fixture.h"
#include "tests/testing/surface_scenes.h"

// A frame does what its scene needs, and nothing else: for each scene the kernels that its plan
// builds, the stages that a frame runs, and the rays that components trace are written out here. A
// component that joins the program must not change any of these lists.
namespace weft::effects_test {
namespace {

using test::Rendering;
using test::SceneBuilder;

/// What a scene has.
struct Contents {
    bool area_light = false;  ///< an area light
    bool point = false;
    bool sun = false;
    bool sky = false;
    bool black = false;  ///< surfaces reflect nothing
    bool fog = false;    ///< all space is filled with a medium
    float fog_albedo = 0.5F;
};

FlatScene flat_scene(const Contents& contents) {
    SceneBuilder builder;
    builder.add(test::room_mesh(), builder.material(glm::vec3(contents.black ? 0.0F : 0.6F)));
    if (contents.area_light)
        builder.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F}),
                    builder.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    if (contents.point) builder.light(LightType::point, glm::dvec3(0.3, 0.2, 0.1), glm::vec3(1.0F));
    if (contents.sun)
        builder.light(LightType::directional, glm::dvec3(0.0, 1.0, 0.0), glm::vec3(1.0F));
    if (contents.sky) builder.scene.environment = Environment{glm::vec3(0.5F)};
    if (contents.fog) {
        builder.scene.media.push_back(
            test::medium_of(glm::vec3(0.5F), glm::vec3(contents.fog_albedo)));
        builder.scene.outer_medium = 0;
    }
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

const std::set<std::string> always{"gbuffer", "compose", "edge_masks", "edge_samples"};
const std::set<std::string> area{"receivers",    "light_samples", "shadow_probes",
                                 "shadow_edges", "soft_shadows",  "reconstruct"};
const std::set<std::string> punctual{"receivers", "light_samples", "vpl_gather"};
const std::set<std::string> indirect{
    "receivers",  "tile_geometry", "vpl_walk",   "vpl_tail",       "vpl_contribution",
    "vpl_bounds", "vpl_roulette",  "vpl_gather", "lattice_signal", "reconstruct_tiles"};
const std::set<std::string> sky{"receivers", "light_samples", "distant_light", "reconstruct"};
const std::set<std::string> sun{"receivers", "distant_light"};
const std::set<std::string> media{"view_media"};
const std::set<std::string> airlight{
    "receivers",  "view_media",       "media_gather",  "vpl_walk",       "vpl_tail",
    "vpl_bounds", "vpl_contribution", "tile_geometry", "lattice_signal", "reconstruct_tiles"};
const std::set<std::string> distant_airlight{"media_distant"};

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
    const Contents area_light{.area_light = true};
    const Contents point{.point = true};
    const Contents black_area_light{.area_light = true, .black = true};
    return {
        {"area light", area_light, true, true, joined({area, indirect})},
        {"area light, direct alone", area_light, true, false, joined({area})},
        {"area light, indirect alone", area_light, false, true, joined({indirect})},
        {"point light", point, true, true, joined({punctual, indirect})},
        {"point light, direct alone", point, true, false, joined({punctual})},
        {"sun", {.sun = true}, true, false, joined({sun})},
        {"sky", {.sky = true}, true, false, joined({sky})},
        {"nothing reflects", black_area_light, true, true, joined({area})},
        {"area light and point light",
         {.area_light = true, .point = true},
         true,
         true,
         joined({area, punctual, indirect})},
        {"no light", {}, true, true, joined({})},
        {"fog", {.area_light = true, .fog = true}, true, true, joined({area, indirect, airlight})},
        {"fog that absorbs",
         {.area_light = true, .fog = true, .fog_albedo = 0.0F},
         true,
         true,
         joined({area, indirect, media})},
        {"sun in fog, seen in the fog alone",
         {.sun = true, .fog = true},
         false,
         false,
         joined({airlight, distant_airlight})},
        {"fog without light", {.fog = true}, true, true, joined({media})}};
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
            test::shared_executor(test::TestBackend::own_bvh), flat_scene(of.contents),
            test::look_at({0.1, 0.05, 0.9}, {0.0, 0.0, 0.0}, 1.2), settings_of(of));
        std::set<std::string> components;
        for (const StageStats& stage : rendering.stats[0].stages)
            if (stage.rays > 0 && !stage.component.empty()) components.insert(stage.component);
        const Contents& c = of.contents;
        const bool lit = c.area_light || c.point || c.sun || c.sky;
        EXPECT_EQ(components.count("direct"), of.direct && lit && !c.black ? 1U : 0U);
        EXPECT_EQ(components.count("indirect"), of.indirect && lit && !c.black ? 1U : 0U);
        EXPECT_EQ(components.count("media"), c.fog && c.fog_albedo > 0.0F && lit ? 1U : 0U);
        EXPECT_LE(components.size(), 3U);
        test::expect_clean(rendering);
    }
}

TEST(Effects, NoBufferForWhatIsNotThere) {
    const auto bytes = [](const Contents& contents, bool direct, bool wants_indirect) {
        const auto executor = test::make_executor(test::TestBackend::own_bvh);
        const FlatScene flat = flat_scene(contents);
        RenderSettings how = settings();
        how.direct = direct;
        how.indirect = wants_indirect;
        const Renderer renderer(*executor, flat, test::look_at({0, 0, 0.9}, {0, 0, 0}, 1.0), how);
        return executor->allocated_bytes();
    };
    const Contents area_light{.area_light = true};
    const std::size_t both = bytes(area_light, true, true);
    const std::size_t direct = bytes(area_light, true, false);
    const std::size_t none = bytes(area_light, false, false);
    EXPECT_GT(both, direct);
    EXPECT_GT(direct, none);
    // Without lights or reflection it is as if the component had not been asked for.
    EXPECT_EQ(bytes({}, true, true), bytes({}, false, false));
    EXPECT_EQ(bytes({.area_light = true, .black = true}, true, true),
              bytes({.area_light = true, .black = true}, true, false));
}

/// All that two frames of a scene make a device do, and what comes of it.
struct Deeds {
    std::vector<std::string> kernels;
    std::vector<std::uint32_t> features;
    std::vector<test::CountingExecutor::Run> runs;
    std::vector<test::CountingExecutor::Allocation> allocations;
    std::size_t bytes = 0;
    Rendering rendering;
};

Deeds deeds_of(const FlatScene& flat, const RenderSettings& how) {
    test::CountingExecutor executor(test::make_executor(test::TestBackend::own_bvh));
    Renderer renderer(executor, flat, test::look_at({0.1, 0.05, 0.9}, {0.0, 0.0, 0.0}, 1.2), how);
    for (int frame = 0; frame < 2; ++frame) EXPECT_TRUE(renderer.render_frame({}));
    return {executor.kernels(),
            executor.features(),
            executor.runs(),
            executor.allocations(),
            executor.allocated_bytes(),
            {renderer.image(), renderer.stats(), renderer.plan()}};
}

std::vector<std::uint64_t> rays_of(const Rendering& rendering) {
    std::vector<std::uint64_t> rays;
    for (const FrameStats& frame : rendering.stats)
        for (const StageStats& stage : frame.stages) rays.push_back(stage.rays);
    return rays;
}

/// The components without those that have to be asked for: the program before they joined it.
std::vector<ComponentKind> components_by_default() {
    std::vector<ComponentKind> kinds;
    for (const ComponentKind& kind : components())
        if (kind.choice != Choice::on_request) kinds.push_back(kind);
    return kinds;
}

TEST(Effects, FramesRunTheKernelsThatWereBuilt) {
    for (const Case& of : cases()) {
        const Deeds deeds = deeds_of(flat_scene(of.contents), settings_of(of));
        std::set<std::string> run;
        for (const auto& [kernel, first, items] : deeds.runs) run.insert(kernel);
        EXPECT_EQ(std::set<std::string>(deeds.kernels.begin(), deeds.kernels.end()), of.kernels)
            << of.name;
        // Without any surface that reflects there is nothing to sample, and without anything in the
        // way of light nothing to look at again.
        run.insert("soft_shadows");
        if (of.kernels.count("soft_shadows") == 0) run.erase("soft_shadows");
        if (of.contents.black)
            EXPECT_TRUE(std::includes(of.kernels.begin(), of.kernels.end(), run.begin(), run.end()))
                << of.name;
        else
            EXPECT_EQ(run, of.kernels) << of.name;
    }
}

// A program with further components that nobody asks for does what one without them does: the same
// kernels and features, the same launches over the same work-items, the same buffers, the same
// rays, the same image.
TEST(Effects, AComponentThatIsNotAskedForChangesNothing) {
    const std::vector<ComponentKind> without = components_by_default();
    ASSERT_LT(without.size(), components().size());  // or nothing would be compared
    for (const Case& of : cases())
        for (const Algorithm algorithm : {Algorithm::ais, Algorithm::igi}) {
            SCOPED_TRACE(of.name);
            RenderSettings how = settings_of(of);
            how.algorithm = algorithm;
            how.sampling.compensation = true;
            const FlatScene flat = flat_scene(of.contents);
            const Deeds with = deeds_of(flat, how);
            how.components = without;
            const Deeds bare = deeds_of(flat, how);
            EXPECT_EQ(with.kernels, bare.kernels);
            EXPECT_EQ(with.features, bare.features);
            EXPECT_EQ(with.runs, bare.runs);
            EXPECT_EQ(with.allocations, bare.allocations);
            EXPECT_EQ(with.bytes, bare.bytes);
            EXPECT_EQ(rays_of(with.rendering), rays_of(bare.rendering));
            EXPECT_EQ(test::differing_values(with.rendering.image, bare.rendering.image), 0U);
        }
}

/// The image without the layers of components that have to be asked for.
Image without_requested(Image image) {
    std::erase_if(image.layers, [](const Layer& layer) {
        for (const std::string_view name : choosable_components(Choice::on_request))
            if (layer.name.starts_with(name)) return true;
        return false;
    });
    return image;
}

TEST(Effects, AComponentThatIsAskedForLeavesTheOthersAlone) {
    for (const Case& of : cases()) {
        SCOPED_TRACE(of.name);
        const FlatScene flat = flat_scene(of.contents);
        RenderSettings how = settings_of(of);
        const Deeds bare = deeds_of(flat, how);
        for (const std::string_view name : choosable_components(Choice::on_request)) {
            how.requested = {std::string(name)};
            const Deeds with = deeds_of(flat, how);
            // It does something, or this would compare nothing.
            EXPECT_GT(with.runs.size(), bare.runs.size());
            EXPECT_GT(with.bytes, bare.bytes);
            EXPECT_GT(with.rendering.image.layers.size(), bare.rendering.image.layers.size());
            EXPECT_EQ(test::differing_values(bare.rendering.image,
                                             without_requested(with.rendering.image)),
                      0U);
        }
    }
}

/// The same of path tracing.
Deeds path_deeds_of(const FlatScene& flat) {
    test::CountingExecutor executor(test::make_executor(test::TestBackend::own_bvh));
    PathSettings how;
    how.width = how.height = 8;
    how.samples = {0, 2};
    PathRenderer renderer(executor, flat, test::look_at({0.1, 0.05, 0.9}, {0.0, 0.0, 0.0}, 1.2),
                          how, {});
    while (renderer.render_frame({})) continue;
    return {executor.kernels(),
            executor.features(),
            executor.runs(),
            executor.allocations(),
            executor.allocated_bytes(),
            {renderer.image(), renderer.stats(), renderer.plan()}};
}

constexpr std::uint32_t material_features = FEATURE_MATERIALS | FEATURE_SEE_THROUGH;

TEST(Effects, PathsOfDiffuseScenesKnowNoMaterials) {
    for (const Case& of : cases()) {
        const Deeds deeds = path_deeds_of(flat_scene(of.contents));
        EXPECT_EQ(deeds.kernels, std::vector<std::string>{of.contents.fog ? "path_media" : "path"})
            << of.name;
        for (const std::uint32_t features : deeds.features)
            EXPECT_EQ(features & material_features, 0U) << of.name;
        for (const auto& [what, bytes] : deeds.allocations) {
            EXPECT_EQ(what.find("surface"), std::string::npos) << of.name << ": " << what;
            EXPECT_NE(what, "tables of albedos");
        }
    }
}

/// A square of a glTF material in the room with an area light.
FlatScene room_with(const nlohmann::json& material, MaterialDetail detail) {
    GltfBuilder builder = GltfBuilder::triangle();
    builder.json["materials"] = nlohmann::json::array({material});
    builder.primitive()["material"] = 0;
    const TemporaryFolder folder;
    Diagnostics diagnostics;
    Scene scene = read_gltf(folder.write("scene.gltf", builder.text()), diagnostics, detail);
    SceneBuilder room;
    room.scene = std::move(scene);
    room.add(test::room_mesh(), room.material(glm::vec3(0.6F)));
    room.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F}),
             room.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    validate_scene(room.scene);
    return flatten(room.scene);
}

void expect_same_deeds(const Deeds& a, const Deeds& b) {
    EXPECT_EQ(a.kernels, b.kernels);
    EXPECT_EQ(a.features, b.features);
    EXPECT_EQ(a.runs, b.runs);
    EXPECT_EQ(a.allocations, b.allocations);
    EXPECT_EQ(a.bytes, b.bytes);
    EXPECT_EQ(rays_of(a.rendering), rays_of(b.rendering));
    EXPECT_EQ(test::differing_values(a.rendering.image, b.rendering.image), 0U);
}

TEST(Effects, MaterialsThatAreReadAsDiffuseDoWhatDiffuseOnesDo) {
    const nlohmann::json colour = {0.8, 0.5, 0.2, 1.0};
    const nlohmann::json lambert = {
        {"pbrMetallicRoughness",
         {{"baseColorFactor", colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 1.0}}},
        {"extensions", {{"KHR_materials_specular", {{"specularFactor", 0.0}}}}}};
    const nlohmann::json metal = {
        {"pbrMetallicRoughness", {{"baseColorFactor", colour}, {"roughnessFactor", 0.1}}}};
    const nlohmann::json glass = {
        {"pbrMetallicRoughness", {{"baseColorFactor", colour}, {"metallicFactor", 0.0}}},
        {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}}}}};
    const FlatScene replaced = room_with(lambert, MaterialDetail::full);
    const Deeds path = path_deeds_of(replaced);
    const Deeds preview = deeds_of(replaced, settings());
    EXPECT_EQ(path.kernels, std::vector<std::string>{"path"});
    for (const nlohmann::json& material : {metal, glass}) {
        const FlatScene diffuse = room_with(material, MaterialDetail::diffuse);
        expect_same_deeds(path_deeds_of(diffuse), path);
        expect_same_deeds(deeds_of(diffuse, settings()), preview);
        // Read in full they call for more, or this would compare nothing.
        const Deeds full = path_deeds_of(room_with(material, MaterialDetail::full));
        EXPECT_EQ(full.kernels, std::vector<std::string>{"path_surfaces"});
        EXPECT_NE(full.features, path.features);
        EXPECT_GT(test::differing_values(full.rendering.image, path.rendering.image), 0U);
    }
}

/// A material of a square that the camera sees, and what previews do for it.
struct MaterialCase {
    const char* name;
    SurfaceDescription surface;
    unsigned ways;  ///< of view_chains.cl: 1 reflection, 2 refraction, 4 gloss
};

SurfaceDescription plastic(float roughness, float coat = 0.0F) {
    MetallicSurface surface;
    surface.base_colour.factor = glm::vec3(0.5F);
    surface.metallic.factor = 0.0F;
    surface.roughness.value.factor = roughness;
    surface.clearcoat.factor.factor = coat;
    surface.clearcoat.roughness.value.factor = 0.0F;
    return {surface, {}, {}};
}

std::vector<MaterialCase> material_cases() {
    SurfaceDescription mask = plastic(1.0F);
    mask.opacity.mode = OpacityMode::mask;
    mask.opacity.alpha.factor = 0.2F;
    const SurfaceDescription unlit{UnlitSurface{}, {}, {}};
    return {{"mirror", test::metal(0.0F), 1},
            {"glossy metal", test::metal(0.4F), 4},
            {"rough metal", test::metal(0.8F), 4},
            {"glass", test::glass(1.5), 3},
            {"glass that absorbs", test::absorbing_glass(1.5F, glm::vec3(0.5F), 1.0), 3},
            {"glossy plastic", plastic(0.1F), 4},
            {"glossy plastic with a coat", plastic(0.1F, 1.0F), 5},
            {"plastic that is less rough", plastic(0.6F), 4},
            {"rough plastic", plastic(0.9F), 0},
            {"rough plastic with a coat", plastic(0.9F, 1.0F), 1},
            {"half a sheet", test::sheet(0.5F), 2},
            {"what a mask leaves out", mask, 0},
            {"a colour without light", unlit, 0}};
}

FlatScene room_with(const SurfaceDescription& surface) {
    SceneBuilder room;
    room.add(test::room_mesh(), room.material(glm::vec3(0.6F)));
    room.add(test::quad_mesh({-0.2F, 0.9F, -0.2F}, {0.4F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.4F}),
             room.material(glm::vec3(0.0F), glm::vec3(5.0F)));
    room.add(test::quad_mesh({-0.4F, -0.4F, 0.0F}, {0.8F, 0.0F, 0.0F}, {0.0F, 0.8F, 0.0F}),
             test::add_surface(room, surface));
    validate_scene(room.scene);
    return flatten(room.scene);
}

// What mirrors, glass and gaps need is there exactly where a material calls for it: the kernels,
// the launches over the pixels and the buffers of one way for each of them.
TEST(Effects, PreviewsFollowRaysOnlyWhereMaterialsCallForIt) {
    const std::set<std::string> chains{"view_chains",   "chain_radiance", "vpl_gather",
                                       "tile_geometry", "lattice_signal", "reconstruct_tiles"};
    for (const MaterialCase& of : material_cases()) {
        SCOPED_TRACE(of.name);
        const auto ways = static_cast<std::size_t>(std::popcount(of.ways));
        std::set<std::string> kernels = joined({area, indirect});
        kernels.erase("gbuffer");
        kernels.insert("gbuffer_surfaces");
        if (ways > 0) kernels.insert(chains.begin(), chains.end());
        if ((of.ways & 4U) != 0) kernels.insert("filter_chains");
        const Deeds deeds = deeds_of(room_with(of.surface), settings());
        EXPECT_EQ(std::set<std::string>(deeds.kernels.begin(), deeds.kernels.end()), kernels);
        std::size_t followed = 0;
        std::set<std::string> run;
        for (const auto& [kernel, first, items] : deeds.runs) {
            run.insert(kernel);
            if (kernel == "view_chains") followed += items;
        }
        EXPECT_EQ(run, kernels);
        EXPECT_EQ(followed, 2 * ways * 48 * 32) << "two frames";
        const auto ends = std::ranges::count_if(deeds.allocations, [](const auto& allocation) {
            return allocation.first == "ends of view rays";
        });
        EXPECT_EQ(ends, static_cast<std::ptrdiff_t>(6 * ways));
        for (const std::uint32_t features : deeds.features) {
            EXPECT_EQ((features & FEATURE_REFLECTION) != 0, (of.ways & 1U) != 0);
            EXPECT_EQ((features & FEATURE_REFRACTION) != 0, (of.ways & 2U) != 0);
            EXPECT_EQ((features & FEATURE_GLOSSY) != 0, (of.ways & 4U) != 0);
        }
        test::expect_clean(deeds.rendering);
    }
}

}  // namespace
}  // namespace weft::effects_test
