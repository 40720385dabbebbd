// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "scene/surface/plastic_table.h"
#include "tests/bsdf/whole_glass_table.h"
#include "tests/testing/opencl_probe.h"

#define NATIVE_KERNELS "kernels/bsdf/layered_sample.h"
#define NATIVE_KERNELS_TOO "tests/bsdf/layered_opencl_too.h"
#include "tests/testing/native_kernels.h"

#define RESULTS 40
#define NUMBERS 14

// clang-format off
BOTH_SIDES(
// Writes a vector as three results.
static inline void put(GLOBAL float* r, float3 v) {
    r[0] = v.x;
    r[1] = v.y;
    r[2] = v.z;
}

// A layered material, a plastic and a bent normal by numbers in [0, 1).
KERNEL_ENTRY void evaluate(GLOBAL const float* glass, GLOBAL const float* plastic_values,
                           GLOBAL const float* xs, GLOBAL float* results, uint count) {
    const uint i = GLOBAL_ID;
    if (i >= count) return;
    GLOBAL const float* x = xs + i * NUMBERS;
    GLOBAL float* r = results + i * RESULTS;
    const float3 v = cone_direction(x[0], x[1], 0.0f);
    const float3 l = cone_direction(x[2], x[3], -1.0f);
    const float alpha = x[4] < 0.1f ? 0.0f : x[4] * x[4];

    LayeredMaterial material;
    material.flags = i % 4u == 0u ? LAYERED_THIN : (i % 4u == 1u ? LAYERED_CONDUCTOR : 0u);
    material.metallic = i % 4u == 1u ? 1.0f : x[5];
    material.transmission = x[6];
    material.base = f3(x[7], x[8], x[9]);
    material.f0 = f3(0.04f, 0.08f * x[5], 0.02f);
    material.f90 = x[6];
    material.facets = make_facets(alpha, i % 3u == 0u ? alpha * x[5] : alpha,
                                  i % 5u == 0u ? FACETS_BECKMANN
                                               : (i % 5u == 1u ? FACETS_SEPARABLE : 0u));
    material.sheet = sheet_facets(material.facets, 1.0f + x[8]);
    const bool inside = (i & 8u) != 0u && i % 4u != 0u;
    material.ratio.eta = inside ? 0.666666687f : 1.5f;
    material.ratio.step = inside ? -0.555555582f : 1.25f;
    material.glass_albedo = glass_albedo(glass, material.facets, v.z);
    material.eta = f3(0.1553f, 0.1167f, 1.4420f);
    material.k = f3(4.8284f, 3.1222f, 1.6034f);
    material.coat = x[9] < 0.5f ? 0.0f : x[9];
    material.coat_facets = make_facets(0.2f * x[7], 0.2f * x[7], 0u);
    material.geometric_normal = f3(0.0f, 0.0f, 1.0f);
    material.coat_normal = normalize3(f3(0.2f * x[5], 0.1f, 1.0f));
    material.diffuse_normal = normalize3(f3(0.1f, -0.2f * x[6], 1.0f));

    const LayeredBsdf bsdf = make_layered(&material, v);
    const LayeredValue whole = layered_eval(&bsdf, v, l);
    put(r, whole.value);
    r[3] = whole.pdf;
    const BsdfSample sample = layered_sample(&bsdf, v, x[10], x[11], x[12]);
    put(r + 4, sample.in);
    put(r + 7, sample.weight);
    r[10] = sample.pdf;
    r[11] = (float)sample.flags;
    put(r + 12, layered_albedo(&bsdf, v));
    put(r + 15, layered_diffuse_albedo(&material));

    Plastic plastic;
    plastic.facets = material.facets;
    plastic.ratio.eta = 1.5f;
    plastic.ratio.step = 1.25f;
    plastic.specular = f3(1.0f, x[7], x[8]);
    plastic.body = plastic_body(material.base, inner_reflectance(1.5f), i % 2u == 0u, 1.5f);
    plastic.weight = x[9];
    plastic.transmittance = plastic_values;
    float pdf;
    put(r + 18, plastic_eval(&plastic, v, l, &pdf));
    r[21] = pdf;
    const BsdfSample other = plastic_sample(&plastic, v, x[10], x[11], x[12]);
    put(r + 22, other.in);
    put(r + 25, other.weight);
    r[28] = other.pdf;
    r[29] = (float)other.flags;

    const Pane pane = pane_of_glass(plastic.ratio, v.z);
    r[30] = pane.reflected;
    r[31] = pane.transmitted;
    put(r + 32, bent_normal(v, l, f3(0.0f, 0.0f, 1.0f)));
    put(r + 35, conductor_fresnel(material.eta, material.k, x[13]));
    const bool smooth = facets_are_smooth(material.facets);
    r[38] = smooth ? 0.0f : facet_density(material.facets, v + l);
    r[39] = masking_length(material.facets, v);
}
)
// clang-format on

