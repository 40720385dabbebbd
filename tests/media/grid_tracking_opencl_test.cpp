// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "tests/testing/density_grid_reference.h"
#include "tests/testing/opencl_probe.h"

#define NATIVE_KERNELS "kernels/media/grid_tracking.h"
#include "tests/testing/native_kernels.h"

#define RESULTS 11

#include "tests/testing/grid_rays.h"
#include "tests/testing/native_density_grid.h"

// clang-format off
BOTH_SIDES(
KERNEL_ENTRY void track(GLOBAL const DensityGridRecord* records, GLOBAL const float* densities,
                   GLOBAL const float* bounds, GLOBAL const float* rays, GLOBAL float* results,
                   uint count) {
    const uint i = GLOBAL_ID;
    if (i >= count) return;
    const DensityGrid grid = density_grid(records[0], densities, bounds);
    GLOBAL const float* ray = rays + i * 9u;
    GLOBAL float* r = results + i * RESULTS;
    const float3 origin = f3(ray[0], ray[1], ray[2]);
    const float3 direction = f3(ray[3], ray[4], ray[5]);
    const float sigma = ray[8];
    Random random = make_random(1u, 2u, i);
    float t;
    float density;
    float3 ratio = f3(1.0f, 1.0f, 1.0f);
    r[0] = (float)grid_collision(&grid, origin, direction, ray[6], ray[7],
                                 f3(sigma, 0.1f * sigma, 0.7f * sigma), &ratio, &random, &t,
                                 &density);
    r[1] = t;
    r[2] = density;
    const float3 passed = grid_transmittance(&grid, origin, direction, ray[6], ray[7],
                                             f3(sigma, 0.5f * sigma, 0.0f), &random);
    r[3] = passed.x;
    r[4] = passed.y;
    r[5] = passed.z;
    r[6] = grid_depth(&grid, origin, direction, ray[6], ray[7]);
    r[7] = density_at(&grid, origin);
    r[8] = ratio.x;
    r[9] = ratio.y;
    r[10] = ratio.z;
}
)
// clang-format on

namespace weft::grid_tracking_opencl_test {
namespace {

std::vector<float> ray_floats() {
    std::vector<float> floats;
    const std::array<float, 5> sigmas = {0.0F, 1.0F, 30.0F, 1e5F, 1e30F};
    std::size_t n = 0;
    for (const TestRay& ray : test_rays())
        floats.insert(floats.end(),
                      {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y,
                       ray.direction.z, ray.first, ray.last, sigmas[n++ % sigmas.size()]});
    return floats;
}

std::vector<float> run_native(const NativeGrid& grid, const std::vector<float>& rays) {
    const auto count = static_cast<std::uint32_t>(rays.size() / 9);
    std::vector<float> results(std::size_t{count} * RESULTS);
    for (std::uint32_t i = 0; i < count; ++i) {
        native::current_global_id = i;
        native::track(&grid.record(), grid.densities().data(), grid.bounds().data(), rays.data(),
                      results.data(), count);
    }
    return results;
}

template <typename Values>
cl::Buffer buffer_of(const cl::Context& context, const Values& values) {
    return {context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, values.size() * sizeof(values[0]),
            const_cast<void*>(static_cast<const void*>(values.data()))};
}

std::vector<float> run_device(const cl::Device& device, const NativeGrid& grid,
                              const std::vector<float>& rays) {
    std::set<std::string> done;
    const std::string source =
        test::expand("media/grid_tracking.h", done) + std::string(kernel_text);
    const cl::Context context(device);
    const cl::Program program =
        test::build_program(context, device, source, " -DRESULTS=" + std::to_string(RESULTS));
    const cl::CommandQueue queue(context, device);
    std::vector<float> results(rays.size() / 9 * RESULTS);
    const cl::Buffer out(context, CL_MEM_WRITE_ONLY, results.size() * sizeof(float));
    // Kernels do not keep their arguments alive.
    const std::array inputs = {buffer_of(context, std::array{grid.record()}),
                               buffer_of(context, grid.densities()),
                               buffer_of(context, grid.bounds()), buffer_of(context, rays)};
    cl::Kernel kernel(program, "track");
    for (cl_uint i = 0; i < inputs.size(); ++i) kernel.setArg(i, inputs[i]);
    kernel.setArg(4, out);
    kernel.setArg(5, static_cast<cl_uint>(rays.size() / 9));
    test::run_items(queue, kernel, rays.size() / 9);
    queue.enqueueReadBuffer(out, CL_TRUE, 0, results.size() * sizeof(float), results.data());
    return results;
}

TEST(GridTrackingOpencl, DevicesGiveTheBitsOfTheNativeBuild) {
    bool tried = false;
    const NativeGrid grid(make_random_grid({17, 30, 9}, 4));
    const std::vector<float> rays = ray_floats();
    const std::vector<float> expected = run_native(grid, rays);
    for (const cl::Device& device : test::all_devices()) {
        if (!test::rounds_correctly(device) || test::is_interpreter(device)) continue;
        tried = true;
        SCOPED_TRACE(device.getInfo<CL_DEVICE_NAME>());
        const std::vector<float> got = run_device(device, grid, rays);
        ASSERT_EQ(got.size(), expected.size());
        std::size_t different = 0;
        for (std::size_t i = 0; i < got.size(); ++i) {
            if (native::as_bits(got[i]) == native::as_bits(expected[i])) continue;
            if (++different > 5) continue;
            ADD_FAILURE() << "result " << i % RESULTS << " of ray " << i / RESULTS << ": " << got[i]
                          << ", expected " << expected[i];
        }
        EXPECT_EQ(different, 0U);
    }
    if (!tried) GTEST_SKIP() << "no OpenCL device with denormals and correctly rounded division";
}

}  // namespace
}  // namespace weft::grid_tracking_opencl_test

#endif
