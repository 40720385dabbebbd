// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_FRAME_PLAN_H
#define WEFT_PLAN_FRAME_PLAN_H

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

enum class Algorithm : std::uint8_t {
    ais,
    amax,
    igi,
    ir,
    ic,
    tic,
    irradiance_cache,
    path,
    reference
};

/// The algorithm that renders where none is named.
inline constexpr Algorithm default_algorithm = Algorithm::ais;

/// How densely light is sampled and how it is filtered. The defaults are the standard setting,
/// which `igi` and everything compared with it use.
struct SamplingSettings {
    std::uint32_t interleave = 3;     ///< n: n x n sample sets
    std::uint32_t vpls_per_set = 64;  ///< at most
    /// Of ais and amax: VPLs that light paths leave for each one that pixels gather, which are
    /// chosen by what they bring to what the camera sees; 1: pixels gather all.
    std::uint32_t candidates = 8;
    /// VPLs of indirect orders 1 to this, at most MAX_BOUNCES. Later ones cost next to nothing.
    std::uint32_t bounces = MAX_BOUNCES;
    std::uint32_t samples_per_light = 4;      ///< per set and area light; also environment rays
    std::uint32_t max_samples_per_set = 256;  ///< beyond it, lights are chosen by power
    double bound_spacing = 1.0;               ///< c: VPLs closer than c mean spacings are bounded
    /// Each VPL is bounded by the light of the VPLs about it, not all by the same; without residual
    /// and records that outlast their frame.
    bool local_bounds = true;
    bool vpl_tail = true;  ///< the last bounce brings what all later ones would, on the same terms
    std::uint32_t filter_radius = 1;  ///< discontinuity buffer, pixels
    double filter_cosine = 0.9;
    double filter_planes = 2.0;
    /// Of ais: largest error of undersampling, in just noticeable differences, that is accepted.
    double threshold = 10.0;
    /// Sample f of an image tolerates the threshold over f + 1: see AdaptiveSampling.
    bool threshold_falls = false;
    double luminance_scale = 100.0;  ///< cd/m^2 of radiance 1, for the same
    /// Of ais: number of area light samples of a set from which on each light is probed with one
    /// ray first. With fewer, finding the ends of shadows costs more time than the rays it saves.
    std::uint32_t min_probed_samples = 64;
    /// Of ais: share of its taps' weight that a pixel needs on its own surface; with less it is
    /// sampled more densely.
    double enough_support = 0.4;
    /// Of ais and ic: VPLs that would add less than this share of what a pixel's VPLs add on
    /// average are traced with Russian roulette.
    double roulette = 2.0;
    bool cached = false;  ///< indirect light from irradiance records, as always with ic
    /// Of ais and amax, without media: indirect light from a path through each pixel, not from
    /// VPLs.
    bool bounce_rays = false;
    /// Of ais: the same wherever too few light paths meet a surface.
    bool bounce_rays_if_open = false;
    bool temporal = false;  ///< records outlast their frame, as always with tic
    /// Of temporal: each record stores which VPLs it sees, so that only connections that something
    /// has moved through are traced again; otherwise all connections of such a record are.
    bool cache_masks = true;
    /// Of temporal: most records that are kept from one frame to the next.
    std::uint32_t cache_records = 1U << 18;
    /// Of temporal: after every change all records are computed anew, too, and compared
    /// (CacheStats).
    bool validate_cache = false;
    /// Of cached: relative error of irradiance at the mean distance that a record serves. Of
    /// irradiance_cache: that of Ward, with which a record serves places up to that share of the
    /// mean distance of what it sees.
    double cache_error = 0.1;
    /// Of irradiance_cache: most rays into the hemisphere above a record, 16 and up.
    std::uint32_t cache_rays = 256;
    bool compensation = false;  ///< path traces what bounds and bounces leave out
    /// Of compensation: paths bring what bounds leave out alone, and so go no further than that;
    /// the tail stands for later bounces. Not of reference.
    bool near_residual = false;
    /// Of reference: how many VPLs neighbouring receivers choose among those of all sets.
    std::uint32_t choices = 16;
    /// Of reference: how many VPLs the list of a region has, at most MAX_CHOICE_VPLS.
    std::uint32_t shortlist = 256;
    /// Further rays of an edge pixel, of ais and amax; rounded down to an even number, at most
    /// MAX_EDGE_SAMPLES.
    std::uint32_t edge_samples = 4;
};

