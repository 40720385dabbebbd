// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_VPL_SELECTION_H
#define WEFT_PIPELINE_VPL_SELECTION_H

#include <cstdint>
#include <span>
#include <vector>

#include "shared/shared_types.h"

namespace weft {

/// The VPLs that the light paths of a set have left, and what is known of them.
struct VplCandidates {
    std::span<const shared::Vpl> vpls;
    /// By VPL, the luminance that it brings to each of some points that the camera sees; as many
    /// for each VPL, in any unit.
    std::span<const float> contributions;
};

/// Share of the probability of a choice that goes by flux alone, so that light where no point lies
/// is not lost.
inline constexpr double chosen_by_flux = 0.4;

/// Probability of each VPL, of which the sum is 1, or all 0 where no VPL has flux: in proportion to
/// the sum, over the points, of the share that it has in the light there (the importance of
/// Georgiev and Slusallek 2010, "Simple and robust iterative importance sampling of virtual point
/// lights"), of which `by_flux`, in [0, 1], goes by flux.
[[nodiscard]] std::vector<double> choice_probabilities(const VplCandidates& candidates,
                                                       double by_flux);

/// Chooses `count` of the VPLs without bias: each has its flux over the expected number of its
/// choices. The choices are systematic, at equal steps from the place `start` in [0, 1) of the
/// first on, along a curve that fills space, so that VPLs that stand for each other are neighbours
/// there. `turn`, in [0, 1), begins the random numbers of roulette (vpl_roulette.cl). VPLs that are
/// chosen more than once leave dark ones at the end.
[[nodiscard]] std::vector<shared::Vpl> select_vpls(const VplCandidates& candidates,
                                                   std::uint32_t count, double start, double turn);

}  // namespace weft

#endif