namespace weft::layered_opencl_test {
namespace {

struct Inputs {
    std::vector<float> glass = test::whole_glass_table(1.5);
    std::vector<float> plastic = plastic_table(0.2, 1.5, false).transmittance;
    std::vector<float> numbers;
};

Inputs make_inputs(std::size_t count) {
    Inputs inputs;
    std::uint64_t state = 17;
    while (inputs.numbers.size() < NUMBERS * count) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        inputs.numbers.push_back(static_cast<float>(state >> 40) * 0x1p-24F);
    }
    return inputs;
}

std::vector<float> run_native(const Inputs& inputs) {
    const auto count = static_cast<std::uint32_t>(inputs.numbers.size() / NUMBERS);
    std::vector<float> results(std::size_t{count} * RESULTS);
    for (std::uint32_t i = 0; i < count; ++i) {
        native::current_global_id = i;
        native::evaluate(inputs.glass.data(), inputs.plastic.data(), inputs.numbers.data(),
                         results.data(), count);
    }
    return results;
}

std::vector<float> run_device(const cl::Device& device, Inputs inputs) {
    std::set<std::string> done;
    std::string source;
    for (const char* header : {"bsdf/layered_sample.h", "bsdf/plastic.h", "bsdf/bent_normal.h"})
        source += test::expand(header, done);
    source += kernel_text;
    const cl::Context context(device);
    const cl::Program program = test::build_program(
        context, device, source,
        " -DRESULTS=" + std::to_string(RESULTS) + " -DNUMBERS=" + std::to_string(NUMBERS));
    const cl::CommandQueue queue(context, device);
    const std::size_t count = inputs.numbers.size() / NUMBERS;
    std::vector<float> results(count * RESULTS);
    const cl::Buffer glass(context, inputs.glass.begin(), inputs.glass.end(), true);
    const cl::Buffer plastic(context, inputs.plastic.begin(), inputs.plastic.end(), true);
    const cl::Buffer numbers(context, inputs.numbers.begin(), inputs.numbers.end(), true);
    const cl::Buffer out(context, CL_MEM_WRITE_ONLY, results.size() * sizeof(float));
    cl::Kernel kernel(program, "evaluate");
    kernel.setArg(0, glass);
    kernel.setArg(1, plastic);
    kernel.setArg(2, numbers);
    kernel.setArg(3, out);
    kernel.setArg(4, static_cast<cl_uint>(count));
    test::run_items(queue, kernel, count);
    queue.enqueueReadBuffer(out, CL_TRUE, 0, results.size() * sizeof(float), results.data());
    return results;
}

TEST(LayeredOpencl, DevicesScatterAsTheNativeBuildDoes) {
    bool tried = false;
    for (const cl::Device& device : test::all_devices()) {
        if (!test::rounds_correctly(device)) continue;
        tried = true;
        SCOPED_TRACE(device.getInfo<CL_DEVICE_NAME>());
        const Inputs inputs = make_inputs(test::is_interpreter(device) ? 1'000 : 100'000);
        const std::vector<float> expected = run_native(inputs);
        const std::vector<float> got = run_device(device, inputs);
        ASSERT_EQ(got.size(), expected.size());
        std::set<float> flags;
        std::size_t different = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            if (i % RESULTS == 11) flags.insert(expected[i]);
            ASSERT_TRUE(std::isfinite(expected[i])) << "result " << i % RESULTS;
            if (native::as_bits(got[i]) == native::as_bits(expected[i])) continue;
            if (++different <= 5)
                ADD_FAILURE() << "result " << i % RESULTS << " of item " << i / RESULTS << ": "
                              << got[i] << ", expected " << expected[i];
        }
        EXPECT_EQ(different, 0U);
        // Nothing, reflection, transmission, each as a delta, and what is diffuse.
        EXPECT_GE(flags.size(), 6U);
    }
    if (!tried) GTEST_SKIP() << "no OpenCL device with denormals and correctly rounded division";
}

}  // namespace
}  // namespace weft::layered_opencl_test

#endif
