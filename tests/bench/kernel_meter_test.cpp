// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/kernels/kernel_meter.h"

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <utility>
#include <vector>

#include "bench/kernels/kernel_frames.h"
#include "tests/testing/render_fixture.h"
#include "tests/testing/smoky_room.h"

namespace weft::bench::kernel_meter_test {
namespace {

using test::TestBackend;

class FakeBuffer : public Buffer {
  public:
    explicit FakeBuffer(std::size_t bytes) : Buffer(bytes) {}
};

/// Cuts everything into launches of ten items, each of which takes a quarter of a millisecond, and
/// tells of them only when asked, as devices do.
class LateExecutor : public Executor {
  public:
    [[nodiscard]] const DeviceInfo& device() const override { return device_; }
    [[nodiscard]] std::uint32_t lanes() const override { return 1; }
    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes, std::string_view) override {
        return std::make_unique<FakeBuffer>(bytes);
    }
    void with_mapped(Buffer&, Access, const std::function<void(std::span<std::byte>)>&) override {}
    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry&) override {
        return nullptr;
    }
    void update_scene(TracedScene&, const TracedGeometry&) override {}
    void build(std::span<const KernelId>, std::uint32_t) override {}
    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override {
        for (std::uint32_t first = 0; first < launch.items; first += 10) {
            late_.push_back(launch.options.milliseconds);
            if (keep_going && !keep_going(1.0)) return false;
        }
        return true;
    }
    double take_milliseconds() override {
        double sum = 0.0;
        for (double* const place : std::exchange(late_, {})) {
            sum += 0.25;
            if (place != nullptr) *place += 0.25;
        }
        return sum;
    }
    [[nodiscard]] const std::vector<KernelBuild>& builds() const override { return builds_; }
    [[nodiscard]] double scene_ms() const override { return 0.0; }
    [[nodiscard]] std::size_t allocated_bytes() const override { return 0; }

  private:
    DeviceInfo device_;
    std::vector<KernelBuild> builds_;
    std::vector<double*> late_;
};

TEST(KernelMeter, CountsWhatItIsGiven) {
    LateExecutor inner;
    KernelMeter meter(inner);
    const shared::RenderParams params{};
    FakeBuffer large(1000);
    FakeBuffer small(24);
    const float value = 1.0F;
    const std::array<LaunchArgument, 4> twice{{{.buffer = &large},
                                               {.buffer = &small},
                                               {.buffer = &large},
                                               {.value = &value, .bytes = 4}}};
    const std::array<LaunchArgument, 1> once{{{.buffer = &small}}};
    double gather = 1.0;
    EXPECT_TRUE(meter.run(
        {KernelId::vpl_gather, params, nullptr, twice, 25, {.milliseconds = &gather}}, {}));
    EXPECT_TRUE(meter.run({KernelId::compose, params, nullptr, once, 10}, {}));
    double again = 0.0;
    int asked = 0;
    EXPECT_FALSE(
        meter.run({KernelId::vpl_gather, params, nullptr, once, 100, {.milliseconds = &again}},
                  [&](double) { return ++asked < 2; }));
    EXPECT_EQ(gather, 1.0);  // the device has not told yet
    EXPECT_EQ(meter.take_milliseconds(), 0.25 * (3 + 1 + 2));
    EXPECT_EQ(gather, 1.0 + 0.25 * 3);
    EXPECT_EQ(again, 0.25 * 2);
    EXPECT_EQ(meter.take_milliseconds(), 0.0);
    EXPECT_EQ(gather, 1.0 + 0.25 * 3);  // and not twice
    meter.with_mapped(large, Access::read, {});
    meter.with_mapped(small, Access::write, {});
    meter.with_mapped(small, Access::write, {});

    const Metered metered = meter.take();
    EXPECT_EQ(metered.read_bytes, 1000U);
    EXPECT_EQ(metered.written_bytes, 48U);
    ASSERT_EQ(metered.runs.size(), 3U);
    const std::vector<KernelUse> uses = by_kernel(metered.runs);
    ASSERT_EQ(uses.size(), 2U);
    EXPECT_EQ(uses[0].kernel, KernelId::vpl_gather);
    EXPECT_EQ(uses[0].launches, 5U);
    EXPECT_EQ(uses[0].items, 125U);
    EXPECT_EQ(uses[0].bound_bytes, 1024U + 24U);
    EXPECT_EQ(uses[0].ms, 0.25 * 5);
    EXPECT_EQ(uses[1].kernel, KernelId::compose);
    EXPECT_EQ(uses[1].launches, 1U);
    EXPECT_TRUE(meter.take().runs.empty());
}

TEST(KernelMeter, RaysFollowTheOrderOfStages) {
    FrameStats frame;
    frame.stages = {{Stage::primary_rays, "", 2.0, 5, 0},
                    {Stage::scheduling, "", 7.0, 0, 0},
                    {Stage::vpl_gather, "", 3.0, 11, 0}};
    frame.rays = 16;
    std::vector<KernelUse> runs(2);
    runs[0].ms = 2.0;
    runs[1].ms = 3.0;
    EXPECT_TRUE(add_rays(frame, runs));
    EXPECT_EQ(runs[0].rays, 5U);
    EXPECT_EQ(runs[1].rays, 11U);
    runs[1].ms = 4.0;  // no stage took that long
    EXPECT_FALSE(add_rays(frame, runs));
    runs.resize(1);  // rays without a run
    EXPECT_FALSE(add_rays(frame, runs));
}

