// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_FRAME_PLAN_H
#define WEFT_PLAN_FRAME_PLAN_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

enum class Algorithm : std::uint8_t { ais, amax, igi, ir, ic, tic, irradiance_cache, path };

/// What renders where no algorithm is named.
inline constexpr Algorithm default_algorithm = Algorithm::ais;

/// The standard setting, which `igi` and everything compared with it use.
struct SamplingSettings {
    std::uint32_t interleave = 3;     ///< n: n x n sample sets
    std::uint32_t vpls_per_set = 64;  ///< at most
    std::uint32_t bounces = 4;        ///< VPLs of indirect orders 1 to this, at most MAX_BOUNCES
    std::uint32_t samples_per_light = 4;      ///< per set and area light; also environment rays
    std::uint32_t max_samples_per_set = 256;  ///< beyond it, lights are chosen by power
    double bound_spacing = 2.0;               ///< c: VPLs closer than c mean spacings are bounded
    std::uint32_t filter_radius = 1;          ///< discontinuity buffer, pixels
    double filter_cosine = 0.9;
    double filter_planes = 2.0;
    /// Of ais: errors of undersampling, in just noticeable differences, that are let pass.
    double threshold = 10.0;
    double luminance_scale = 100.0;  ///< cd/m^2 of radiance 1, for the same
    /// Of ais: samples of a set from which on each area light is looked at with one ray before any
    /// others. With fewer, finding the ends of shadows costs more time than the rays it saves.
    std::uint32_t first_look_samples = 64;
    /// Of ais: share of its taps' weight that a pixel needs on its own surface, else it is sampled
    /// more densely.
    double enough_support = 0.4;
    /// Of ais and ic: VPLs that would add less than this share of what a pixel's VPLs add on
    /// average are traced by chance, and then count for more.
    double roulette = 2.0;
    bool cached = false;    ///< indirect light from irradiance records, as ic always has it
    bool temporal = false;  ///< which outlast their frame, as those of tic always do
    /// Of those: each keeps which VPLs it sees, so that only connections that something has moved
    /// through are traced again; else all of a record's.
    bool cache_masks = true;
    /// Of those: most records that are kept from one frame to the next.
    std::uint32_t cache_records = 1U << 18;
    /// Of those: after every change all are computed anew as well, and compared (CacheStats).
    bool cache_audit = false;
    /// Of those: relative error of irradiance at the mean distance that a record serves. Of
    /// irradiance_cache Ward's, by which a record serves places up to that share of the mean
    /// distance of what it sees.
    double cache_error = 0.1;
    /// Of irradiance_cache: most rays into the hemisphere above a record, 16 and up.
    std::uint32_t cache_rays = 256;
    bool compensation = false;  ///< trace what bounds and bounces leave out
    /// Further rays of an edge pixel, of ais and amax; rounded down to an even number, at most
    /// MAX_EDGE_SAMPLES.
    std::uint32_t edge_samples = 4;
};

/// What the scheduler needs to know of a scene.
struct SceneStatistics {
    std::uint32_t area_lights = 0;
    std::uint32_t punctual_lights = 0;
    std::uint32_t directional_lights = 0;
    bool environment = false;
    bool media = false;             ///< some medium takes from light
    bool scattering = false;        ///< and scatters some of it
    bool direct = true;             ///< the user wants direct light
    bool media_light = true;        ///< the user wants light scattered by media to the camera
    bool indirect = true;           ///< the user wants indirect light
    double surface_area = 0.0;      ///< kernel units squared
    double mean_reflectance = 0.0;  ///< [0, 1]
};

/// Sample counts of every frame, decided once; a plain value.
struct FramePlan {
    std::uint32_t interleave = 1;   ///< of the work list
    std::uint32_t sets = 1;         ///< sample sets made
    std::uint32_t gather_sets = 1;  ///< sample sets a pixel chooses from: 1 means all at once
    std::uint32_t filter_radius = 0;

    std::uint32_t paths_per_set = 0;  ///< 0: no VPLs
    std::uint32_t vpls_per_set = 0;
    std::uint32_t bounces = 0;
    std::array<std::uint32_t, MAX_BOUNCES> survivors{};
    std::array<std::uint32_t, MAX_BOUNCES> first_vpl{};

    std::uint32_t samples_per_light = 0;   ///< 0: chosen by power
    std::uint32_t samples_per_set = 0;     ///< area light samples; 0: none
    std::uint32_t first_look_samples = 0;  ///< as the settings have it
    std::uint32_t environment_samples = 0;
    std::uint32_t punctual_lights = 0;
    std::uint32_t directional_lights = 0;

