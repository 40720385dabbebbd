// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "scene/flat_environment.h"
#include "tests/testing/environment_images.h"
#include "tests/testing/opencl_probe.h"

#define NATIVE_KERNELS "kernels/light/light.h"
#include "tests/testing/native_kernels.h"

#define RESULTS 30

// clang-format off
BOTH_SIDES(
// Writes a vector as three results.
static inline void put(GLOBAL float* r, float3 v) {
    r[0] = v.x;
    r[1] = v.y;
    r[2] = v.z;
}

// What kernels/light says about an image of the environment and four numbers in [0, 1).
KERNEL_ENTRY void evaluate(GLOBAL const EnvironmentRecord* environment_record,
                           GLOBAL const float* environment_texels,
                           GLOBAL const float* environment_sums, GLOBAL const float* xs,
                           GLOBAL float* results, uint count) {
    const uint i = GLOBAL_ID;
    if (i >= count) return;
    GLOBAL const float* x = xs + i * 4u;
    GLOBAL float* r = results + i * RESULTS;
    ENVIRONMENT_MAKE(image);
    RenderParams params;
    params.features = FEATURE_LOBES | FEATURE_ENVIRONMENT | FEATURE_IMAGE_ENVIRONMENT;
    params.camera.hides_environment = 0u;
    params.scene.bounding_sphere = f4(0.1f, 0.2f, 0.3f, 2.0f);
    params.scene.environment = f4(3.0f, 2.0f, 1.0f, 0.0f);
    const float3 direction = cone_direction(x[0], x[1], -1.0f) * (0.25f + x[2]);
    float pdf;
    put(r, environment_met(&params, &image, direction, &pdf));
    r[3] = pdf;
    const EnvironmentSample sample = sample_environment(&params, &image, x[0], x[1]);
    put(r + 4, sample.direction);
    put(r + 7, sample.radiance);
    r[10] = sample.pdf;
    Geometry geometry;
    LightRecord light;
    light.kind = EMITTER_ENVIRONMENT;
    light.probability = 0.25f;
    light.power = params.scene.environment;
    EmissionNumbers numbers;
    numbers.u = x[0];
    numbers.v = x[1];
    numbers.s = x[2];
    numbers.t = x[3];
    numbers.rest = 0.0f;
    const EmittedRay ray = emit_light(&params, &geometry, light, 0, &image, &numbers);
    put(r + 11, ray.origin);
    put(r + 14, ray.flux);
    LitPoint lit;
    lit.any_side = 0;
    lit.position = f3(0.0f, 0.0f, 0.0f);
    lit.normal = cone_direction(x[2], x[3], -1.0f);
    lit.shading = lit.normal;
    const LightSample found = light_at_surface(&params, &geometry, light, 0, &image, &lit,
                                               lit.position, 0.5f, x[0], x[1]);
    put(r + 17, found.in);
    put(r + 20, found.power);
    r[23] = found.pdf;
    const ChosenPoint chosen =
        point_on_light(&params, &geometry, light, 0, &image, 0.5f, x[2], x[3]);
    const PlaceLight place = light_at_place(&params, &chosen, lit.position);
    put(r + 24, place.irradiance);
    put(r + 27, place.direction);
}
)
// clang-format on

namespace weft::environment_image_opencl_test {
namespace {

struct Inputs {
    FlatEnvironment flat;
    std::vector<float> numbers;
};

Inputs make_inputs(std::size_t count) {
    // Turned and mirrored.
    const glm::dmat3 turn{{0.6, 0.0, 0.8}, {0.0, 1.0, 0.0}, {0.8, 0.0, -0.6}};
    Inputs inputs{flatten_environment(test::sunny_sky(), turn), {}};
    std::uint64_t state = 11;
    while (inputs.numbers.size() < 4 * count) {
        state = state * 6364136223846793005U + 1442695040888963407U;
        inputs.numbers.push_back(static_cast<float>(state >> 40) * 0x1p-24F);
    }
    return inputs;
}

std::vector<float> run_native(const Inputs& inputs) {
    const auto count = static_cast<std::uint32_t>(inputs.numbers.size() / 4);
    std::vector<float> results(std::size_t{count} * RESULTS);
    native::EnvironmentRecord record{};
    static_assert(sizeof(record) == sizeof(shared::EnvironmentRecord));
    std::memcpy(&record, inputs.flat.records.data(), sizeof(record));
    for (std::uint32_t i = 0; i < count; ++i) {
        native::current_global_id = i;
        native::evaluate(&record, inputs.flat.texels.data(), inputs.flat.sums.data(),
                         inputs.numbers.data(), results.data(), count);
    }
    return results;
}

std::vector<float> run_device(const cl::Device& device, Inputs inputs) {
    std::set<std::string> done;
    std::string source = test::expand("light/light.h", done);
    source += kernel_text;
    const cl::Context context(device);
    const cl::Program program =
        test::build_program(context, device, source, " -DRESULTS=" + std::to_string(RESULTS));
    const cl::CommandQueue queue(context, device);
    const std::size_t count = inputs.numbers.size() / 4;
    std::vector<float> results(count * RESULTS);
    FlatEnvironment& flat = inputs.flat;
    const cl::Buffer record(context, flat.records.begin(), flat.records.end(), true);
    const cl::Buffer texels(context, flat.texels.begin(), flat.texels.end(), true);
    const cl::Buffer sums(context, flat.sums.begin(), flat.sums.end(), true);
    const cl::Buffer numbers(context, inputs.numbers.begin(), inputs.numbers.end(), true);
    const cl::Buffer out(context, CL_MEM_WRITE_ONLY, results.size() * sizeof(float));
    cl::Kernel kernel(program, "evaluate");
    kernel.setArg(0, record);
    kernel.setArg(1, texels);
    kernel.setArg(2, sums);
    kernel.setArg(3, numbers);
    kernel.setArg(4, out);
    kernel.setArg(5, static_cast<cl_uint>(count));
    test::run_items(queue, kernel, count);
    queue.enqueueReadBuffer(out, CL_TRUE, 0, results.size() * sizeof(float), results.data());
    return results;
}

TEST(EnvironmentImageOpencl, DevicesLookUpAndSampleAsTheNativeBuildDoes) {
    bool tried = false;
    for (const cl::Device& device : test::all_devices()) {
        if (!test::rounds_correctly(device)) continue;
        tried = true;
        SCOPED_TRACE(device.getInfo<CL_DEVICE_NAME>());
        const Inputs inputs = make_inputs(test::is_interpreter(device) ? 2'000 : 100'000);
        const std::vector<float> expected = run_native(inputs);
        const std::vector<float> got = run_device(device, inputs);
        ASSERT_EQ(got.size(), expected.size());
        std::size_t different = 0;
        std::set<float> pdfs;
        for (std::size_t i = 0; i < got.size(); ++i) {
            EXPECT_FALSE(std::isnan(expected[i])) << "result " << i % RESULTS;
            if (i % RESULTS == 10) pdfs.insert(expected[i]);
            if (native::as_bits(got[i]) == native::as_bits(expected[i])) continue;
            if (++different <= 5)
                ADD_FAILURE() << "result " << i % RESULTS << " of item " << i / RESULTS << ": "
                              << got[i] << ", expected " << expected[i];
        }
        EXPECT_EQ(different, 0U);
        EXPECT_GT(pdfs.size(), 100U);
    }
    if (!tried) GTEST_SKIP() << "no OpenCL device with denormals and correctly rounded division";
}

}  // namespace
}  // namespace weft::environment_image_opencl_test

#endif
