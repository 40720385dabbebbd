// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_TESTING_RENDER_FIXTURE_H
#define WEFT_TESTS_TESTING_RENDER_FIXTURE_H

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
#include "render/renderer.h"
#include "scene/validate_scene.h"
#include "selftest/rendering.h"
#include "tests/testing/scene_builder.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/opencl_executor.h"
#endif

namespace weft::test {

/// What runs the kernels.
enum class TestBackend : std::uint8_t { opencl, own_bvh, embree };

inline const char* backend_name(TestBackend backend) {
    switch (backend) {
        case TestBackend::opencl:
            return "opencl";
        case TestBackend::own_bvh:
            return "own_bvh";
        case TestBackend::embree:
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
inline const std::vector<TestBackend>& backends() {
    static const std::vector<TestBackend> all = [] {
        std::vector<TestBackend> found{TestBackend::own_bvh, TestBackend::embree};
        if (has_opencl())
            found.push_back(TestBackend::opencl);
        else
            std::cout << "no OpenCL device: tested on the native backends only\n";
        return found;
    }();
    return all;
}

/// The backends of tests that compare many samples with light that is known: the native kernels
/// alone, since those of OpenCL compute the same bits and Embree meets the same triangles, which
/// tests/device/backend_agreement_test.cpp and tests of single components prove. All backends of
/// the machine where the environment variable WEFT_TEST_BACKENDS is `all`.
inline const std::vector<TestBackend>& light_backends() {
    static const std::vector<TestBackend> chosen = [] {
        const char* const wanted = std::getenv("WEFT_TEST_BACKENDS");
        return wanted != nullptr && std::string_view(wanted) == "all"
                   ? backends()
                   : std::vector<TestBackend>{TestBackend::own_bvh};
    }();
    return chosen;
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
inline std::unique_ptr<Executor> make_executor(TestBackend backend, std::uint32_t lanes = 0,
                                               int threads = 0) {
    std::optional<LanesInEnvironment> environment;
    if (lanes > 0) environment.emplace(lanes);
    if (backend == TestBackend::embree)
        return make_native_executor(NativeTraversal::embree, threads);
#if WEFT_HAS_OPENCL
    if (backend == TestBackend::opencl)
        return make_opencl_executor(choose_opencl_device(""), threads);
#endif
    return make_native_executor(NativeTraversal::own_bvh, threads);
}

/// One executor a backend for the whole program, so that kernels are built once.
inline Executor& shared_executor(TestBackend backend) {
    static std::array<std::unique_ptr<Executor>, 3> made;
    auto& executor = made.at(static_cast<std::size_t>(backend));
    if (!executor) executor = make_executor(backend);
    return *executor;
}

using selftest::render;

inline Rendering render(TestBackend backend, const Scene& scene, const Camera& camera,
                        const RenderSettings& settings, std::uint32_t frames = 1) {
    return render(shared_executor(backend), scene, camera, settings, frames);
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
