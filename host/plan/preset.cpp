// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/preset.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>

#include "base/json_file.h"
#include "base/limits.h"
#include "base/quote.h"
#include "plan/algorithm.h"

namespace weft {
namespace {

using Json = nlohmann::json;

constexpr std::size_t max_preset_bytes = std::size_t{1} << 20;
// Beyond these, buffers of samples would grow to gigabytes.
constexpr std::uint32_t max_interleave = 15;
constexpr std::uint32_t max_vpls_per_set = 1U << 16;
constexpr std::uint32_t max_candidates = 64;
constexpr std::uint32_t max_light_samples = 1U << 14;
constexpr std::uint64_t max_samples_of_sets = std::uint64_t{1} << 20;
constexpr std::uint32_t max_filter_radius = 16;
constexpr double max_threshold = 1e6;
constexpr double max_luminance_scale = 1e6;
constexpr double max_roulette = 1e3;
constexpr double max_bound_spacing = 1e3;
constexpr double max_filter_planes = 1e6;

struct WholeSetting {
    const char* key;
    std::uint32_t SamplingSettings::*member;
    std::uint32_t least, most;
};

constexpr WholeSetting whole_settings[] = {
    {"interleave", &SamplingSettings::interleave, 1, max_interleave},
    {"vpls", &SamplingSettings::vpls_per_set, 1, max_vpls_per_set},
    {"candidates", &SamplingSettings::candidates, 1, max_candidates},
    {"bounces", &SamplingSettings::bounces, 1, MAX_BOUNCES},
    {"light_samples", &SamplingSettings::samples_per_light, 1, max_light_samples},
    {"max_light_samples", &SamplingSettings::max_samples_per_set, 1, max_light_samples},
    {"filter_radius", &SamplingSettings::filter_radius, 0, max_filter_radius},
    {"edge_samples", &SamplingSettings::edge_samples, 0, MAX_EDGE_SAMPLES},
    {"cache_records", &SamplingSettings::cache_records, 1, limits::max_cache_records},
    {"cache_rays", &SamplingSettings::cache_rays, limits::min_cache_rays, limits::max_cache_rays},
};

struct RealSetting {
    const char* key;
    double SamplingSettings::*member;
    double least, most;
};

constexpr RealSetting real_settings[] = {
    {"bound_spacing", &SamplingSettings::bound_spacing, 0.0, max_bound_spacing},
    {"filter_cosine", &SamplingSettings::filter_cosine, 0.0, 1.0},
    {"filter_planes", &SamplingSettings::filter_planes, 0.0, max_filter_planes},
    {"threshold", &SamplingSettings::threshold, 0.0, max_threshold},
    {"luminance_scale", &SamplingSettings::luminance_scale, 1.0 / max_luminance_scale,
     max_luminance_scale},
    {"support", &SamplingSettings::enough_support, 0.0, 1.0},
    {"roulette", &SamplingSettings::roulette, 0.0, max_roulette},
    {"cache_error", &SamplingSettings::cache_error, 0.0, 1.0},
};

std::uint32_t whole(const JsonValue& value, std::uint32_t least, std::uint32_t most) {
    const std::uint64_t number = value.as_integer();
    if (number < least || number > most)
        throw value.error(
            fmt::format("is {}, expected a whole number from {} to {}", number, least, most));
    return static_cast<std::uint32_t>(number);
}

double real(const JsonValue& value, double least, double most) {
    const double number = value.as_number();
    if (!(number >= least && number <= most))
        throw value.error(
            fmt::format("is {}, expected a number from {} to {}", number, least, most));
    return number;
}

/// The index in `names`, those of algorithms, of sources of indirect light or of denoisers, of a
/// name or of the long name that means the same.
std::size_t name_of(const JsonValue& value, std::span<const std::string_view> names) {
    const std::string& text = value.as_string();
    const auto found = std::find(names.begin(), names.end(), short_algorithm_name(text));
    if (found == names.end()) {
        std::string list;
        for (const std::string_view name : names)
            list += (list.empty() ? "'" : ", '") + std::string(name) + "'";
        throw value.error("is " + quote(text) + ", expected one of " + list);
    }
    return static_cast<std::size_t>(found - names.begin());
}

void read_denoiser(const JsonValue& value, Preset& preset) {
    const auto member = value.find("denoise");
    if (!member) return;
    preset.denoiser = static_cast<Denoiser>(name_of(*member, denoiser_names));
    if (!can_denoise(preset.algorithm, preset.denoiser))
        throw member->error(
            "needs the variance of every pixel, expected the algorithm path or reference");
}

void read_refinement(const JsonValue& value, Preset& preset) {
    const auto member = value.find("refined_after");
    if (!member) return;
    preset.refined_after = whole(*member, 0, limits::max_samples_per_pixel);
    if (preset.refined_after > 0 && preset.algorithm != Algorithm::ais)
        throw member->error("is for adaptive sampling, expected the algorithm ais, or 0");
}

void check_version(const JsonValue& value) {
    constexpr std::uint64_t version = 1;
    const JsonValue member = value.at("weft_preset");
    if (member.as_integer() != version)
        throw member.error(fmt::format("is version {}, expected {}", member.as_integer(), version));
}

void read_source(const JsonValue& value, Preset& preset) {
    if (const auto member = value.find("algorithm"))
        preset.algorithm = static_cast<Algorithm>(name_of(*member, algorithm_names));
    const auto member = value.find("indirect");
    if (!member) return;
    const auto source = static_cast<IndirectSource>(name_of(*member, source_names));
    if (source != IndirectSource::vpl && !has_indirect_source(preset.algorithm))
        throw member->error("is for adaptive sampling, expected the algorithm ais or amax");
    preset.sampling.cached = source == IndirectSource::ic || source == IndirectSource::tic;
    preset.sampling.bounce_rays = source == IndirectSource::rays;
    preset.sampling.temporal = source == IndirectSource::tic;
}

/// Checks the conditions that concern several settings.
void check_together(const JsonValue& value, const Preset& preset) {
    const SamplingSettings& sampling = preset.sampling;
    // Undersampling visits every second or fourth pixel, which with an even number never meets
    // some of the sets.
    if (sampling.interleave % 2 == 0)
        throw value.at("interleave")
            .error(fmt::format("is {}, expected an odd number", sampling.interleave));
    const std::uint64_t sets = std::uint64_t{sampling.interleave} * sampling.interleave;
    if (sets * sampling.vpls_per_set > max_samples_of_sets ||
        sets * sampling.max_samples_per_set > max_samples_of_sets)
        throw value.error(
            fmt::format("asks for more than {} virtual lights or points on lights in "
                        "all {} sample sets, expected fewer",
                        max_samples_of_sets, sets));
    if (sampling.compensation && !can_compensate(preset.algorithm, source_of(sampling)))
        throw value.at("compensation")
            .error("is true, expected false with path tracing and with irradiance records");
}

}  // namespace

Json preset_json(const Preset& preset) {
    Json json{{"weft_preset", 1},
              {"algorithm", to_string(preset.algorithm)},
              {"spp", preset.samples},
              {"denoise", to_string(preset.denoiser)},
              {"cache_masks", preset.sampling.cache_masks},
              {"compensation", preset.sampling.compensation},
              {"near_residual", preset.sampling.near_residual},
              {"threshold_falls", preset.sampling.threshold_falls},
              {"local_bounds", preset.sampling.local_bounds},
              {"vpl_tail", preset.sampling.vpl_tail}};
    if (has_indirect_source(preset.algorithm))
        json["indirect"] = to_string(source_of(preset.sampling));
    if (preset.algorithm == Algorithm::ais) json["refined_after"] = preset.refined_after;
    for (const WholeSetting& setting : whole_settings)
        json[setting.key] = preset.sampling.*setting.member;
    for (const RealSetting& setting : real_settings)
        json[setting.key] = preset.sampling.*setting.member;
    return json;
}

Preset read_preset(const std::filesystem::path& file) {
    const Json json = read_json_file(file, max_preset_bytes);
    const JsonValue value(json, file.string() + "#");
    check_version(value);
    check_keys(value, json,
               {"weft_preset",   "algorithm",      "indirect",          "spp",
                "interleave",    "vpls",           "bounces",           "light_samples",
                "bound_spacing", "filter_radius",  "max_light_samples", "filter_cosine",
                "filter_planes", "threshold",      "luminance_scale",   "support",
                "roulette",      "cache_masks",    "cache_records",     "cache_error",
                "cache_rays",    "compensation",   "edge_samples",      "denoise",
                "local_bounds",  "vpl_tail",       "refined_after",     "candidates",
                "near_residual", "threshold_falls"});
    Preset preset;
    read_source(value, preset);
    if (const auto member = value.find("spp"))
        preset.samples = whole(*member, 1, limits::max_samples_per_pixel);
    for (const WholeSetting& setting : whole_settings)
        if (const auto member = value.find(setting.key))
            preset.sampling.*setting.member = whole(*member, setting.least, setting.most);
    for (const RealSetting& setting : real_settings)
        if (const auto member = value.find(setting.key))
            preset.sampling.*setting.member = real(*member, setting.least, setting.most);
    preset.sampling.cache_masks = value.bool_or("cache_masks", preset.sampling.cache_masks);
    preset.sampling.compensation = value.bool_or("compensation", preset.sampling.compensation);
    preset.sampling.threshold_falls =
        value.bool_or("threshold_falls", preset.sampling.threshold_falls);
    preset.sampling.near_residual = value.bool_or("near_residual", preset.sampling.near_residual);
    preset.sampling.local_bounds = value.bool_or("local_bounds", preset.sampling.local_bounds);
    preset.sampling.vpl_tail = value.bool_or("vpl_tail", preset.sampling.vpl_tail);
    read_denoiser(value, preset);
    read_refinement(value, preset);
    check_together(value, preset);
    return preset;
}

}  // namespace weft
