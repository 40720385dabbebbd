// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/testing/opencl_probe.h"

#define NATIVE_KERNELS "kernels/core/vector.h"
#include "tests/testing/native_kernels.h"

#define RESULTS 30

// clang-format off
BOTH_SIDES(
KERNEL_ENTRY void evaluate(GLOBAL const float* xs, GLOBAL const float* ys, GLOBAL float* results,
                      uint count) {
    const uint i = GLOBAL_ID;
    if (i >= count) return;
    const float x = xs[i];
    const float y = ys[i];
    GLOBAL float* r = results + i * RESULTS;
    float s;
    float c;
    m_sincos(x, &s, &c);
    r[0] = s;
    r[1] = c;
    r[2] = m_exp(x);
    r[3] = m_expm1(x);
    r[4] = m_log(x);
    r[5] = m_log1p(x);
    r[6] = m_pow(x, y);
    r[7] = m_atan2(y, x);
    r[8] = m_asin(x);
    r[9] = m_acos(x);
    r[10] = m_floor(x);
    r[11] = m_min(x, y);
    r[12] = m_max(x, y);
    r[13] = m_clamp(x, -1.0f, y);
    const float3 v = f3(x, y, x - y);
    const float3 n = normalize3(v);
    float3 t;
    float3 b;
    make_basis(n, &t, &b);
    const float3 k = cross3(t, v);
    r[14] = n.x;
    r[15] = n.y;
    r[16] = n.z;
    r[17] = t.x;
    r[18] = t.y;
    r[19] = t.z;
    r[20] = b.x;
    r[21] = b.y;
    r[22] = b.z;
    r[23] = k.x;
    r[24] = k.y;
    r[25] = k.z;
    r[26] = length3(v);
    r[27] = dot3(v, n) + luminance(absolute3(v));
    r[28] = max_component(highest3(v, n)) - min_component(lowest3(v, t));
    r[29] = (float)dominant_axis(v) + (is_finite3(v) ? 4.0f : 0.0f);
}
)
// clang-format on

namespace weft::maths_opencl_test {
namespace {

struct Inputs {
    std::vector<float> x, y;
};

Inputs make_inputs(std::size_t count) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float special[] = {
        0.0f,     -0.0f,    1.0f,      -1.0f,
        1e-45f,   -1e-45f,  1e-38f,    2.0f,
        3.4e38f,  -3.4e38f, 0.5f,      -0.5f,
        12800.0f, infinity, -infinity, std::numeric_limits<float>::quiet_NaN()};
    std::uint64_t state = 7;
    const auto bits = [&state] {
        state = state * 6364136223846793005u + 1442695040888963407u;
        return static_cast<std::uint32_t>(state >> 32);
    };
    const auto within = [&bits](float range) {
        return range * (static_cast<float>(bits() >> 8) * 0x1p-23f - 1.0f);
    };
    Inputs inputs;
    for (float x : special) {
        for (float y : special) {
            inputs.x.push_back(x);
            inputs.y.push_back(y);
        }
    }
    constexpr float ranges[] = {1.0f, 7.0f, 110.0f, 12800.0f};
    while (inputs.x.size() < count) {
        const std::uint32_t kind = bits() % 8;
        inputs.x.push_back(kind < 4 ? within(ranges[kind]) : std::bit_cast<float>(bits()));
        inputs.y.push_back(kind < 6 ? within(30.0f) : std::bit_cast<float>(bits()));
    }
    return inputs;
}

std::vector<float> run_native(const Inputs& inputs) {
    const auto count = static_cast<std::uint32_t>(inputs.x.size());
    std::vector<float> results(inputs.x.size() * RESULTS);
    for (std::uint32_t i = 0; i < count; ++i) {
        native::current_global_id = i;
        native::evaluate(inputs.x.data(), inputs.y.data(), results.data(), count);
    }
    return results;
}

std::vector<float> run_device(const cl::Device& device, Inputs inputs) {
    std::set<std::string> done;
    const std::string source = test::expand("core/vector.h", done) + std::string(kernel_text);
    const cl::Context context(device);
    const cl::Program program =
        test::build_program(context, device, source, " -DRESULTS=" + std::to_string(RESULTS));
    const cl::CommandQueue queue(context, device);
    std::vector<float> results(inputs.x.size() * RESULTS);
    const cl::Buffer x(context, inputs.x.begin(), inputs.x.end(), true);
    const cl::Buffer y(context, inputs.y.begin(), inputs.y.end(), true);
    const cl::Buffer out(context, CL_MEM_WRITE_ONLY, results.size() * sizeof(float));
    cl::Kernel kernel(program, "evaluate");
    kernel.setArg(0, x);
    kernel.setArg(1, y);
    kernel.setArg(2, out);
    kernel.setArg(3, static_cast<cl_uint>(inputs.x.size()));
    test::run_items(queue, kernel, inputs.x.size());
    queue.enqueueReadBuffer(out, CL_TRUE, 0, results.size() * sizeof(float), results.data());
    return results;
}

TEST(MathsOpencl, DevicesGiveTheBitsOfTheNativeBuild) {
    bool tried = false;
    for (const cl::Device& device : test::all_devices()) {
        if (!test::rounds_correctly(device)) continue;
        tried = true;
        const std::string name = device.getInfo<CL_DEVICE_NAME>();
        SCOPED_TRACE(name);
        const Inputs inputs = make_inputs(test::is_interpreter(device) ? 20'000 : 1'000'000);
        const std::vector<float> expected = run_native(inputs);
        const std::vector<float> got = run_device(device, inputs);
        ASSERT_EQ(got.size(), expected.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            // The sign and payload of a NaN are the processor's own.
            if (std::isnan(got[i]) && std::isnan(expected[i])) continue;
            if (native::as_bits(got[i]) == native::as_bits(expected[i])) continue;
            if (++different > 5) continue;
            ADD_FAILURE() << "result " << i % RESULTS << " of x = " << inputs.x[i / RESULTS]
                          << ", y = " << inputs.y[i / RESULTS] << ": " << got[i] << ", expected "
                          << expected[i];
        }
        EXPECT_EQ(different, 0u);
    }
    if (!tried) GTEST_SKIP() << "no OpenCL device with denormals and correctly rounded division";
}

}  // namespace
}  // namespace weft::maths_opencl_test

#endif
