// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/measured_image.h"

#include <algorithm>
#include <memory>
#include <string>

#include "base/stopwatch.h"
#include "plan/algorithm.h"
#include "render/path_renderer.h"
#include "render/renderer.h"

namespace weft {
namespace {

std::unique_ptr<FrameRenderer> renderer_of(const ImageSubject& subject, const Preset& preset,
                                           std::uint32_t seed) {
    if (preset.algorithm == Algorithm::path) {
        PathSettings settings;
        settings.width = subject.size.width;
        settings.height = subject.size.height;
        settings.seed = seed;
        settings.samples = {0, preset.samples};
        return std::make_unique<PathRenderer>(subject.executor, subject.scene, subject.camera,
                                              settings, FilmSums{});
    }
    RenderSettings settings;
    settings.algorithm = preset.algorithm;
    settings.sampling = preset.sampling;
    settings.width = subject.size.width;
    settings.height = subject.size.height;
    settings.seed = seed;
    settings.samples = preset.samples;
    return std::make_unique<Renderer>(subject.executor, subject.scene, subject.camera, settings);
}

/// Removes noise as the preset asks for; returns how many milliseconds that took.
double denoise(Image& image, std::uint64_t samples, const ImageSubject& subject,
               const Preset& preset) {
    const auto found = std::find_if(
        subject.denoisers.begin(), subject.denoisers.end(),
        [&](const ImageDenoiser& known) { return known.denoiser() == preset.denoiser; });
    if (found == subject.denoisers.end()) return 0.0;
    const Stopwatch watch;
    found->denoise(
        image, samples,
        denoise_view(subject.camera, image.width, image.height, subject.scene.media.present()));
    return watch.total();
}

/// The beauty layer, which is compared; the others would only take memory.
Image beauty_of(const Image& image) {
    Image beauty{.width = image.width, .height = image.height, .layers = {}, .metadata = {}};
    if (const Layer* const layer = image.find("")) beauty.layers.push_back(*layer);
    return beauty;
}

}  // namespace

MeasuredImage measure_image(const ImageSubject& subject, const Preset& preset, std::uint32_t seed,
                            bool first_alone) {
    const std::unique_ptr<FrameRenderer> renderer = renderer_of(subject, preset, seed);
    const auto keeps_going = [&] { return !subject.keep_going || subject.keep_going(); };
    const KeepGoing keep_going = [&](Stage, double) { return keeps_going(); };
    // A frame of path tracing may hold many samples.
    while (renderer->samples() < preset.samples) {
        (void)renderer->render_frame(keep_going);
        if (first_alone || !keeps_going()) break;
    }
    MeasuredImage made;
    Image image = renderer->image();
    made.frames = static_cast<std::uint32_t>(renderer->samples());
    made.denoise_ms = denoise(image, renderer->samples(), subject, preset);
    made.ms = made.denoise_ms;
    made.image = beauty_of(image);
    for (const FrameStats& frame : renderer->stats()) {
        made.ms += frame.ms;
        made.rays += frame.rays;
    }
    return made;
}

}  // namespace weft
