// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/settings_sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "plan/algorithm.h"
#include "plan/quality.h"

namespace weft {
namespace {

class Sweep {
  public:
    Sweep(const SweepScene& scene, SweepSize size)
        : scene_(scene), full_(size == SweepSize::full) {}

    std::vector<Candidate> candidates;

    void add_all() {
        add_adaptive();
        add_interleaved();
        add_gathered();
        add_records();
        add_paths();
        for (const char* const variant : {"", "high"}) fill_budgets(variant, Algorithm::ais);
        for (const char* const variant : {"", "statistical", "oidn"})
            fill_budgets(variant, Algorithm::path);
        if (!full_) return;
        for (const char* const variant : {"draft", "compensation"})
            fill_budgets(variant, Algorithm::ais);
        fill_budgets("", Algorithm::igi);
    }

  private:
    [[nodiscard]] bool has_vpls() const { return scene_.indirect || scene_.media_light; }
    /// Whether anything is sampled at all: lights without area alone are exact.
    [[nodiscard]] bool samples_light() const { return has_vpls() || scene_.sampled_lights; }

    void add(const std::string& variant, Algorithm algorithm, const SamplingSettings& sampling,
             std::uint32_t samples = 1, Denoiser denoiser = Denoiser::none) {
        const Candidate plain{
            {}, std::string(to_string(algorithm)), {algorithm, sampling, 1, denoiser}, variant};
        const Candidate candidate = with_samples(plain, samples);
        if (known_.insert(preset_json(candidate.preset).dump()).second)
            candidates.push_back(candidate);
    }

    /// Lets the first candidate of this variant and algorithm, if there is one, fill budgets.
    void fill_budgets(const std::string& variant, Algorithm algorithm) {
        const auto found =
            std::find_if(candidates.begin(), candidates.end(), [&](const Candidate& candidate) {
                return candidate.variant == variant && candidate.preset.algorithm == algorithm;
            });
        if (found != candidates.end()) found->fills_budgets = true;
    }

    /// The settings of an image by the algorithm for which no others are given.
    [[nodiscard]] SamplingSettings standard(Algorithm algorithm) const {
        return algorithm == Algorithm::ais ? image(Quality::preview) : SamplingSettings{};
    }
    [[nodiscard]] SamplingSettings image(Quality quality) const {
        return scene_.indirect ? sampling_of_image(quality, scene_.media) : sampling_of(quality);
    }

    /// Variants of one number of a setting.
    template <class Value>
    void vary(const char* name, Algorithm algorithm, Value SamplingSettings::*member,
              std::initializer_list<Value> values) {
        for (const Value value : values) {
            SamplingSettings sampling = standard(algorithm);
            sampling.*member = value;
            add(fmt::format("{} {}", name, value), algorithm, sampling);
        }
    }

    void add_adaptive() {
        constexpr Algorithm ais = Algorithm::ais;
        add("", ais, standard(ais));
        if (samples_light()) {
            add("draft", ais, image(Quality::draft));
            add("high", ais, image(Quality::high));
            if (scene_.adapts) vary("threshold", ais, &SamplingSettings::threshold, {40.0});
        }
        for (const std::uint32_t samples : {4U, 16U}) add("", ais, standard(ais), samples);
        if (has_vpls()) vary("vpls", ais, &SamplingSettings::vpls_per_set, {16U});
        if (scene_.indirect) add_adaptive_records();
        add("", Algorithm::amax, {});
        if (!full_) return;
        add("", ais, standard(ais), 2);
        add("", ais, standard(ais), 8);
        add("", Algorithm::amax, {}, 4);
        vary("edges", ais, &SamplingSettings::edge_samples, {0U, 8U});
        if (samples_light()) add_more_adaptive();
    }