    bool direct = false;            ///< surfaces gather the light of lights
    bool indirect = false;          ///< and that of other surfaces
    bool cached = false;            ///< that through irradiance records
    bool temporal = false;          ///< which outlast their frame, and so do VPLs
    bool media = false;             ///< light goes through participating media
    bool media_light = false;       ///< what they scatter to the camera is gathered, too
    std::uint32_t media_steps = 1;  ///< places on a view ray for each light without area
    std::uint32_t media_samples_per_light = 0;  ///< as samples_per_light, of light in media
    std::uint32_t media_samples_per_set = 0;    ///< as samples_per_set

    std::vector<std::string> requested;  ///< components that frames have only where asked for

    bool compensation = false;  ///< a path per pixel for what VPLs and light samples leave out

    /// Further rays of an edge pixel, even; 0: edges stay as primary rays find them.
    std::uint32_t edge_samples = 0;

    bool adaptive = false;  ///< levels decide which pixels a component samples, where it can adapt
    double threshold = 0.0;
    double luminance_scale = 100.0;
    double roulette = 0.0;  ///< of VPLs; 0: all are traced
    double cache_error = 0.0;
    bool cache_masks = false;         ///< as the settings have them
    bool cache_audit = false;         ///< likewise
    std::uint32_t cache_records = 0;  ///< likewise
    double cache_roulette = 0.0;      ///< as roulette, of records
    /// Cells of the hemisphere above a record, a ray each; 0: records gather VPLs instead.
    std::uint32_t cache_elevations = 0;
    std::uint32_t cache_azimuths = 0;

    double vpl_bound = 0.0;          ///< of frame 0, 1 / kernel units squared
    double light_bound_scale = 0.0;  ///< of frame 0; over the light's area it is the bound

    /// Lengths of the stretches of the light sample buffer.
    [[nodiscard]] std::uint32_t area_samples() const { return sets * samples_per_set; }
    [[nodiscard]] std::uint32_t light_sample_count() const {
        return area_samples() + punctual_lights + sets * environment_samples;
    }
    [[nodiscard]] bool requests(std::string_view component) const {
        return std::find(requested.begin(), requested.end(), component) != requested.end();
    }
    [[nodiscard]] bool has_vpls() const { return paths_per_set > 0; }
    /// Whether indirect light is what rays from irradiance records find.
    [[nodiscard]] bool traces_hemispheres() const { return cache_azimuths > 0; }
    [[nodiscard]] bool has_indirect() const {
        return indirect && (has_vpls() || traces_hemispheres());
    }
    /// Whether surfaces gather VPLs for it, by pixels or by records.
    [[nodiscard]] bool gathers_vpls() const { return has_indirect() && !traces_hemispheres(); }
    [[nodiscard]] bool has_sampled_direct() const {
        return direct && (samples_per_set > 0 || environment_samples > 0);
    }
    /// One ray to a light can stand for others where there are any. What pixels saw of more lights
    /// than that would take more memory than all else.
    [[nodiscard]] bool adapts_direct() const {
        constexpr std::uint32_t most_lights = 64;
        return direct && adaptive && threshold > 0.0 && samples_per_set > 0 &&
               samples_per_set >= first_look_samples && samples_per_light > 1 &&
               samples_per_set / samples_per_light <= most_lights;
    }
    /// Whether any light may go without samples at some pixels.
    [[nodiscard]] bool undersamples() const {
        return adaptive && threshold > 0.0 && (has_indirect() || adapts_direct());
    }
    [[nodiscard]] bool has_exact_direct() const {
        return direct && (punctual_lights > 0 || directional_lights > 0);
    }
    [[nodiscard]] bool has_direct() const { return has_sampled_direct() || has_exact_direct(); }
    [[nodiscard]] bool has_distant() const {
        return environment_samples > 0 || directional_lights > 0;
    }
};

/// Plans the frames of an algorithm. `ir` makes the same sample sets as `igi`, and every pixel
/// uses all of them.
[[nodiscard]] FramePlan plan_frames(Algorithm algorithm, const SamplingSettings& settings,
                                    const SceneStatistics& scene);

/// Bound on the geometry term G of VPLs that stand for `area` together with `count` - 1 others
/// (Kollig and Keller 2004): 1/d^2 at the distance d of `spacing` times the mean distance between
/// such points, sqrt(area / (pi count)). Scale-free; grows with the count, so that what it cuts off
/// vanishes as frames accumulate.
[[nodiscard]] double vpl_bound(double area, double count, double spacing);

/// Factor on every bound in frame `frame` of a progressive rendering: sqrt(frame + 1), slower than
/// the variance falls.
[[nodiscard]] double bound_growth(std::uint32_t frame);

}  // namespace weft

#endif
