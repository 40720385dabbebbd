// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/camera_vpls.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/stopwatch.h"
#include "pipeline/vpl_selection.h"
#include "plan/halton.h"
#include "scene/light_exponent.h"

namespace weft {
namespace {

/// Points that the camera sees, of each set: more in larger images, where gathering light takes
/// longer as well, and never more than tell VPLs apart well.
std::uint32_t points_per_set(std::uint32_t pixels) {
    constexpr std::uint32_t most = 64;
    constexpr std::uint32_t pixels_per_point = 512;
    return std::clamp(pixels / pixels_per_point / PACKET_BLOCK * PACKET_BLOCK, PACKET_BLOCK + 0U,
                      most);
}

// Keeps the random numbers of the selection apart from those of light paths.
constexpr std::uint32_t selection_seed = 0x3C6EF372U;

/// Pixels spread evenly over the image, other ones for every set of every sample.
std::vector<std::uint32_t> view_points(const shared::RenderParams& params, std::uint32_t points) {
    const std::uint32_t width = params.camera.width;
    const std::uint32_t height = params.camera.height;
    const std::uint32_t seed = params.sampling.seed ^ selection_seed;
    const std::uint32_t count = params.sampling.sets * points;
    std::vector<std::uint32_t> pixels;
    pixels.reserve(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const std::uint32_t index = params.sampling.sample * count + i;
        const auto place = [&](std::uint32_t base, std::uint32_t axis, std::uint32_t size) {
            const double share = shifted_halton(base, index, shift_of(seed, axis));
            return std::min(size - 1, static_cast<std::uint32_t>(share * size));
        };
        pixels.push_back(place(3, 1, height) * width + place(2, 0, width));
    }
    return pixels;
}

}  // namespace

CameraVpls::CameraVpls(Executor& executor, const FramePlan& plan, std::uint32_t pixels)
    : points_(points_per_set(pixels)),
      candidates_(allocate<kinds::VirtualLights>(
          executor, std::size_t{plan.sets} * plan.walked_per_set, "candidates for VPLs")),
      view_points_(allocate<kinds::SlotPixels>(executor, std::size_t{plan.sets} * points_,
                                               "points of view")),
      contributions_(allocate<kinds::VplContributions>(
          executor, std::size_t{plan.sets} * plan.walked_per_set * points_,
          "contributions of VPLs")) {}

void CameraVpls::select(FrameContext& frame, const char* component) {
    if (frame.ended_early()) return;
    const FramePlan& plan = frame.plan;
    const std::uint32_t walked = plan.walked_per_set;
    write_buffer(frame.executor, view_points_, view_points(frame.params, points_));
    frame.run_whole([&] {
        frame.run(Stage::vpl_contribution, component,
                  kernels::vpl_contribution{.scene = frame.scene_buffers.seen_by_light(),
                                            .surfaces = view(frame.buffers.gbuffer),
                                            .points = points_,
                                            .scale = std::ldexp(1.0F, -light_exponent(frame.scene)),
                                            .view_points = view_points_,
                                            .vpls = candidates_,
                                            .contributions = contributions_,
                                            .counters = frame.buffers.counters},
                  {plan.sets * walked});
    });
    // A cancelled frame may not have written them.
    if (frame.ended_early()) return;
    const auto vpls = read_buffer(frame.executor, candidates_, std::size_t{plan.sets} * walked);
    const auto contributions =
        read_buffer(frame.executor, contributions_, std::size_t{plan.sets} * walked * points_);
    const Stopwatch watch;
    std::vector<shared::Vpl> chosen;
    chosen.reserve(std::size_t{plan.sets} * plan.vpls_per_set);
    for (std::uint32_t set = 0; set < plan.sets; ++set) {
        const std::size_t first = std::size_t{set} * walked;
        const std::uint32_t seed = seed_of_sample(frame.params.sampling.seed ^ selection_seed,
                                                  frame.params.sampling.sample * plan.sets + set);
        const VplCandidates of_set{
            std::span(vpls).subspan(first, walked),
            std::span(contributions).subspan(first * points_, std::size_t{walked} * points_)};
        const auto of =
            select_vpls(of_set, plan.vpls_per_set, shift_of(seed, 0), shift_of(seed, 1));
        chosen.insert(chosen.end(), of.begin(), of.end());
    }
    frame.add_host_stage(Stage::vpl_selection, component, watch.total());
    write_buffer(frame.executor, frame.buffers.vpls, chosen);
}

}  // namespace weft
