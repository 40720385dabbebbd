// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "denoise/image_denoiser.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "denoise/statistical_filter.h"

namespace weft {
namespace {

/// Puts other colours in the place of beauty, which becomes a layer after it and its alpha.
void replace_beauty(Image& image, std::vector<float> colours) {
    const auto beauty = std::find_if(image.layers.begin(), image.layers.end(),
                                     [](const Layer& layer) { return layer.name.empty(); });
    Layer noisy = *beauty;
    noisy.name = noisy_layer_name;
    noisy.channels.resize(3);
    noisy.values.resize(colours.size());
    std::copy(colours.begin(), colours.end(), beauty->values.begin());
    const auto after = std::find_if(beauty, image.layers.end(), [](const Layer& layer) {
        return !layer.name.empty() && layer.name != alpha_layer_name;
    });
    image.layers.insert(after, std::move(noisy));
}

}  // namespace

ImageDenoiser::ImageDenoiser(Denoiser denoiser) : denoiser_(denoiser) {
    if (denoiser == Denoiser::oidn) library_ = std::make_unique<const OpenImageDenoise>();
}

bool ImageDenoiser::denoise(Image& image, std::uint64_t samples, const DenoiseView& view) const {
    if (denoiser_ == Denoiser::none) return false;
    if (denoiser_ == Denoiser::statistical && samples < 2) return false;
    std::string name(to_string(denoiser_));
    if (library_) name += " " + library_->version();
    replace_beauty(image,
                   library_ ? library_->denoised(image) : statistical_filter(image, samples, view));
    image.metadata["denoiser"] = name;
    return true;
}

}  // namespace weft
