// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_REFINE_CORRECT_PREVIEW_H
#define WEFT_REFINE_CORRECT_PREVIEW_H

#include <array>

#include "image/image.h"
#include "refine/starlet.h"

namespace weft {

/// The red, green and blue plane of some light of an image.
using ColourPlanes = std::array<Plane, 3>;

/// What unbiased samples say of the same light, in two independent halves.
struct ExactHalves {
    ColourPlanes first, second;
    float first_share = 0.5F;  ///< of the samples that the first half has, in (0, 1)
};

/// The light of a preview, corrected by unbiased samples: the difference between the mean of the
/// samples and the preview is split by the size of details, and of each detail is added what is
/// known of it. Where the noise of the samples has the power N in the neighbourhood of a pixel and
/// the preview's error the power S, that is the share S / (S + N) (Wiener's filter). S + N is the
/// mean square of the difference, and S the mean product of the differences of the two halves,
/// whose noise is independent. So an error of the preview that is wider than a few pixels is
/// corrected by few samples, and with more and more of them the result becomes their mean.
///
/// `standard_errors` is for noise with rare bright samples, of which the halves agree by chance: S
/// counts less so many of its standard errors. Where samples have no noise it changes nothing.
[[nodiscard]] ColourPlanes corrected(const ColourPlanes& preview, const ExactHalves& exact,
                                     float standard_errors = 0.0F);

/// Two means of disjoint unbiased samples of the same image, as resolve_sums makes them.
struct ExactMeans {
    const Image& first;
    const Image& second;
    double first_share;  ///< of these samples that `first` has, in (0, 1)
    double share;        ///< of all samples of the image, the preview's included, that are these
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