/// What plan_frames needs to know of a scene.
struct SceneStatistics {
    std::uint32_t area_lights = 0;
    std::uint32_t punctual_lights = 0;
    std::uint32_t directional_lights = 0;
    bool environment = false;
    bool materials = false;         ///< some surface is more than diffuse
    bool reflection = false;        ///< some reflects as mirrors do
    bool refraction = false;        ///< something is seen through some surface
    bool glossy = false;            ///< some is glossy
    bool rough_glass = false;       ///< and some is seen through rough facets
    bool media = false;             ///< some medium attenuates light
    bool scattering = false;        ///< some medium scatters light
    bool direct = true;             ///< the user wants direct light
    bool media_light = true;        ///< the user wants light scattered by media to the camera
    bool indirect = true;           ///< the user wants indirect light
    double surface_area = 0.0;      ///< kernel units squared
    double mean_reflectance = 0.0;  ///< [0, 1]
};

/// Sample counts of every frame, decided once; a plain value.
struct FramePlan {
    std::uint32_t interleave = 1;   ///< of the work list
    std::uint32_t sets = 1;         ///< number of sample sets
    std::uint32_t gather_sets = 1;  ///< sets of which a pixel gathers one; 1: it gathers all
    std::uint32_t filter_radius = 0;

    std::uint32_t paths_per_set = 0;   ///< 0: no VPLs
    std::uint32_t walked_per_set = 0;  ///< VPLs that the light paths of a set leave
    std::uint32_t vpls_per_set = 0;    ///< that pixels gather: those, or the chosen among them
    /// VPLs that neighbouring receivers choose from the short list of their region; 0: they gather
    /// their set's.
    std::uint32_t choices = 0;
    std::uint32_t shortlist = 0;  ///< VPLs on a list, of those of all sets
    std::uint32_t bounces = 0;
    std::array<std::uint32_t, MAX_BOUNCES> survivors{};
    std::array<std::uint32_t, MAX_BOUNCES> first_vpl{};

    std::uint32_t samples_per_light = 0;   ///< 0: chosen by power
    std::uint32_t samples_per_set = 0;     ///< area light samples; 0: none
    std::uint32_t min_probed_samples = 0;  ///< as in SamplingSettings
    std::uint32_t environment_samples = 0;
    std::uint32_t punctual_lights = 0;
    std::uint32_t directional_lights = 0;

    bool direct = false;       ///< surfaces gather direct light
    bool indirect = false;     ///< surfaces gather indirect light
    bool cached = false;       ///< indirect light comes from irradiance records
    bool bounce_rays = false;  ///< indirect light comes from a path through each pixel
    /// Share of the VPLs of a sample that have landed on a surface, where it has been measured.
    std::optional<double> landed;
    bool materials = false;         ///< surfaces may be more than diffuse
    bool reflection = false;        ///< what mirrors show is gathered
    bool refraction = false;        ///< what is seen through surfaces is gathered
    bool glossy = false;            ///< what glossy surfaces reflect is gathered
    bool rough_glass = false;       ///< some is seen through rough facets
    bool temporal = false;          ///< records and VPLs outlast their frame
    bool media = false;             ///< light goes through participating media
    bool media_light = false;       ///< light that media scatter to the camera is gathered
    std::uint32_t media_steps = 1;  ///< places on a view ray for each light without area
    std::uint32_t media_samples_per_light = 0;  ///< as samples_per_light, for light in media
    std::uint32_t media_samples_per_set = 0;    ///< as samples_per_set, for light in media

    std::vector<std::string> requested;  ///< components that frames have only on request

    bool compensation = false;   ///< a path per pixel for what VPLs and light samples leave out
    bool near_residual = false;  ///< as in SamplingSettings

    /// Further rays of an edge pixel, even; 0: edges stay as primary rays find them.
    std::uint32_t edge_samples = 0;

    bool exact = false;  ///< samples are independent and go to exact sums

