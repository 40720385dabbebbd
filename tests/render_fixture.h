// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_RENDER_FIXTURE_H
#define WEFT_TESTS_RENDER_FIXTURE_H

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "device/native/native_executor.h"
#include "frame/renderer.h"
#include "scene/validate_scene.h"
#include "scene_builder.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/opencl_executor.h"
#endif

namespace weft::test {

/// What runs the kernels.
enum class Backend : std::uint8_t { opencl, own_bvh, embree };

inline const char* backend_name(Backend backend) {
    switch (backend) {
        case Backend::opencl:
            return "opencl";
        case Backend::own_bvh:
            return "own_bvh";
        case Backend::embree:
            return "embree";
    }
    return "";
}

inline bool has_opencl() {
#if WEFT_HAS_OPENCL
    static const bool found = !opencl_devices().empty();
    return found;
#else
    return false;
#endif
}

/// The backends of this machine; says once what is missing.
inline const std::vector<Backend>& backends() {
    static const std::vector<Backend> all = [] {
        std::vector<Backend> found{Backend::own_bvh, Backend::embree};
        if (has_opencl())
            found.push_back(Backend::opencl);
        else
            std::cout << "no OpenCL device: tested on the native backends only\n";
        return found;
    }();
    return all;
}

/// Sets WEFT_LANES for as long as it lives.
class LanesInEnvironment {
  public:
    explicit LanesInEnvironment(std::uint32_t lanes) {
        if (const char* const before = std::getenv("WEFT_LANES")) before_ = before;
        setenv("WEFT_LANES", std::to_string(lanes).c_str(), 1);
    }
    ~LanesInEnvironment() {
        if (before_)
            setenv("WEFT_LANES", before_->c_str(), 1);
        else
            unsetenv("WEFT_LANES");
    }
    LanesInEnvironment(const LanesInEnvironment&) = delete;
    LanesInEnvironment& operator=(const LanesInEnvironment&) = delete;

  private:
    std::optional<std::string> before_;
};

/// An executor; `lanes` 0 leaves the packet width to the environment and the device.
inline std::unique_ptr<Executor> make_executor(Backend backend, std::uint32_t lanes = 0,
                                               int threads = 0) {
    std::optional<LanesInEnvironment> environment;
    if (lanes > 0) environment.emplace(lanes);
    if (backend == Backend::embree) return make_native_executor(NativeTraversal::embree, threads);
#if WEFT_HAS_OPENCL
    if (backend == Backend::opencl) return make_opencl_executor(choose_opencl_device(""), threads);
#endif
    return make_native_executor(NativeTraversal::own_bvh, threads);
}

/// One executor a backend for the whole program, so that kernels are built once.
inline Executor& shared_executor(Backend backend) {
    static std::array<std::unique_ptr<Executor>, 3> made;
    auto& executor = made.at(static_cast<std::size_t>(backend));
    if (!executor) executor = make_executor(backend);
    return *executor;
}

/// A finished rendering.
struct Rendering {
    Image image;
    std::vector<FrameStats> stats;
    FramePlan plan;

    /// Values of a layer, "" for beauty: planar.
    [[nodiscard]] const std::vector<float>& layer(std::string_view name) const {
        const Layer* const found = image.find(name);
        if (found == nullptr) throw std::runtime_error("no layer " + std::string(name));
        return found->values;
    }
    [[nodiscard]] float at(std::string_view name, std::uint32_t x, std::uint32_t y,
                           std::uint32_t channel = 0) const {
        const std::size_t pixels = std::size_t{image.width} * image.height;
        return layer(name)[channel * pixels + std::size_t{y} * image.width + x];
    }
    /// Irradiance of a pixel by a light layer, its albedo taken out.
    [[nodiscard]] double irradiance(std::string_view name, std::uint32_t x, std::uint32_t y,
                                    std::uint32_t channel = 0) const {
        return static_cast<double>(at(name, x, y, channel)) * std::numbers::pi /
               static_cast<double>(at("albedo", x, y, channel));
    }
};

/// Settings for a small picture.
inline RenderSettings small_settings(Algorithm algorithm, std::uint32_t width,
                                     std::uint32_t height) {
    RenderSettings settings;
    settings.algorithm = algorithm;
    settings.width = width;
    settings.height = height;
    return settings;
}

/// Settings whose bound on the geometry term never bites, so that means are unbiased.
inline RenderSettings unbounded(RenderSettings settings) {
    settings.sampling.bound_spacing = 1e-6;
    return settings;
}

/// Renders a flattened scene.
inline Rendering render_flat(Executor& executor, const FlatScene& flat, const Camera& camera,
                             const RenderSettings& settings, std::uint32_t frames = 1) {
    Renderer renderer(executor, flat, camera, settings);
    for (std::uint32_t f = 0; f < frames; ++f)
        if (!renderer.render_frame({})) throw std::runtime_error("a frame ended early");
    return {renderer.image(), renderer.stats(), renderer.plan()};
}

/// Validates, flattens and renders.
inline Rendering render(Executor& executor, const Scene& scene, const Camera& camera,
                        const RenderSettings& settings, std::uint32_t frames = 1) {
    validate_scene(scene);
    return render_flat(executor, flatten(scene), camera, settings, frames);
}

inline Rendering render(Backend backend, const Scene& scene, const Camera& camera,
                        const RenderSettings& settings, std::uint32_t frames = 1) {
    return render(shared_executor(backend), scene, camera, settings, frames);
}

/// Mean of all values.
inline double mean_of(const std::vector<float>& values) {
    double sum = 0.0;
    for (const float value : values) sum += static_cast<double>(value);
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/// Sum of squared differences over sum of squares; 0 where both are all zero.
inline double relative_mse(const std::vector<float>& reference, const std::vector<float>& test) {
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

/// Values that differ in any bit, over all layers.
inline std::size_t differing_values(const Image& a, const Image& b) {
    std::size_t count = a.layers.size() == b.layers.size() ? 0 : 1;
    for (const Layer& layer : a.layers) {
        const Layer* const other = b.find(layer.name);
        if (other == nullptr || other->values.size() != layer.values.size()) return count + 1;
        for (std::size_t i = 0; i < layer.values.size(); ++i)
            count += std::memcmp(&layer.values[i], &other->values[i], sizeof(float)) != 0 ? 1 : 0;
    }
    return count;
}

/// That no value anywhere is Inf, NaN or, but for normals, negative, and that nothing was guarded.
inline void expect_clean(const Rendering& rendering) {
    for (const Layer& layer : rendering.image.layers) {
        std::size_t bad = 0;
        for (const float value : layer.values)
            bad += !std::isfinite(value) || (value < 0.0F && layer.name != "normal") ? 1 : 0;
        EXPECT_EQ(bad, 0U) << "layer \"" << layer.name << '"';
    }
    for (const FrameStats& frame : rendering.stats)
        for (std::size_t c = 0; c < frame.nonfinite.size(); ++c)
            EXPECT_EQ(frame.nonfinite[c].count, 0U) << "component " << c;
}

}  // namespace weft::test

#endif
