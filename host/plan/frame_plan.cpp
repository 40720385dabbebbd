// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/frame_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

/// Paths that survive to bounce k + 1 under fractional absorption (Keller 1997): floor(N r^k), but
/// at least one, so that no order of light is lost.
std::uint32_t survivors(std::uint32_t paths, double reflectance, std::uint32_t bounce) {
    const double left = static_cast<double>(paths) * std::pow(reflectance, bounce);
    return std::max(1U, static_cast<std::uint32_t>(std::floor(left + 1e-9)));
}

std::uint32_t vpl_count(std::uint32_t paths, double reflectance, std::uint32_t bounces) {
    std::uint32_t count = 0;
    for (std::uint32_t k = 0; k < bounces; ++k) count += survivors(paths, reflectance, k);
    return count;
}

/// VPLs that light paths may leave in a set for `gathered` that are gathered.
std::uint32_t most_walked(std::uint32_t gathered, std::uint32_t candidates) {
    // What they bring to the camera's points is kept for every one of them.
    constexpr std::uint64_t most = 4096;
    const std::uint64_t wanted = std::uint64_t{gathered} * candidates;
    return std::max(gathered, static_cast<std::uint32_t>(std::min(most, wanted)));
}

/// `candidates` as in SamplingSettings.
void plan_vpls(FramePlan& plan, const SamplingSettings& settings, double reflectance,
               std::uint32_t candidates) {
    plan.bounces = std::min({settings.bounces, settings.vpls_per_set, std::uint32_t{MAX_BOUNCES}});
    if (plan.bounces == 0) return;
    // The lower limit keeps dark scenes from spending all VPLs on the first bounce, the upper one
    // keeps paths from never ending.
    const double r = std::clamp(reflectance, 0.05, 0.95);
    const std::uint32_t most = most_walked(settings.vpls_per_set, candidates);
    std::uint32_t paths = 1;
    while (vpl_count(paths + 1, r, plan.bounces) <= most) ++paths;
    plan.paths_per_set = paths;
    for (std::uint32_t k = 0; k < plan.bounces; ++k) {
        plan.survivors[k] = survivors(paths, r, k);
        plan.first_vpl[k] = plan.walked_per_set;
        plan.walked_per_set += plan.survivors[k];
    }
    plan.vpls_per_set = std::min(plan.walked_per_set, settings.vpls_per_set);
}

/// Plans the cells of hemispheres about as wide as they are high where the hemisphere is widest:
/// pi M azimuths for M elevations (Ward and Heckbert 1992).
void plan_hemisphere(FramePlan& plan, const SamplingSettings& settings,
                     const SceneStatistics& scene) {
    if (!scene.indirect || !(scene.mean_reflectance > 0.0)) return;
    const double elevations = std::round(std::sqrt(settings.cache_rays / std::numbers::pi));
    plan.cache_elevations = static_cast<std::uint32_t>(std::max(2.0, elevations));
    plan.cache_azimuths = std::max(4U, settings.cache_rays / plan.cache_elevations);
}

/// Plans how many points on area lights, and places on view rays for lights without area, light in
/// media has. Some view ray passes close to any point of a light, and the edges of shafts are only
/// as fine as places are close: so a light has up to four times as many as for surfaces, but all
/// lights of a kind together have about as many as there are VPLs.
void plan_media_samples(FramePlan& plan, const SamplingSettings& settings,
                        const SceneStatistics& scene) {
    const auto share_of = [&](std::uint32_t lights) {
        return std::clamp(settings.vpls_per_set / std::max(1U, lights), settings.samples_per_light,
                          4 * settings.samples_per_light);
    };
    // A pixel that gathers all sets has places of its own for each.
    plan.media_steps = share_of(scene.punctual_lights + scene.directional_lights) *
                       (plan.gather_sets == 1 ? plan.sets : 1);
    plan.media_samples_per_light = plan.samples_per_light;
    plan.media_samples_per_set = plan.samples_per_set;
    if (plan.samples_per_light == 0 || scene.area_lights == 0) return;
    plan.media_samples_per_light = share_of(scene.area_lights);
    plan.media_samples_per_set = scene.area_lights * plan.media_samples_per_light;
}

/// Points of a set on area lights that are chosen by power.
std::uint32_t points_by_power(const SamplingSettings& settings, std::uint32_t lights) {
    return lights == 0 ? 0U
                       : static_cast<std::uint32_t>(
                             std::min(std::uint64_t{lights} * settings.samples_per_light,
                                      std::uint64_t{settings.max_samples_per_set}));
}

}  // namespace

double vpl_bound(double area, double count, double spacing) {
    if (!(area > 0.0) || !(spacing > 0.0)) return 1e30;
    return std::min(1e30, std::numbers::pi * count / (spacing * spacing * area));
}

double bound_growth(std::uint32_t frame) {
    return std::sqrt(static_cast<double>(frame) + 1.0);
}

std::string_view indirect_method(const FramePlan& plan) {
    if (!plan.has_indirect()) return "none";
    if (plan.traces_hemispheres()) return "hemispheres";
    if (plan.bounce_rays) return "rays";
    if (!plan.cached) return "vpl";
    return plan.temporal ? "tic" : "ic";
}