    bool adaptive = false;  ///< levels decide which pixels a component samples, where it can adapt
    double threshold = 0.0;
    bool threshold_falls = false;  ///< as in SamplingSettings
    double luminance_scale = 100.0;
    double roulette = 0.0;  ///< of VPLs; 0: all are traced
    double cache_error = 0.0;
    bool cache_masks = false;         ///< as in SamplingSettings
    bool validate_cache = false;      ///< as in SamplingSettings
    std::uint32_t cache_records = 0;  ///< as in SamplingSettings
    double cache_roulette = 0.0;      ///< as roulette, for records
    /// Cells of the hemisphere above a record, a ray each; 0: records gather VPLs instead.
    std::uint32_t cache_elevations = 0;
    std::uint32_t cache_azimuths = 0;

    double vpl_bound = 0.0;  ///< of frame 0, 1 / kernel units squared
    /// Of frame 0: 1 / c^2 of SamplingSettings::bound_spacing, where each VPL has a bound of its
    /// own; else 0.
    double local_bound_scale = 0.0;
    bool vpl_tail = false;           ///< as in SamplingSettings
    double light_bound_scale = 0.0;  ///< of frame 0; divided by a light's area it is the bound

    /// Number of samples on area lights, which come first in the light sample buffer.
    [[nodiscard]] std::uint32_t area_samples() const { return sets * samples_per_set; }
    [[nodiscard]] std::uint32_t light_sample_count() const {
        return area_samples() + punctual_lights + sets * environment_samples;
    }
    [[nodiscard]] bool requests(std::string_view component) const {
        return std::find(requested.begin(), requested.end(), component) != requested.end();
    }
    [[nodiscard]] bool has_vpls() const { return paths_per_set > 0; }
    /// Whether pixels gather some of the VPLs that light paths leave, chosen for the camera.
    [[nodiscard]] bool selects_vpls() const { return vpls_per_set < walked_per_set; }
    /// Whether indirect light comes from rays that irradiance records trace.
    [[nodiscard]] bool traces_hemispheres() const { return cache_azimuths > 0; }
    [[nodiscard]] bool has_indirect() const {
        return indirect && (has_vpls() || traces_hemispheres() || bounce_rays);
    }
    /// Whether pixels or records gather VPLs for indirect light.
    [[nodiscard]] bool gathers_vpls() const {
        return has_indirect() && !traces_hemispheres() && !bounce_rays;
    }
    [[nodiscard]] bool has_sampled_direct() const {
        return direct && (samples_per_set > 0 || environment_samples > 0);
    }
    /// Whether the probe may stand for all shadow rays to an area light: each light needs several
    /// samples. With more than most_lights lights the probes' results would take more memory than
    /// all else.
    [[nodiscard]] bool adapts_direct() const {
        constexpr std::uint32_t most_lights = 64;
        return direct && adaptive && threshold > 0.0 && samples_per_set > 0 &&
               samples_per_set >= min_probed_samples && samples_per_light > 1 &&
               samples_per_set / samples_per_light <= most_lights;
    }
    /// Whether any light may go without samples at some pixels.
    [[nodiscard]] bool undersamples() const {
        return adaptive && threshold > 0.0 && ((has_indirect() && !bounce_rays) || adapts_direct());
    }
    [[nodiscard]] bool has_exact_direct() const {
        return direct && (punctual_lights > 0 || directional_lights > 0);
    }
    [[nodiscard]] bool has_direct() const { return has_sampled_direct() || has_exact_direct(); }
    /// Whether rays of the camera are followed through mirrors and glass.
    [[nodiscard]] bool has_view_chains() const { return reflection || refraction || glossy; }
    [[nodiscard]] bool has_distant() const {
        return environment_samples > 0 || directional_lights > 0;
    }
};

/// Plans the frames of an algorithm. `ir` makes the same sample sets as `igi`, and every pixel
/// uses all of them.
[[nodiscard]] FramePlan plan_frames(Algorithm algorithm, const SamplingSettings& settings,
                                    const SceneStatistics& scene);

/// Where indirect light comes from: `vpl`, `rays`, `ic`, `tic`, `hemispheres` or `none`.
[[nodiscard]] std::string_view indirect_method(const FramePlan& plan);

/// Share of VPLs that have landed below which a path through each pixel finds indirect light better
/// than they do: so few would each stand for a large part of the scene, in bright spots.
inline constexpr double least_landed = 0.5;

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
