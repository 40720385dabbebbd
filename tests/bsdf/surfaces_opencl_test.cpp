// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "tests/testing/opencl_probe.h"

#define NATIVE_KERNELS "kernels/bsdf/bsdf.h"
#define NATIVE_KERNELS_TOO "kernels/light/light.h"
#include "tests/testing/native_kernels.h"

#define RESULTS 58

// clang-format off
BOTH_SIDES(
// Writes a vector as three results.
static inline void put(GLOBAL float* r, float3 v) {
    r[0] = v.x;
    r[1] = v.y;
    r[2] = v.z;
}

// Everything that kernels/bsdf and kernels/light say about six numbers in [0, 1).
KERNEL_ENTRY void evaluate(GLOBAL const LightRecord* lights,
                           GLOBAL const EmissiveTriangle* emissive, GLOBAL const float4* positions,
                           GLOBAL const Triangle* triangles, GLOBAL const float* xs,
                           GLOBAL float* results, uint count, uint kinds) {
    const uint i = GLOBAL_ID;
    if (i >= count) return;
    GLOBAL const float* x = xs + i * 6u;
    GLOBAL float* r = results + i * RESULTS;
    RenderParams params;
    params.features = FEATURE_LOBES;
    params.scene.extent = 2.0f;
    params.scene.bounding_sphere = f4(0.1f, 0.2f, 0.3f, 2.0f);
    params.scene.environment = f4(3.0f, 2.0f, 1.0f, 0.0f);
    Geometry geometry;
    geometry.positions = positions;
    geometry.triangles = triangles;
    EnvironmentImage image;
    image.record = 0;
    image.texels = 0;
    image.sums = 0;

    Bsdf bsdf;
    bsdf.lobe = LOBE_LAMBERT;
    bsdf.albedo = f3(x[4], x[5], 0.5f);
    const float3 axis = cone_direction(x[2], x[3], -1.0f);
    const float3 out = cone_direction(x[4], x[5], 0.0f);
    const BsdfSample sample = bsdf_sample(&bsdf, out, x[0], x[1]);
    const float3 in = cone_direction(x[0], x[1], -0.5f);
    const BsdfValue value = bsdf_eval(&bsdf, out, in);
    put(r, sample.in);
    put(r + 3, sample.weight);
    r[6] = sample.pdf;
    r[7] = (float)sample.flags;
    put(r + 8, value.colour * value.share);
    r[11] = bsdf_pdf(&bsdf, out, in);
    put(r + 12, bsdf_albedo(&bsdf, out) + bsdf_diffuse_albedo(&bsdf));
    put(r + 15, local_direction(to_world(in, axis), axis));
    r[18] = (float)bsdf_flags(&bsdf);

    float choice = x[4];
    const uint chosen = choose_light(lights, kinds, &choice);
    const LightRecord light = lights[chosen];
    EmissionNumbers numbers;
    numbers.u = x[0];
    numbers.v = x[1];
    numbers.s = x[2];
    numbers.t = x[3];
    numbers.rest = choice;
    const EmittedRay ray = emit_light(&params, &geometry, light, emissive, &image, &numbers);
    r[19] = (float)chosen;
    r[20] = choice;
    put(r + 21, ray.origin);
    put(r + 24, ray.direction);
    put(r + 27, ray.flux);

    LitPoint surface;
    surface.any_side = 0;
    surface.position = f3(x[2] - 0.5f, x[3] - 0.5f, 0.0f);
    surface.normal = f3(0.0f, 0.0f, 1.0f);
    surface.shading = normalize3(f3(0.2f * x[5], 0.1f, 1.0f));
    float probability;
    const uint other = choose_for_next_event(lights, kinds, 0.8f * x[5], &probability);
    const LightSample found =
        light_at_surface(&params, &geometry, lights[other], emissive, &image, &surface,
                         surface.position, probability, x[0], x[1]);
    r[30] = (float)other;
    r[31] = probability;
    put(r + 32, found.power);
    r[35] = found.share;
    r[36] = found.pdf;
    put(r + 37, found.in);
    put(r + 40, found.towards);
    r[43] = (float)found.distant;
    const ChosenPoint at =
        point_on_light(&params, &geometry, lights[other], emissive, &image, probability, x[0],
                       x[1]);
    const PlaceLight place = light_at_place(&params, &at, surface.position);
    put(r + 44, place.irradiance);
    put(r + 47, place.direction);
    put(r + 50, place.target);
    r[53] = place.distance;
    r[54] = place.pdf;
    put(r + 55,
        environment_radiance(&params, &image, in) * environment_local_direction(x[0], x[1]));
}
)
// clang-format on

