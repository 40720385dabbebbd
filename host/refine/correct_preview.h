// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_CORRECT_PREVIEW_H
#define WEFT_REFINE_CORRECT_PREVIEW_H

#include "image/image.h"
#include "refine/exact_halves.h"
#include "refine/surface_runs.h"

namespace weft {

/// The light of a preview, corrected by unbiased samples: the difference between the mean of the
/// samples and the preview is split by the size of details, and of each detail is added what is
/// known of it. Where the noise of the samples has the power N in the neighbourhood of a pixel and
/// the preview's error the power S, that is the share S / (S + N) (Wiener's filter). S + N is the
/// mean square of the difference, and S the mean product of the differences of the two halves,
/// whose noise is independent. So an error of the preview that is wider than a few pixels is
/// corrected by few samples, and with more and more of them the result becomes their mean.
///
/// Details and neighbourhoods end at the edges of surfaces, which `runs` has, so that an error on
/// one object does not reach another. S counts less what halves of so much noise agree on by
/// chance; where samples have no noise that is nothing. Single pixels that are far off are
/// corrected by themselves, see correct_isolated.
[[nodiscard]] ColourPlanes corrected(const ColourPlanes& preview, const ExactHalves& exact,
                                     const SurfaceRuns& runs);

/// Two means of disjoint unbiased samples of the same image, as resolve_sums makes them.
struct ExactMeans {
    const Image& first;
    const Image& second;
    double first_share;     ///< of these samples that `first` has, in (0, 1)
    std::uint64_t samples;  ///< these, of each pixel
    double share;           ///< of all samples of the image, the preview's included, that are these
};

/// Corrects the light and the alpha of a preview in place. Direct and indirect light are corrected
/// one by one. Emitted light and alpha of the preview err by nothing but where in the pixel its
/// samples lie, so that they become the mean of all samples. Beauty changes by the sum; of images
/// with light from media, mirrors, gloss or glass it is corrected as a whole, and layers of light
/// stay as they are, since paths count that light elsewhere. So do layers that are not light.
/// Values that would be negative become 0.
void correct_preview(Image& preview, const ExactMeans& exact);

}  // namespace weft

#endif
