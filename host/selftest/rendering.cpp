// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/rendering.h"

#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <string>

#include "scene/validate_scene.h"

namespace weft::selftest {

const std::vector<float>& Rendering::layer(std::string_view name) const {
    const Layer* const found = image.find(name);
    if (found == nullptr) throw std::runtime_error("no layer " + std::string(name));
    return found->values;
}

float Rendering::at(std::string_view name, std::uint32_t x, std::uint32_t y,
                    std::uint32_t channel) const {
    const std::size_t pixels = std::size_t{image.width} * image.height;
    return layer(name)[channel * pixels + std::size_t{y} * image.width + x];
}

double Rendering::irradiance(std::string_view name, std::uint32_t x, std::uint32_t y,
                             std::uint32_t channel) const {
    return static_cast<double>(at(name, x, y, channel)) * std::numbers::pi /
           static_cast<double>(at("albedo", x, y, channel));
}

RenderSettings small_settings(Algorithm algorithm, std::uint32_t width, std::uint32_t height) {
    RenderSettings settings;
    settings.algorithm = algorithm;
    settings.width = width;
    settings.height = height;
    // Probes, which images normally use only with many lights, are tested with a few.
    settings.sampling.min_probed_samples = 0;
    return settings;
}

RenderSettings unbounded(RenderSettings settings) {
    settings.sampling.bound_spacing = 1e-6;
    settings.sampling.local_bounds = false;
    return settings;
}

Rendering render_flat(Executor& executor, const FlatScene& flat, const Camera& camera,
                      const RenderSettings& settings, std::uint32_t frames) {
    Renderer renderer(executor, flat, camera, settings);
    for (std::uint32_t f = 0; f < frames; ++f)
        if (!renderer.render_frame({})) throw std::runtime_error("a frame ended early");
    return {renderer.image(), renderer.stats(), renderer.plan()};
}

Rendering render(Executor& executor, const Scene& scene, const Camera& camera,
                 const RenderSettings& settings, std::uint32_t frames) {
    validate_scene(scene);
    return render_flat(executor, flatten(scene), camera, settings, frames);
}

double mean_of(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) sum += static_cast<double>(value);
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

std::vector<double> channel_of(const Rendering& rendering, std::string_view layer,
                               std::uint32_t channel) {
    const std::size_t pixels = std::size_t{rendering.image.width} * rendering.image.height;
    const std::vector<float>& all = rendering.layer(layer);
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(channel * pixels);
    return {first, first + static_cast<std::ptrdiff_t>(pixels)};
}

double relative_mse(const std::vector<float>& reference, const std::vector<float>& test) {
    double difference = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double r = static_cast<double>(reference[i]);
        const double d = static_cast<double>(test.at(i)) - r;
        difference += d * d;
        square += r * r;
    }
    return square > 0.0 ? difference / square : difference;
}

std::size_t differing_values(const Image& a, const Image& b) {
    std::size_t count = a.layers.size() == b.layers.size() ? 0 : 1;
    for (const Layer& layer : a.layers) {
        const Layer* const other = b.find(layer.name);
        if (other == nullptr || other->values.size() != layer.values.size()) return count + 1;
        for (std::size_t i = 0; i < layer.values.size(); ++i)
            count += std::memcmp(&layer.values[i], &other->values[i], sizeof(float)) != 0 ? 1 : 0;
    }
    return count;
}

std::size_t unclean_values(const Image& image) {
    std::size_t bad = 0;
    for (const Layer& layer : image.layers)
        for (const float value : layer.values)
            bad += !std::isfinite(value) || (value < 0.0F && layer.name != "normal") ? 1 : 0;
    return bad;
}

std::size_t guarded_values(const std::vector<FrameStats>& stats) {
    std::size_t guarded = 0;
    for (const FrameStats& frame : stats)
        for (const NonfiniteStats& component : frame.nonfinite) guarded += component.count;
    return guarded;
}

}  // namespace weft::selftest
