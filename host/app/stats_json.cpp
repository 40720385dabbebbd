// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/stats_json.h"

#include <sys/resource.h>

#include <algorithm>

#include "base/limits.h"
#include "device/native/embree_scene.h"
#include "plan/preset.h"

namespace weft {
namespace {

nlohmann::json stage_json(const StageStats& stage) {
    nlohmann::json json{{"name", stage_name(stage.stage)},
                        {"component", stage.component},
                        {"ms", stage.ms},
                        {"rays", stage.rays}};
    if (stage.misses > 0) json["misses"] = stage.misses;
    return json;
}

nlohmann::json frame_json(const FrameStats& frame, std::uint32_t first_frame) {
    nlohmann::json stages = nlohmann::json::array();
    for (const StageStats& stage : frame.stages) stages.push_back(stage_json(stage));
    nlohmann::json nonfinite;
    for (std::size_t c = 0; c < frame.nonfinite.size(); ++c)
        nonfinite[film_component_name(c)] = frame.nonfinite[c].count;
    nlohmann::json levels = nlohmann::json::object();
    for (const LevelStats& level : frame.levels)
        levels[level.component] = {
            {"tiles", level.tiles}, {"samples", level.samples}, {"gain", level.gain}};
    nlohmann::json json = {{"frame", first_frame + frame.image},
                           {"ms", frame.ms},
                           {"rays", frame.rays},
                           {"stages", stages},
                           {"levels", levels},
                           {"nonfinite", nonfinite}};
    if (const std::optional<CacheStats>& cache = frame.cache)
        json["records"] = {{"kept", cache->kept},       {"updated", cache->updated},
                           {"dropped", cache->dropped}, {"evicted", cache->evicted},
                           {"made", cache->made},       {"bytes", cache->bytes}};
    return json;
}

/// Bytes that the vertices, triangles and acceleration structure take on the device.
std::size_t geometry_bytes(const FlatScene& scene, const Executor& executor) {
    const auto bytes = [](const auto& values) { return std::as_bytes(std::span(values)).size(); };
    const BvhStats* bvh = executor.bvh();
    return bytes(scene.positions) + bytes(scene.triangles) + bytes(scene.normals) +
           bytes(scene.texture_coordinates) + bytes(scene.vertex_colours) +
           (bvh != nullptr ? bvh->bytes : 0);
}

/// Peak resident set size of the process so far, bytes.
std::size_t peak_memory() {
    rusage usage{};
    return getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::size_t>(usage.ru_maxrss) * 1024
                                               : 0;
}

nlohmann::json scene_json(const FlatScene& scene, const Executor& executor) {
    nlohmann::json json{{"triangles", scene.triangles.size()},
                        {"instances", scene.instances.size()},
                        {"lights", scene.lights.size()},
                        {"geometry_bytes", geometry_bytes(scene, executor)},
                        {"mean_reflectance", scene.mean_reflectance}};
    if (const BvhStats* bvh = executor.bvh())
        json["bvh"] = {{"nodes", bvh->nodes},       {"triangles", bvh->triangles},
                       {"depth", bvh->depth},       {"spatial_splits", bvh->has_spatial_splits},
                       {"bytes", bvh->bytes},       {"sah_cost", bvh->sah_cost},
                       {"build_ms", bvh->build_ms}, {"from_cache", bvh->from_cache}};
    return json;
}

/// The settings that took effect, as a preset.
Preset settings_of(const RenderSettings& settings, const RenderSession& session,
                   Denoiser denoiser) {
    const auto samples =
        std::clamp<std::uint64_t>(session.samples(), 1, limits::max_samples_per_pixel);
    return {settings.algorithm, settings.sampling, static_cast<std::uint32_t>(samples), denoiser,
            settings.refined_after};
}

nlohmann::json plan_json(const FramePlan& plan) {
    return {{"indirect", indirect_method(plan)},
            {"vpls_landed", plan.landed ? nlohmann::json(*plan.landed) : nlohmann::json()},
            {"sets", plan.sets},
            {"interleave", plan.interleave},
            {"vpls_per_set", plan.vpls_per_set},
            {"walked_per_set", plan.walked_per_set},
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

nlohmann::json stats_json(const RenderOptions& options, const RenderSession& session,
                          const RenderSettings& settings, const RunTimes& times) {
    const Executor& executor = session.executor();
    nlohmann::json kernels = nlohmann::json::array();
    for (const KernelBuild& build : executor.builds())
        kernels.push_back({{"name", build.name},
                           {"build_ms", build.build_ms},
                           {"flags", build.flags},
                           {"from_cache", build.from_cache}});
    const std::uint32_t first_frame = options.chosen_frames().value_or(FrameRange{}).first;
    nlohmann::json frames = nlohmann::json::array();
    for (const FrameStats& frame : session.stats().last_frames())
        frames.push_back(frame_json(frame, first_frame));
    nlohmann::json nonfinite = nlohmann::json::object();
    for (const NonfiniteSummary& found : session.stats().nonfinite())
        nonfinite[found.component] = {
            {"count", found.count},
            {"first_frame", first_frame + found.first_image},
            {"first_sample", found.first_sample},
            {"first_pixel",
             {found.first_pixel % settings.width, found.first_pixel / settings.width}}};
    nlohmann::json light = nlohmann::json::object();
    for (const LightShare& part : session.light()) light[part.component] = part.share;
    return {{"weft", WEFT_VERSION},
            {"versions", {{"embree", embree_version()}}},
            {"backend", executor.device().backend},
            {"device", device_json(executor.device())},
            {"lanes", executor.lanes()},
            {"seed", settings.seed},
            {"options", options_json(options)},
            {"size", {settings.width, settings.height}},
            {"samples", is_dark(session.light()) ? 0 : session.samples()},
            {"light", light},
            {"scene", scene_json(session.scene().flat(), executor)},
            {"settings", preset_json(settings_of(settings, session, options.denoiser))},
            {"plan", plan_json(session.plan())},
            {"kernels", kernels},
            {"times",
             {{"read_scene_ms", times.read_scene_ms},
              {"open_device_ms", times.open_device_ms},
              {"build_kernels_ms", times.build_kernels_ms},
              {"build_bvh_ms", times.build_bvh_ms},
              {"render_ms", times.render_ms},
              {"denoise_ms", times.denoise_ms},
              {"correct_ms", times.correct_ms},
              {"write_ms", times.write_ms},
              {"total_ms", times.total_ms}}},
            {"bytes", executor.allocated_bytes()},
            {"peak_memory", peak_memory()},
            {"nonfinite", nonfinite},
            {"frames", frames}};
}

}  // namespace weft
