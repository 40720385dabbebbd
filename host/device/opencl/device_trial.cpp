// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/device_trial.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/quote.h"
#include "device/kernel_signature.h"
#include "device/launch.h"
#include "device/opencl/driver_folder.h"
#include "device/opencl/opencl_executor.h"

namespace weft {
namespace {

// More than any device has; a driver that claims more would have sums of it overflow.
constexpr std::uint32_t most_compute_units = 1U << 20;
// Less does not hold the smallest image.
constexpr std::uint64_t least_allocation = std::uint64_t{1} << 20;

/// A square of two triangles in the plane z = 0, from 0 to 1, and rays from places above it to a
/// grid of targets in that plane that is half as wide again: those beside the square are missed.
struct Scene {
    static constexpr std::uint32_t side = 32;
    static constexpr std::uint32_t rays = side * side;
    static constexpr float infinity = 3.0e38F;

    std::array<shared::float4, 4> positions{shared::float4{0, 0, 0, 0}, shared::float4{1, 0, 0, 0},
                                            shared::float4{1, 1, 0, 0}, shared::float4{0, 1, 0, 0}};
    std::array<shared::Triangle, 2> triangles{};
    std::vector<shared::float4> origins, directions;

    Scene() {
        triangles[0].v1 = 1;
        triangles[0].v2 = 2;
        triangles[1].v1 = 2;
        triangles[1].v2 = 3;
        for (std::uint32_t i = 0; i < rays; ++i) {
            const float from = static_cast<float>(i) / rays;
            origins.push_back({from, 1.0F - from, 1.0F + from, infinity});
            directions.push_back({x_of(i) - from, y_of(i) - 1.0F + from, -1.0F - from, 0.0F});
        }
    }
    static float place(std::uint32_t step) {
        return 1.5F * (static_cast<float>(step) + 0.5F) / side;
    }
    static float x_of(std::uint32_t ray) { return place(ray % side); }
    static float y_of(std::uint32_t ray) { return place(ray / side); }
    /// Whether that is the hit of a ray: its target, or none.
    [[nodiscard]] static bool is_right(std::uint32_t ray, const shared::float4& hit) {
        std::uint32_t triangle = 0;
        std::memcpy(&triangle, &hit.x, sizeof(triangle));
        const float x = x_of(ray);
        const float y = y_of(ray);
        if (x > 1.0F || y > 1.0F) return triangle == INVALID_INDEX;
        // On the diagonal either may be met.
        const float off = 1e-5F;
        const bool lower = triangle == 0 && y <= x + off;
        const bool upper = triangle == 1 && y >= x - off;
        return (lower || upper) && std::abs(hit.y - 1.0F) <= off;
    }
};

std::string wrong_description(const DeviceInfo& info) {
    if (info.compute_units == 0 || info.compute_units > most_compute_units)
        return fmt::format("its driver says that it has {} compute units", info.compute_units);
    if (info.max_allocation < least_allocation || info.max_allocation > info.memory)
        return fmt::format("its driver says that a buffer may have {} bytes, of {} bytes of memory",
                           info.max_allocation, info.memory);
    return {};
}

/// Launches no work-items of a kernel: drivers compile some of it only now.
void launch_nothing(Executor& executor, const TracedScene& traced, KernelId kernel) {
    constexpr std::array<std::byte, most_argument_bytes> zeros{};
    std::vector<LaunchArgument> arguments;
    for (const ArgumentInfo& argument : kernel_arguments(kernel))
        arguments.push_back({nullptr, argument.is_value ? zeros.data() : nullptr,
                             argument.is_value ? argument.bytes : 0});
    executor.run({kernel, {}, &traced, arguments, 0}, {});
    (void)executor.take_milliseconds();
}

std::string wrong_hits(Executor& executor, const TracedScene& traced) {
    const Scene scene;
    const auto origins = upload<kinds::RayOrigins>(executor, scene.origins, "ray origins");
    const auto directions =
        upload<kinds::RayDirections>(executor, scene.directions, "ray directions");
    const std::vector<shared::float4> none(Scene::rays);
    const auto hits = upload<kinds::RayHits>(executor, none, "hits");
    run_kernel(executor, {}, kernels::query_closest{traced, origins, directions, hits},
               Scene::rays);
    (void)executor.take_milliseconds();
    const std::vector<shared::float4> found = read_buffer(executor, hits, Scene::rays);
    std::uint32_t wrong = 0;
    for (std::uint32_t i = 0; i < Scene::rays; ++i) wrong += Scene::is_right(i, found[i]) ? 0 : 1;
    if (wrong == 0) return {};
    return fmt::format("{} of {} rays hit what they should not, or nothing", wrong, Scene::rays);
}

std::string trace_rays(Executor& executor) {
    const Scene scene;
    TracedGeometry geometry;
    geometry.positions = scene.positions;
    geometry.triangles = scene.triangles;
    geometry.box_padding = 0x1p-22F;
    geometry.passing = true;
    const std::unique_ptr<TracedScene> traced = executor.make_scene(geometry);
    constexpr std::array kernels{KernelId::query_closest, KernelId::vpl_walk};
    executor.build(kernels, 0);
    // A large kernel: Mesa 22.3 ends the program here.
    launch_nothing(executor, *traced, KernelId::vpl_walk);
    return wrong_hits(executor, *traced);
}

}  // namespace

DeviceVerdict try_device(const OpenClDevice& device) {
    if (is_simulator(device.info)) return {};
    const auto first_line = [](const std::exception& error) {
        const std::string text = error.what();
        return one_line(text.substr(0, text.find('\n')));
    };
    try {
        if (std::string wrong = wrong_description(device.info); !wrong.empty())
            return {std::move(wrong), false};
        return {trace_rays(*make_opencl_executor(device, 0)), false};
    } catch (const std::bad_alloc&) {
        return {"no memory is left for it", true};
    } catch (const Error& error) {
        return {first_line(error),
                error.code() == ExitCode::out_of_memory || driver_folder_is_full()};
    } catch (const std::exception& error) {
        return {first_line(error), driver_folder_is_full()};
    }
}

}  // namespace weft