FramePlan plan_frames(Algorithm algorithm, const SamplingSettings& settings,
                      const SceneStatistics& scene) {
    FramePlan plan;
    plan.sets = settings.interleave * settings.interleave;
    const bool interleaved = algorithm != Algorithm::ir;
    if (algorithm == Algorithm::ais || algorithm == Algorithm::amax)
        plan.edge_samples = std::min(settings.edge_samples, MAX_EDGE_SAMPLES) / 2 * 2;
    plan.threshold = settings.threshold;
    plan.threshold_falls = settings.threshold_falls;
    plan.luminance_scale = settings.luminance_scale;
    plan.interleave = interleaved ? settings.interleave : 1;
    plan.gather_sets = interleaved ? plan.sets : 1;
    plan.filter_radius = interleaved ? settings.filter_radius : 0;
    const std::uint32_t lights = scene.area_lights + scene.punctual_lights +
                                 scene.directional_lights + (scene.environment ? 1U : 0U);
    plan.media = scene.media;
    plan.media_light = scene.scattering && scene.media_light && lights > 0;
    plan.direct = scene.direct;
    plan.min_probed_samples = settings.min_probed_samples;
    plan.indirect = scene.indirect;
    plan.temporal = algorithm == Algorithm::tic || (settings.cached && settings.temporal);
    const bool hemispheres = algorithm == Algorithm::irradiance_cache;
    plan.cached = plan.temporal || algorithm == Algorithm::ic || hemispheres || settings.cached;
    // Caches of hemispheres have no VPLs for what mirrors show.
    plan.materials = scene.materials && !hemispheres && algorithm != Algorithm::reference;
    plan.reflection = plan.materials && scene.reflection;
    plan.refraction = plan.materials && scene.refraction;
    plan.glossy = plan.materials && scene.glossy;
    plan.rough_glass = plan.refraction && scene.rough_glass;
    plan.cache_masks = settings.cache_masks;
    plan.validate_cache = settings.validate_cache;
    plan.cache_records = settings.cache_records;
    plan.cache_error = settings.cache_error;
    if (scene.direct || plan.media_light) {
        // What is known in closed form is biased where something hides a part of it.
        const bool all_lights = algorithm != Algorithm::reference &&
                                std::uint64_t{scene.area_lights} * settings.samples_per_light <=
                                    settings.max_samples_per_set;
        plan.samples_per_light = all_lights ? settings.samples_per_light : 0;
        plan.samples_per_set = all_lights ? scene.area_lights * settings.samples_per_light
                                          : points_by_power(settings, scene.area_lights);
        if (plan.media_light) plan_media_samples(plan, settings, scene);
        plan.environment_samples = scene.environment ? settings.samples_per_light : 0;
        plan.punctual_lights = scene.punctual_lights;
        plan.directional_lights = scene.directional_lights;
    }
    // Paths may be scattered by media where no surface does.
    const bool scatters = scene.mean_reflectance > 0.0 || scene.scattering;
    plan.bounce_rays = settings.bounce_rays && !plan.cached && !scene.media &&
                       !plan.has_view_chains() && scene.indirect && lights > 0 && scatters &&
                       (algorithm == Algorithm::ais || algorithm == Algorithm::amax);
    if (((scene.indirect && !hemispheres) || plan.media_light) && lights > 0 && scatters &&
        !plan.bounce_rays)
        plan_vpls(plan, settings, scene.mean_reflectance,
                  (algorithm == Algorithm::ais || algorithm == Algorithm::amax) && !plan.cached
                      ? settings.candidates
                      : 1);
    if (algorithm == Algorithm::reference && plan.has_vpls()) {
        plan.choices = settings.choices;
        plan.shortlist = std::min(settings.shortlist, std::uint32_t{MAX_CHOICE_VPLS});
    }
    if (hemispheres && lights > 0) plan_hemisphere(plan, settings, scene);
    plan.exact = algorithm == Algorithm::reference;
    plan.adaptive = algorithm == Algorithm::ais;
    if (plan.adaptive && plan.threshold > 0.0) plan.roulette = std::max(0.0, settings.roulette);
    // No roulette for records that outlast their frame: its level depends on all VPLs, so that a
    // change of one VPL would change every connection.
    if (plan.cached && !plan.temporal) plan.cache_roulette = std::max(0.0, settings.roulette);
    plan.compensation = settings.compensation && (plan.has_indirect() || plan.samples_per_set > 0);
    plan.vpl_bound =
        vpl_bound(scene.surface_area, static_cast<double>(plan.sets) * plan.vpls_per_set,
                  settings.bound_spacing);
    // The residual knows one bound and, unless it is near, the bounces that there are; records that
    // outlast their frame see a VPL change only where its path does.
    const bool as_walked = plan.exact || plan.compensation || plan.temporal || !plan.has_vpls();
    plan.near_residual = plan.compensation && settings.near_residual && !plan.exact;
    plan.vpl_tail = settings.vpl_tail && (!as_walked || plan.near_residual) && plan.bounces > 1;
    if (settings.local_bounds && !as_walked && settings.bound_spacing > 0.0)
        plan.local_bound_scale = 1.0 / (settings.bound_spacing * settings.bound_spacing);
    const double light_samples =
        plan.samples_per_light > 0
            ? plan.samples_per_light
            : static_cast<double>(plan.samples_per_set) / std::max(1U, scene.area_lights);
    plan.light_bound_scale =
        vpl_bound(1.0, static_cast<double>(plan.sets) * light_samples, settings.bound_spacing);
    return plan;
}

}  // namespace weft