    void add_more_adaptive() {
        constexpr Algorithm ais = Algorithm::ais;
        if (scene_.adapts) vary("threshold", ais, &SamplingSettings::threshold, {3.0, 5.0, 20.0});
        if (has_vpls()) vary("vpls", ais, &SamplingSettings::vpls_per_set, {32U, 128U, 256U});
        if (scene_.sampled_lights)
            vary("light samples", ais, &SamplingSettings::samples_per_light, {2U, 16U});
        for (const std::uint32_t samples : {2U, 4U, 16U})
            add("draft", ais, image(Quality::draft), samples);
        for (const std::uint32_t samples : {4U, 16U})
            add("high", ais, image(Quality::high), samples);
        add("high", Algorithm::amax, sampling_of(Quality::high));
        SamplingSettings wide = standard(ais);
        wide.filter_radius = 2;
        add("filter 2", ais, wide);
        wide.interleave = 5;
        add("interleave 5 filter 2", ais, wide);
        if (scene_.media) return;  // neither the residual nor bounce rays support media
        SamplingSettings whole;
        whole.compensation = true;
        for (const std::uint32_t samples : {4U, 16U}) add("compensation", ais, whole, samples);
        if (!scene_.indirect) return;
        SamplingSettings rays;
        rays.bounce_rays = true;
        for (const std::uint32_t samples : {4U, 16U}) add("indirect rays", ais, rays, samples);
    }

    void add_adaptive_records() {
        SamplingSettings records;
        records.cached = true;
        add("indirect ic", Algorithm::ais, records);
        if (!full_) return;
        add("indirect ic", Algorithm::ais, records, 4);
        for (const double error : {0.05, 0.2}) {
            records.cache_error = error;
            add(fmt::format("indirect ic error {}", error), Algorithm::ais, records);
        }
    }

    void add_interleaved() {
        constexpr Algorithm igi = Algorithm::igi;
        add("", igi, {});
        if (!full_) return;
        if (has_vpls()) vary("vpls", igi, &SamplingSettings::vpls_per_set, {16U, 256U});
        if (samples_light()) vary("filter", igi, &SamplingSettings::filter_radius, {0U, 2U});
        for (const std::uint32_t samples : {4U, 16U}) add("", igi, {}, samples);
    }

    /// Adds settings in which every pixel gathers all sets.
    void add_gathered() {
        if (!full_ || !samples_light()) return;
        add("", Algorithm::ir, {});
        if (has_vpls()) vary("vpls", Algorithm::ir, &SamplingSettings::vpls_per_set, {16U});
    }

    void add_records() {
        if (!scene_.indirect) return;
        add("", Algorithm::ic, {});
        if (!full_) return;
        vary("error", Algorithm::ic, &SamplingSettings::cache_error, {0.05, 0.2});
        vary("vpls", Algorithm::ic, &SamplingSettings::vpls_per_set, {256U});
        add("", Algorithm::ic, {}, 4);
        if (scene_.media) return;  // hemispheres do not support media
        constexpr Algorithm hemispheres = Algorithm::irradiance_cache;
        add("", hemispheres, {});
        vary("rays", hemispheres, &SamplingSettings::cache_rays, {64U, 1024U});
        vary("error", hemispheres, &SamplingSettings::cache_error, {0.2});
    }

    void add_paths() {
        for (const std::uint32_t samples : {4U, 16U, 64U}) add("", Algorithm::path, {}, samples);
        add_denoised(Denoiser::statistical);
        if (scene_.oidn) add_denoised(Denoiser::oidn);
        if (!full_) return;
        for (const std::uint32_t samples : {1U, 256U}) add("", Algorithm::path, {}, samples);
    }

    void add_denoised(Denoiser denoiser) {
        const std::string variant(to_string(denoiser));
        add(variant, Algorithm::path, {}, 16, denoiser);
        if (full_) add(variant, Algorithm::path, {}, 64, denoiser);
    }

    SweepScene scene_;
    bool full_;
    std::set<std::string> known_;
};

}  // namespace

Candidate with_samples(const Candidate& candidate, std::uint32_t samples) {
    Candidate other = candidate;
    other.preset.samples = samples;
    other.name = candidate.family;
    if (!candidate.variant.empty()) other.name += " " + candidate.variant;
    if (samples > 1 || candidate.preset.algorithm == Algorithm::path)
        other.name += fmt::format(" spp {}", samples);
    return other;
}

SweepScene sweep_scene(const FramePlan& plan) {
    return {.indirect = plan.has_indirect(),
            .sampled_lights = plan.samples_per_set > 0 || plan.environment_samples > 0,
            .media = plan.media,
            .media_light = plan.media_light,
            .adapts = plan.undersamples() || plan.media_light};
}

std::vector<Candidate> settings_sweep(const SweepScene& scene, SweepSize size) {
    Sweep sweep(scene, size);
    sweep.add_all();
    return std::move(sweep.candidates);
}

}  // namespace weft