struct Sums {
    double ms = 0.0;
    std::uint64_t rays = 0;
};

Sums stages_of(const FrameStats& frame, Stage wanted) {
    Sums sums;
    for (const StageStats& stage : frame.stages)
        if (stage.stage == wanted) sums = {sums.ms + stage.ms, sums.rays + stage.rays};
    return sums;
}

Sums uses_of(const std::vector<KernelUse>& uses, KernelId kernel) {
    for (const KernelUse& use : uses)
        if (use.kernel == kernel) return {use.ms, use.rays};
    return {};
}

TEST(KernelMeter, AFrameIsTheSameThroughIt) {
    const Scene scene = test::foggy_room().scene;
    const Camera camera = test::room_camera();
    for (const TestBackend backend : test::backends()) {
        SCOPED_TRACE(test::backend_name(backend));
        for (const Algorithm algorithm : {Algorithm::ais, Algorithm::ic}) {
            const RenderSettings settings = selftest::small_settings(algorithm, 40, 32);
            const selftest::Rendering plain = test::render(backend, scene, camera, settings);
            KernelMeter meter(test::shared_executor(backend));
            const selftest::Rendering metered = test::render(meter, scene, camera, settings);
            EXPECT_EQ(selftest::differing_values(plain.image, metered.image), 0U);
            const FrameStats& frame = metered.stats.front();
            EXPECT_EQ(frame.rays, plain.stats.front().rays);

            std::vector<KernelUse> runs = meter.take().runs;
            ASSERT_TRUE(add_rays(frame, runs));
            const std::vector<KernelUse> uses = by_kernel(runs);
            std::uint64_t rays = 0;
            for (const KernelUse& use : uses) {
                rays += use.rays;
                EXPECT_GE(use.launches, 1U) << kernel_name(use.kernel);
                EXPECT_GE(use.items, use.launches) << kernel_name(use.kernel);
                EXPECT_GT(use.bound_bytes, 0U) << kernel_name(use.kernel);
            }
            EXPECT_EQ(rays, frame.rays);
            // Kernels that one stage alone runs, and every run of which is one of that stage.
            for (const auto& [kernel, stage] : {std::pair{KernelId::gbuffer, Stage::primary_rays},
                                                std::pair{KernelId::compose, Stage::composition}}) {
                const Sums of_kernel = uses_of(uses, kernel);
                const Sums of_stage = stages_of(frame, stage);
                EXPECT_GT(of_kernel.ms, 0.0) << stage_name(stage);
                EXPECT_DOUBLE_EQ(of_kernel.ms, of_stage.ms) << stage_name(stage);
                EXPECT_EQ(of_kernel.rays, of_stage.rays) << stage_name(stage);
            }
            EXPECT_EQ(uses_of(uses, KernelId::gbuffer).rays, 40U * 32U);
        }
    }
}

TEST(KernelMeter, BackendsTakeTurns) {
    Scene scene = test::foggy_room().scene;
    const FlatScene flat = flatten(scene);
    const std::vector<MeteredBackend> backends{
        {"native", test::shared_executor(TestBackend::own_bvh)},
        {"embree", test::shared_executor(TestBackend::embree)}};
    const std::vector<MeteredMethod> methods{{"igi", Algorithm::igi}, {"path", Algorithm::path}};
    const MeteredScene metered = meter_scene("room", flat, test::room_camera(), backends, methods,
                                             {.size = 24, .repetitions = 2, .path_samples = 3});
    ASSERT_EQ(metered.structures.size(), 2U);
    EXPECT_TRUE(metered.structures[0].bytes.has_value());
    EXPECT_FALSE(metered.structures[1].bytes.has_value());  // Embree does not say
    ASSERT_EQ(metered.methods.size(), 2U);
    for (const MethodOnBackends& method : metered.methods) {
        ASSERT_EQ(method.backends.size(), 2U);
        for (const BackendFrames& backend : method.backends) {
            ASSERT_EQ(backend.frames.size(), 2U) << backend.backend;
            for (const MeteredFrame& frame : backend.frames) {
                EXPECT_TRUE(frame.rays_of_kernels_known);
                EXPECT_GT(frame.rays, 24U * 24U);
                double of_stages = 0.0;
                for (const StageStats& stage : frame.stages) of_stages += stage.ms;
                EXPECT_GT(frame.device_ms, 0.0);
                // Stages are the kernels and what the host does between them.
                EXPECT_GE(of_stages, frame.device_ms * (1.0 - 1e-12));
                EXPECT_LE(of_stages, frame.timing.wall_ms);
            }
            EXPECT_EQ(backend.frames[0].rays, backend.frames[1].rays);
        }
    }
    // An image of `path` is all of its samples, in however many frames.
    const MeteredFrame& image = metered.methods[1].backends[0].frames.front();
    ASSERT_EQ(image.kernels.size(), 1U);
    EXPECT_GE(image.kernels[0].items, 24U * 24U);
    EXPECT_EQ(image.kernels[0].rays, image.rays);
}

}  // namespace
}  // namespace weft::bench::kernel_meter_test
