// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_ALGORITHM_H
#define WEFT_PLAN_ALGORITHM_H

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "plan/denoiser.h"
#include "plan/frame_plan.h"

namespace weft {

/// Where adaptive sampling takes indirect light from.
enum class IndirectSource : std::uint8_t { vpl, ic, tic, rays };

// Names on the command line and in files, in the order of the enumerations.
inline constexpr std::array<std::string_view, 9> algorithm_names = {
    "ais", "amax", "igi", "ir", "ic", "tic", "irradiance-cache", "path", "reference"};
// Long names that mean the same where users write one; programs print the short ones.
inline constexpr std::array<std::string_view, 9> long_algorithm_names = {
    "adaptive",           "adaptive-maximum", "instant-global-illumination",
    "instant-radiosity",  "instant-caching",  "temporal-instant-caching",
    "irradiance-caching", "path-tracing",     "reference"};
inline constexpr std::array<std::string_view, 4> source_names = {"vpl", "ic", "tic", "rays"};

[[nodiscard]] std::string_view to_string(Algorithm algorithm);
/// The short name of the algorithm that `name` is the long name of; any other text as it is.
[[nodiscard]] std::string_view short_algorithm_name(std::string_view name);
/// The same for each name of a list that is separated by commas.
[[nodiscard]] std::string short_algorithm_names(std::string_view list);
[[nodiscard]] std::string_view to_string(IndirectSource source);

/// Whether an algorithm makes unbiased samples, which exact sums hold.
[[nodiscard]] constexpr bool is_reference(Algorithm algorithm) {
    return algorithm == Algorithm::path || algorithm == Algorithm::reference;
}

/// Whether an algorithm can take indirect light from elsewhere than from virtual lights.
[[nodiscard]] constexpr bool has_indirect_source(Algorithm algorithm) {
    return algorithm == Algorithm::ais || algorithm == Algorithm::amax;
}

/// Whether indirect light comes from irradiance records.
[[nodiscard]] constexpr bool caches_indirect(Algorithm algorithm, IndirectSource source) {
    return algorithm == Algorithm::ic || algorithm == Algorithm::tic ||
           algorithm == Algorithm::irradiance_cache || source == IndirectSource::ic ||
           source == IndirectSource::tic;
}

/// Whether the residual, the light that virtual lights leave out, can be path traced
/// (SamplingSettings::compensation). Records hold the light of virtual lights alone, and path
/// tracing leaves nothing out.
[[nodiscard]] constexpr bool can_compensate(Algorithm algorithm, IndirectSource source) {
    return !is_reference(algorithm) && !caches_indirect(algorithm, source);
}

/// Whether images by an algorithm have what a denoiser takes: the statistical one takes the
/// variance of independent samples.
[[nodiscard]] constexpr bool can_denoise(Algorithm algorithm, Denoiser denoiser) {
    return denoiser != Denoiser::statistical || is_reference(algorithm);
}

/// Where settings take indirect light from.
[[nodiscard]] IndirectSource source_of(const SamplingSettings& sampling);

}  // namespace weft

#endif
