// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/stats_json.h"

#include "device/native/embree_scene.h"

namespace weft {
namespace {

nlohmann::json stage_json(const StageStats& stage) {
    return {{"name", stage.name},
            {"component", stage.component},
            {"ms", stage.ms},
            {"rays", stage.rays}};
}

nlohmann::json frame_json(const FrameStats& frame) {
    nlohmann::json stages = nlohmann::json::array();
    for (const StageStats& stage : frame.stages) stages.push_back(stage_json(stage));
    nlohmann::json nonfinite;
    constexpr std::array names{"emission", "direct", "indirect"};
    for (std::size_t c = 0; c < names.size(); ++c) nonfinite[names[c]] = frame.nonfinite[c].count;
    return {{"ms", frame.ms}, {"rays", frame.rays}, {"stages", stages}, {"nonfinite", nonfinite}};
}

nlohmann::json scene_json(const FlatScene& scene, const Executor& executor) {
    nlohmann::json json{{"triangles", scene.triangles.size()},
                        {"instances", scene.instances.size()},
                        {"lights", scene.lights.size()},
                        {"mean_reflectance", scene.mean_reflectance}};
    if (const WideBvh* bvh = executor.bvh())
        json["bvh"] = {{"nodes", bvh->nodes.size()}, {"triangles", bvh->triangles.size()},
                       {"depth", bvh->depth},        {"spatial_splits", bvh->has_spatial_splits},
                       {"sah_cost", bvh->sah_cost},  {"build_ms", bvh->build_ms}};
    return json;
}

nlohmann::json plan_json(const FramePlan& plan) {
    return {{"sets", plan.sets},
            {"interleave", plan.interleave},
            {"vpls_per_set", plan.vpls_per_set},
            {"paths_per_set", plan.paths_per_set},
            {"bounces", plan.bounces},
            {"light_samples_per_set", plan.samples_per_set},
            {"environment_samples", plan.environment_samples},
            {"filter_radius", plan.filter_radius}};
}

}  // namespace

nlohmann::json device_json(const DeviceInfo& device) {
    return {{"index", device.index},
            {"name", device.name},
            {"backend", device.backend},
            {"driver", device.driver},
            {"version", device.version},
            {"memory", device.memory},
            {"native_width", device.native_width},
            {"compute_units", device.compute_units}};
}

nlohmann::json stats_json(const RenderOptions& options, const Executor& executor,
                          const Renderer& renderer, const FlatScene& scene,
                          const RenderSettings& settings, const RunTimes& times) {
    nlohmann::json kernels = nlohmann::json::array();
    for (const KernelBuild& build : executor.builds())
        kernels.push_back({{"name", build.name},
                           {"build_ms", build.build_ms},
                           {"flags", build.flags},
                           {"from_cache", build.from_cache}});
    nlohmann::json frames = nlohmann::json::array();
    for (const FrameStats& frame : renderer.stats()) frames.push_back(frame_json(frame));
    return {{"weft", WEFT_VERSION},
            {"versions", {{"embree", embree_version()}}},
            {"backend", executor.device().backend},
            {"device", device_json(executor.device())},
            {"lanes", executor.lanes()},
            {"seed", settings.seed},
            {"options", options_json(options)},
            {"size", {settings.width, settings.height}},
            {"samples", renderer.frames()},
            {"scene", scene_json(scene, executor)},
            {"plan", plan_json(renderer.plan())},
            {"kernels", kernels},
            {"times",
             {{"read_scene_ms", times.read_scene_ms},
              {"open_device_ms", times.open_device_ms},
              {"build_kernels_ms", times.build_kernels_ms},
              {"build_bvh_ms", times.build_bvh_ms},
              {"render_ms", times.render_ms},
              {"write_ms", times.write_ms},
              {"total_ms", times.total_ms}}},
            {"bytes", executor.allocated_bytes()},
            {"frames", frames}};
}

}  // namespace weft