namespace weft::surfaces_opencl_test {
namespace {

// The kinds of light that surfaces choose from come first, with four fifths of the probability.
constexpr std::uint32_t kinds = 5;

struct Inputs {
    std::vector<native::LightRecord> lights;
    std::vector<native::EmissiveTriangle> emissive = {{0, 0.25F, 0.25F, 0}, {1, 1.0F, 0.75F, 0}};
    std::vector<native::float4> positions = {
        native::f4(-0.5F, -0.5F, 1, 0), native::f4(0.5F, -0.5F, 1, 0), native::f4(0.5F, 0.5F, 1, 0),
        native::f4(-1.0F, 2.0F, 1, 0)};
    std::vector<native::Triangle> triangles = {{0, 2, 1, 0}, {0, 3, 2, 0}};
    std::vector<float> numbers;
};

Inputs make_inputs(std::size_t count) {
    Inputs inputs;
    constexpr std::uint32_t emitters[] = {EMITTER_AREA, EMITTER_POINT, EMITTER_SPOT,
                                          EMITTER_DIRECTIONAL, EMITTER_ENVIRONMENT};
    for (std::uint32_t i = 0; i < kinds; ++i) {
        native::LightRecord light{};
        light.kind = emitters[i];
        light.probability = 0.2F;
        light.cumulative = i + 1 == kinds ? 1.0F : 0.2F * static_cast<float>(i + 1);
        light.choice_probability = 0.2F;
        light.choice_cumulative = light.cumulative;
        light.position = native::f4(0.2F, -0.1F, 1.5F, 0.0F);
        light.axis = native::f4(0.0F, 0.6F, -0.8F, 0.0F);
        light.power = native::f4(3.0F, 2.0F, 1.0F, 0.0F);
        light.count = 2;
        light.area = 2.0F;
        light.both_sides = 1;
        light.cos_inner = 0.9F;
        light.cos_outer = 0.2F;
        inputs.lights.push_back(light);
    }
    std::uint64_t state = 11;
    while (inputs.numbers.size() < 6 * count) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        inputs.numbers.push_back(static_cast<float>(state >> 40) * 0x1p-24F);
    }
    return inputs;
}

std::vector<float> run_native(const Inputs& inputs) {
    const auto count = static_cast<std::uint32_t>(inputs.numbers.size() / 6);
    std::vector<float> results(std::size_t{count} * RESULTS);
    for (std::uint32_t i = 0; i < count; ++i) {
        native::current_global_id = i;
        native::evaluate(inputs.lights.data(), inputs.emissive.data(), inputs.positions.data(),
                         inputs.triangles.data(), inputs.numbers.data(), results.data(), count,
                         kinds);
    }
    return results;
}

std::vector<float> run_device(const cl::Device& device, Inputs inputs) {
    std::set<std::string> done;
    std::string source = test::expand("bsdf/bsdf.h", done);
    source += test::expand("light/light.h", done);
    source += kernel_text;
    const cl::Context context(device);
    const cl::Program program =
        test::build_program(context, device, source, " -DRESULTS=" + std::to_string(RESULTS));
    const cl::CommandQueue queue(context, device);
    const std::size_t count = inputs.numbers.size() / 6;
    std::vector<float> results(count * RESULTS);
    const cl::Buffer lights(context, inputs.lights.begin(), inputs.lights.end(), true);
    const cl::Buffer emissive(context, inputs.emissive.begin(), inputs.emissive.end(), true);
    const cl::Buffer positions(context, inputs.positions.begin(), inputs.positions.end(), true);
    const cl::Buffer triangles(context, inputs.triangles.begin(), inputs.triangles.end(), true);
    const cl::Buffer numbers(context, inputs.numbers.begin(), inputs.numbers.end(), true);
    const cl::Buffer out(context, CL_MEM_WRITE_ONLY, results.size() * sizeof(float));
    cl::Kernel kernel(program, "evaluate");
    kernel.setArg(0, lights);
    kernel.setArg(1, emissive);
    kernel.setArg(2, positions);
    kernel.setArg(3, triangles);
    kernel.setArg(4, numbers);
    kernel.setArg(5, out);
    kernel.setArg(6, static_cast<cl_uint>(count));
    kernel.setArg(7, static_cast<cl_uint>(kinds));
    test::run_items(queue, kernel, count);
    queue.enqueueReadBuffer(out, CL_TRUE, 0, results.size() * sizeof(float), results.data());
    return results;
}

TEST(SurfacesOpencl, DevicesScatterAndShineAsTheNativeBuildDoes) {
    bool tried = false;
    for (const cl::Device& device : test::all_devices()) {
        if (!test::rounds_correctly(device)) continue;
        tried = true;
        const std::string name = device.getInfo<CL_DEVICE_NAME>();
        SCOPED_TRACE(name);
        const Inputs inputs = make_inputs(test::is_interpreter(device) ? 2'000 : 100'000);
        const std::vector<float> expected = run_native(inputs);
        const std::vector<float> got = run_device(device, inputs);
        ASSERT_EQ(got.size(), expected.size());
        std::set<float> chosen;
        std::size_t different = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            if (i % RESULTS == 19) chosen.insert(expected[i]);
            if (std::isnan(got[i]) && std::isnan(expected[i])) continue;
            if (native::as_bits(got[i]) == native::as_bits(expected[i])) continue;
            if (++different <= 5)
                ADD_FAILURE() << "result " << i % RESULTS << " of item " << i / RESULTS << ": "
                              << got[i] << ", expected " << expected[i];
        }
        EXPECT_EQ(different, 0U);
        EXPECT_EQ(chosen.size(), kinds);
    }
    if (!tried) GTEST_SKIP() << "no OpenCL device with denormals and correctly rounded division";
}

}  // namespace
}  // namespace weft::surfaces_opencl_test

#endif
