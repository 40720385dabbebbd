// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/refinement.h"

#include <algorithm>
#include <utility>

#include "base/limits.h"
#include "refine/correct_preview.h"

namespace weft {
namespace {

/// The light and the alpha of an image.
Image light_of(Image image) {
    std::erase_if(image.layers, [](const Layer& layer) {
        return layer.half || layer.name == "depth" || layer.name == "variance";
    });
    return image;
}

/// The mean of the samples that are in `whole` and not in `part`.
Image rest_of(const Image& whole, std::uint64_t samples, const Image& part,
              std::uint64_t part_samples) {
    const auto left = static_cast<double>(samples - part_samples);
    const double of_whole = static_cast<double>(samples) / left;
    const double of_part = static_cast<double>(part_samples) / left;
    Image rest = whole;
    for (Layer& layer : rest.layers) {
        const Layer* const taken = part.find(layer.name);
        for (std::size_t i = 0; i < layer.values.size(); ++i)
            layer.values[i] = static_cast<float>(of_whole * static_cast<double>(layer.values[i]) -
                                                 of_part * static_cast<double>(taken->values[i]));
    }
    return rest;
}

}  // namespace

PathSettings exact_settings(const RenderSettings& preview) {
    PathSettings settings;
    settings.algorithm = Algorithm::reference;
    settings.width = preview.width;
    settings.height = preview.height;
    settings.seed = preview.seed;
    settings.samples = {0, limits::max_samples_per_pixel};
    settings.hides_environment = preview.hides_environment;
    settings.direct = preview.direct;
    settings.indirect = preview.indirect;
    return settings;
}

Refinement::Refinement(Executor& executor, const FlatScene& scene,
                       std::shared_ptr<SceneBuffers> uploaded, const Camera& camera,
                       const RenderSettings& settings)
    : exact_(make_exact_renderer(executor, scene, std::move(uploaded), camera,
                                 exact_settings(settings), {})) {}

std::uint64_t Refinement::next_part() const {
    return last_.samples == 0 ? 1 : 2 * last_.samples;
}

void Refinement::keep_part() {
    if (samples() != next_part()) return;
    before_ = std::move(last_);
    last_ = {samples(), light_of(exact_->image())};
}

bool Refinement::render_frame(std::uint32_t most, double ms, const KeepGoing& keep_going) {
    keep_part();  // reading the image finishes a frame that was cancelled
    const std::uint64_t before = samples();
    const auto to_part = static_cast<std::uint32_t>(next_part() - before);
    exact_->limit_frames(ms, std::min(most, to_part));
    (void)exact_->render_frame(keep_going);
    if (exact_->has_open_frame() || samples() == before) return false;
    keep_part();
    return true;
}

const Refinement::Part& Refinement::first_half(std::uint64_t samples) const {
    // The product of two means has the variance v^2 / (n m) of noise.
    const auto size = [&](const Part& part) { return part.samples * (samples - part.samples); };
    return size(last_) > size(before_) ? last_ : before_;
}

void Refinement::correct(Image& preview, std::uint64_t preview_samples) {
    const Image whole = light_of(exact_->image());
    const std::uint64_t count = samples();
    const Part& first = first_half(count);
    const Image second = rest_of(whole, count, first.mean, first.samples);
    const auto all = static_cast<double>(count);
    correct_preview(preview, {first.mean, second, static_cast<double>(first.samples) / all, count,
                              all / (all + static_cast<double>(preview_samples))});
}

}  // namespace weft
