// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "tests/testing/opencl_probe.h"

#define NATIVE_KERNELS "kernels/media/medium.h"
#include "tests/testing/native_kernels.h"

#define RESULTS 14

// clang-format off
BOTH_SIDES(
KERNEL_ENTRY void evaluate(GLOBAL const float* inputs, GLOBAL float* results, uint count) {
    const uint i = GLOBAL_ID;
    if (i >= count) return;
    const float sigma = inputs[4u * i];
    const float length = inputs[4u * i + 1u];
    const float g = inputs[4u * i + 2u];
    const float u = inputs[4u * i + 3u];
    GLOBAL float* r = results + i * RESULTS;
    r[0] = transmittance1(sigma, length);
    r[1] = opacity1(sigma, length);
    r[2] = lit_length1(sigma, length);
    float pdf = 0.0f;
    const float3 along = normalize3(f3(0.3f, u - 0.5f, 0.2f));
    const float3 to = scatter_direction(g, along, u, 0.7f, &pdf);
    r[3] = to.x;
    r[4] = to.y;
    r[5] = to.z;
    r[6] = pdf;
    r[7] = phase_function(g, along, to);
    const float3 extinction = f3(sigma, 0.5f, 0.0f);
    float3 ratio = f3(1.0f, 1.0f, 1.0f);
    r[8] = free_path(extinction, ratio, u, 0.4f);
    r[9] = update_ratio(&ratio, beer_transmittance(extinction, 0.5f));
    r[10] = ratio.x;
    const AngularView view = angular_view(f3(0.0f, 0.0f, 0.0f), along, 2.0f, f3(u, g, 0.4f));
    r[11] = angular_sample(view, 2.0f, u);
    r[12] = angular_pdf(view, r[11]);
    // The phase function at an angle of its own, for its integral.
    r[13] = phase_function(g, f3(0.0f, 0.0f, 1.0f),
                           f3(square_root(4.0f * u * (1.0f - u)), 0.0f, 1.0f - 2.0f * u));
}
)
// clang-format on

namespace weft::medium_opencl_test {
namespace {

constexpr std::uint32_t count = 60'000;

/// Optical depths of 1e-8 to 1e3, any g, numbers in [0, 1).
std::vector<float> make_inputs() {
    std::vector<float> inputs;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double length = std::pow(10.0, -3.0 + 6.0 * (i % 97) / 96.0);
        const double depth = std::pow(10.0, -8.0 + 11.0 * i / (count - 1));
        inputs.push_back(static_cast<float>(depth / length));
        inputs.push_back(static_cast<float>(length));
        inputs.push_back(static_cast<float>(i % 6) * 0.18F - 0.45F);
        inputs.push_back((static_cast<float>(i / 6) + 0.5F) / (count / 6));
    }
    return inputs;
}

std::vector<float> run_device(const cl::Device& device, std::vector<float> inputs) {
    std::set<std::string> done;
    const std::string source = test::expand("media/medium.h", done) + std::string(kernel_text);
    const cl::Context context(device);
    const cl::Program program =
        test::build_program(context, device, source, " -DRESULTS=" + std::to_string(RESULTS));
    const cl::CommandQueue queue(context, device);
    std::vector<float> results(std::size_t{count} * RESULTS);
    const cl::Buffer in(context, inputs.begin(), inputs.end(), true);
    const cl::Buffer out(context, CL_MEM_WRITE_ONLY, results.size() * sizeof(float));
    cl::Kernel kernel(program, "evaluate");
    kernel.setArg(0, in);
    kernel.setArg(1, out);
    kernel.setArg(2, cl_uint{count});
    test::run_items(queue, kernel, count);
    queue.enqueueReadBuffer(out, CL_TRUE, 0, results.size() * sizeof(float), results.data());
    return results;
}

/// The closed forms of tests/media/medium_test.cpp on what a device has computed.
void expect_closed_forms(const std::vector<float>& inputs, const std::vector<float>& results) {
    double totals[6] = {};
    double cosines[6] = {};
    for (std::size_t i = 0; i < count; ++i) {
        const float* const in = inputs.data() + 4 * i;
        const float* const out = results.data() + RESULTS * i;
        const double depth = static_cast<double>(in[0]) * static_cast<double>(in[1]);
        const double left = std::exp(-depth);
        if (left >= static_cast<double>(std::numeric_limits<float>::min())) {
            ASSERT_NEAR(static_cast<double>(out[0]), left, 1e-6 * left) << depth;
        }
        const double opacity = -std::expm1(-depth);
        ASSERT_NEAR(static_cast<double>(out[1]), opacity, 1e-6 * opacity) << depth;
        const double lit = opacity / static_cast<double>(in[0]);
        ASSERT_NEAR(static_cast<double>(out[2]), lit, 1e-6 * lit) << depth;
        // Midpoints over the cosine, uniform in it.
        const double share = 4.0 * std::numbers::pi / (count / 6) * static_cast<double>(out[13]);
        totals[i % 6] += share;
        cosines[i % 6] += share * (1.0 - 2.0 * static_cast<double>(in[3]));
    }
    for (std::size_t k = 0; k < 6; ++k) {
        EXPECT_NEAR(totals[k], 1.0, 2e-6);
        EXPECT_NEAR(cosines[k], static_cast<double>(inputs[4 * k + 2]), 2e-6);
    }
}

TEST(MediumOpencl, DevicesKeepTheClosedFormsAndTheNativeBits) {
    const std::vector<float> inputs = make_inputs();
    std::vector<float> expected(std::size_t{count} * RESULTS);
    for (std::uint32_t i = 0; i < count; ++i) {
        native::current_global_id = i;
        native::evaluate(inputs.data(), expected.data(), count);
    }
    expect_closed_forms(inputs, expected);
    const std::vector<cl::Device> devices = test::all_devices();
    if (devices.empty()) GTEST_SKIP() << "there is no OpenCL device";
    for (const cl::Device& device : devices) {
        SCOPED_TRACE(device.getInfo<CL_DEVICE_NAME>());
        const std::vector<float> found = run_device(device, inputs);
        expect_closed_forms(inputs, found);
        std::size_t different = 0;
        for (std::size_t i = 0; i < found.size(); ++i)
            if (native::as_bits(found[i]) != native::as_bits(expected[i]) && ++different < 5)
                ADD_FAILURE() << "result " << i % RESULTS << ": " << found[i] << ", expected "
                              << expected[i];
        EXPECT_EQ(different, 0U);
    }
}

}  // namespace
}  // namespace weft::medium_opencl_test

#endif
