// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/opencl_executor.h"
#include "device/launch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.h"
#include "device/opencl/program_cache.h"
#include "tests/testing/temporary_folder.h"

namespace weft::opencl_executor_test {
namespace {

namespace fs = std::filesystem;

/// Every test works with a program cache of its own, and with one lane, so that a work-item of
/// composition is a pixel.
class OpenclExecutor : public testing::Test {
  protected:
    void SetUp() override {
        if (const char* old = std::getenv("WEFT_CACHE_DIR")) old_folder_ = old;
        ::setenv("WEFT_CACHE_DIR", folder_.path().c_str(), 1);
        if (const char* old = std::getenv("WEFT_LANES")) old_lanes_ = old;
        ::setenv("WEFT_LANES", "1", 1);
        if (opencl_devices().empty()) GTEST_SKIP() << "there is no OpenCL device";
        executor_ = make();
    }
    void TearDown() override {
        if (old_lanes_.empty())
            ::unsetenv("WEFT_LANES");
        else
            ::setenv("WEFT_LANES", old_lanes_.c_str(), 1);
        if (old_folder_.empty())
            ::unsetenv("WEFT_CACHE_DIR");
        else
            ::setenv("WEFT_CACHE_DIR", old_folder_.c_str(), 1);
    }

    static std::unique_ptr<Executor> make() {
        return make_opencl_executor(choose_opencl_device(""), 0);
    }

    TemporaryFolder folder_;
    std::string old_folder_;
    std::string old_lanes_;
    std::unique_ptr<Executor> executor_;
};

/// Text and code of the Error that `action` throws.
template <class Action>
std::pair<ExitCode, std::string> failure_of(const Action& action) {
    try {
        action();
    } catch (const Error& error) {
        return {error.code(), error.what()};
    }
    return {ExitCode::success, "no error"};
}

/// The film of `items` pixels after `compose` ran over them: emission 1 is added to planes of 0, so
/// that every value counts how often its pixel was worked on.
class Counting {
  public:
    Counting(Executor& executor, std::uint32_t pixels) : executor_(executor), pixels_(pixels) {
        const std::vector<shared::float4> dark(pixels, {0.0F, 0.0F, 0.0F, 0.0F});
        const std::vector<shared::float4> bright(pixels, {1.0F, 1.0F, 1.0F, 1.0F});
        const std::vector<std::uint32_t> zeros(std::size_t{2} * pixels, 0);
        const std::vector<float> film(FILM_PLANES * FILM_STRIDE(std::size_t{pixels}), 0.0F);
        surfaces_.gb_ids = upload<kinds::SurfaceIds>(executor, zeros, "ids");
        surfaces_.gb_position = upload<kinds::SurfacePositions>(executor, dark, "positions");
        surfaces_.gb_normal = upload<kinds::SurfaceNormals>(executor, dark, "normals");
        surfaces_.gb_shading = upload<kinds::SurfaceShadingNormals>(executor, dark, "shading");
        surfaces_.gb_albedo = upload<kinds::SurfaceAlbedo>(executor, dark, "albedo");
        surfaces_.gb_emission = upload<kinds::SurfaceEmission>(executor, bright, "emission");
        light_.pixel_slot = upload<kinds::PixelSlots>(executor, zeros, "slots");
        high_ = upload<kinds::FilmHigh>(executor, film, "film");
        low_ = upload<kinds::FilmLow>(executor, film, "film");
        const shared::NonfiniteCounter none{};
        nonfinite_ = upload<kinds::NonfiniteCounters>(executor, {&none, 1}, "counters");
        const KernelId kernel = KernelId::compose;
        executor.build({&kernel, 1}, 0);
    }

    bool run(std::uint32_t items, std::uint32_t items_per_launch,
             const std::function<bool(double)>& keep_going = {}) {
        shared::RenderParams params{};
        params.camera.width = pixels_;
        params.camera.height = 1;
        params.scene.unit = 1.0F;
        params.sampling.sample = 2;  // the film holds samples that this one adds to
        return run_kernel(executor_, params,
                          kernels::compose{.surfaces = view(surfaces_),
                                           .composed = view(light_),
                                           .slots = 0U,
                                           .film_high = high_,
                                           .film_low = low_,
                                           .nonfinite = nonfinite_,
                                           .edge_masks = nullptr},
                          items, {.items_per_launch = items_per_launch}, keep_going);
    }

    /// How often each pixel was worked on.
    std::vector<float> counts() {
        (void)executor_.take_milliseconds();
        return read_buffer(executor_, high_, pixels_);
    }

  private:
    Executor& executor_;
    std::uint32_t pixels_;
    owned::SeenSurfaces surfaces_;
    owned::ComposedLight light_;  // but for slots, features that are off
    DeviceBuffer<kinds::FilmHigh> high_;
    DeviceBuffer<kinds::FilmLow> low_;
    DeviceBuffer<kinds::NonfiniteCounters> nonfinite_;
};

TEST_F(OpenclExecutor, DescribesItsDevice) {
    const DeviceInfo& info = executor_->device();
    EXPECT_EQ(info.backend, "opencl");
    EXPECT_FALSE(info.name.empty() || info.driver.empty() || info.version.empty());
    EXPECT_GE(info.index, 0);
    EXPECT_GT(info.memory, 0u);
    EXPECT_GE(info.memory, info.max_allocation);
    EXPECT_GE(info.native_width, 1u);
    EXPECT_GE(info.compute_units, 1u);
    EXPECT_TRUE(executor_->lanes() == 1 || executor_->lanes() == 4 || executor_->lanes() == 8 ||
                executor_->lanes() == 16);
}

TEST_F(OpenclExecutor, BuffersKeepWhatIsWritten) {
    for (const std::size_t count : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 20}) {
        std::vector<std::uint32_t> values(count);
        std::iota(values.begin(), values.end(), 7U);
        const auto buffer = upload<kinds::EdgePixels>(*executor_, values, "numbers");
        EXPECT_GE(buffer->bytes(), 4 * count);
        EXPECT_EQ(read_buffer<std::uint32_t>(*executor_, *buffer, count), values);
        executor_->with_mapped(*buffer, Access::write, [&](std::span<std::byte> bytes) {
            EXPECT_EQ(bytes.size(), buffer->bytes());
            std::fill(bytes.begin(), bytes.end(), std::byte{0x5a});
        });
        EXPECT_EQ(read_buffer<std::uint32_t>(*executor_, *buffer, count),
                  std::vector<std::uint32_t>(count, 0x5a5a5a5aU));
    }
}

TEST_F(OpenclExecutor, CountsItsBytes) {
    const std::size_t before = executor_->allocated_bytes();
    {
        const auto buffer = executor_->allocate(4096, "test");
        EXPECT_EQ(executor_->allocated_bytes(), before + 4096);
    }
    EXPECT_EQ(executor_->allocated_bytes(), before);
}

TEST_F(OpenclExecutor, FailuresInsideAMappingLeaveTheBufferUsable) {
    const auto buffer = upload<kinds::RaysBlocked>(*executor_, std::vector<int>(16, 3), "test");
    EXPECT_THROW(executor_->with_mapped(
                     *buffer, Access::read,
                     [](std::span<std::byte>) { throw std::runtime_error("in between"); }),
                 std::runtime_error);
    EXPECT_EQ(read_buffer<int>(*executor_, *buffer, 16), std::vector<int>(16, 3));
}

TEST_F(OpenclExecutor, TooLargeBuffersAreRefusedClearly) {
    const std::uint64_t most = executor_->device().max_allocation;
    for (const std::size_t bytes :
         {static_cast<std::size_t>(most + 1), std::numeric_limits<std::size_t>::max()}) {
        const auto [code, text] =
            failure_of([&] { (void)executor_->allocate(bytes, "a huge film"); });
        EXPECT_EQ(code, ExitCode::out_of_memory);
        EXPECT_EQ(text.find('\n'), std::string::npos);
        for (const std::string& part :
             {std::string("a huge film"), std::to_string(bytes), std::to_string(most)})
            EXPECT_NE(text.find(part), std::string::npos) << text;
    }
    EXPECT_EQ(executor_->allocated_bytes(), 0u);
}

TEST_F(OpenclExecutor, KernelsMustBeBuiltFirst) {
    const shared::RenderParams params{};
    const auto [code, text] = failure_of([&] {
        executor_->run({KernelId::compose, params, nullptr, {}, 1}, {});
    });
    EXPECT_EQ(code, ExitCode::device);
    EXPECT_EQ(text, "kernel compose was launched but not built");
}

TEST_F(OpenclExecutor, LaunchesCoverEveryItemOnce) {
    constexpr std::uint32_t pixels = 150000;
    const std::uint32_t chunk = kernel_chunk(KernelId::compose);
    ASSERT_LT(chunk, pixels);
    Counting counting(*executor_, pixels);
    std::vector<float> expected(pixels, 0.0F);
    for (const auto& [items, per_launch] :
         std::initializer_list<std::pair<std::uint32_t, std::uint32_t>>{{1, 0},
                                                                        {chunk - 1, 0},
                                                                        {chunk, 0},
                                                                        {chunk + 1, 0},
                                                                        {pixels - 5, 0},
                                                                        {1000, 7},
                                                                        {1000, 1000},
                                                                        {pixels - 5, 64001},
                                                                        {0, 0}}) {
        EXPECT_TRUE(counting.run(items, per_launch));
        for (std::uint32_t i = 0; i < items; ++i) expected[i] += 1.0F;
        ASSERT_EQ(counting.counts(), expected) << items << " items, " << per_launch;
    }
}

TEST_F(OpenclExecutor, ProgressGrowsToOne) {
    Counting counting(*executor_, 1000);
    std::vector<double> seen;
    EXPECT_TRUE(counting.run(1000, 300, [&](double done) {
        seen.push_back(done);
        return true;
    }));
    ASSERT_GE(seen.size(), 4U);
    EXPECT_GT(seen.front(), 0.0);
    EXPECT_EQ(seen.back(), 1.0);
    for (std::size_t i = 1; i < seen.size(); ++i) {
        EXPECT_GT(seen[i], seen[i - 1]);
        EXPECT_LE(seen[i], seen[i - 1] + 0.3001);
    }
}

TEST_F(OpenclExecutor, EndsEarlyWhenAsked) {
    Counting counting(*executor_, 1000);
    int asked = 0;
    double last = 0.0;
    EXPECT_FALSE(counting.run(1000, 100, [&](double done) {
        last = done;
        return ++asked < 3;
    }));
    EXPECT_EQ(asked, 3);
    const auto items = static_cast<std::size_t>(std::lround(1000.0 * last));
    EXPECT_GE(items, 3U);
    EXPECT_LE(items, 300U);
    std::vector<float> expected(1000, 0.0F);
    std::fill_n(expected.begin(), items, 1.0F);
    EXPECT_EQ(counting.counts(), expected);
    EXPECT_TRUE(counting.run(1000, 100));
}

TEST_F(OpenclExecutor, RayCountersCarryIntoTheirHighHalf) {
    // One triangle that blocks nothing, one light above, and receivers that all see it.
    const std::vector<shared::float4> positions{{5, 5, 5, 0}, {6, 5, 5, 0}, {5, 6, 5, 0}};
    const std::vector<shared::Triangle> triangles{{0, 1, 2, 0}};
    const auto scene = executor_->make_scene({positions, triangles, 1e-6F});
    constexpr std::uint32_t slots = 1600;
    std::vector<float> planes(std::size_t{7} * slots, 0.0F);
    std::fill_n(planes.begin() + 5 * slots, 2 * slots, 1.0F);  // normal +z, valid
    shared::Vpl light{};
    light.position = {0.0F, 0.0F, 1.0F, 1e30F};
    light.normal = {0.0F, 0.0F, -1.0F, 0.0F};
    const auto kind = static_cast<std::uint32_t>(VPL_POINT);
    std::memcpy(&light.normal.w, &kind, sizeof(kind));
    light.flux = {1.0F, 1.0F, 1.0F, 0.0F};
    shared::RayCounter counter{0xFFFFFF00U, 41, 0, 0};
    const auto receivers = upload<kinds::ReceiverPlanes>(*executor_, planes, "receivers");
    const std::vector<std::uint32_t> first_set(slots / PACKET_BLOCK, 0);
    const auto sets = upload<kinds::BlockSets>(*executor_, first_set, "sets");
    const auto vpls = upload<kinds::VirtualLights>(*executor_, {&light, 1}, "VPLs");
    const auto irradiance = allocate<kinds::SlotLight>(*executor_, 3 * slots, "irradiance");
    const auto counters = upload<kinds::RayCounters>(*executor_, {&counter, 1}, "counters");
    const owned::MediaTables no_media;
    const KernelId kernel = KernelId::vpl_gather;
    executor_->build({&kernel, 1}, 0);
    shared::RenderParams params{};
    params.sampling.gather_sets = 1;
    params.sampling.gather_scale = 1.0F;
    params.scene.extent = 6.0F;
    ASSERT_TRUE(run_kernel(*executor_, params,
                           kernels::vpl_gather{.scene = *scene,
                                               .media_tables = view(no_media),
                                               .list = shared::SetList{0, 0, 1},
                                               .by_chance = 0,
                                               .adds = 0,
                                               .slots = slots,
                                               .receiver_planes = receivers,
                                               .block_set = sets,
                                               .vpls = vpls,
                                               .survival = BufferRef<kinds::VplSurvival>(),
                                               .irradiance = irradiance,
                                               .counters = counters},
                           slots / executor_->lanes(), {.items_per_launch = 10}));
    EXPECT_GE(executor_->take_milliseconds(), 0.0);
    const auto found = read_buffer(*executor_, counters, 1).front();
    EXPECT_EQ(found.rays_high, 42u);
    EXPECT_EQ(found.rays_low, 0xFFFFFF00U + slots);  // wrapped around
    EXPECT_EQ(read_buffer(*executor_, irradiance, 1).front(), 1.0F);
}

/// Files of the program cache.
std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
    return files;
}

TEST_F(OpenclExecutor, ProgramsComeFromTheCacheTheNextTime) {
    Counting first(*executor_, 100);
    EXPECT_TRUE(first.run(100, 0));
    ASSERT_EQ(executor_->builds().size(), 1u);
    EXPECT_FALSE(executor_->builds()[0].from_cache);
    EXPECT_GT(executor_->builds()[0].build_ms, 0.0);
    EXPECT_NE(executor_->builds()[0].flags.find("-DWEFT_FEATURES=0u"), std::string::npos);
    ASSERT_EQ(entries(folder_.path()).size(), 1u);
    const auto again = make();
    Counting second(*again, 100);
    EXPECT_TRUE(second.run(100, 0));
    EXPECT_TRUE(again->builds().at(0).from_cache);
    EXPECT_EQ(second.counts(), first.counts());
}

TEST_F(OpenclExecutor, FeaturesAKernelDoesNotAskAboutMakeNoVariant) {
    const auto flags_of = [](KernelId kernel, std::uint32_t features) {
        const auto executor = make();
        executor->build({&kernel, 1}, features);
        return executor->builds().at(0).flags;
    };
    const std::string none = flags_of(KernelId::receivers, 0);
    EXPECT_NE(none.find("-DWEFT_FEATURES=0u"), std::string::npos) << none;
    EXPECT_EQ(flags_of(KernelId::receivers, FEATURE_INDIRECT), none);
    const std::string with = flags_of(KernelId::compose, FEATURE_INDIRECT);
    EXPECT_NE(with.find("-DWEFT_FEATURES=256u"), std::string::npos) << with;
}

TEST_F(OpenclExecutor, DamagedProgramsAreBuiltAnew) {
    Counting first(*executor_, 100);
    EXPECT_TRUE(first.run(100, 0));
    const std::vector<float> expected = first.counts();
    const std::vector<fs::path> files = entries(folder_.path());
    ASSERT_EQ(files.size(), 1u);
    const std::string key = files[0].stem();
    const ProgramCache cache(folder_.path());
    const auto good = cache.load(key);
    ASSERT_TRUE(good);
    const auto damage_file = [&](std::uintmax_t size) { fs::resize_file(files[0], size); };
    const auto forge = [&](const std::string& text) {
        cache.store(key, std::vector<unsigned char>(text.begin(), text.end()));
    };
    const std::array<std::function<void()>, 4> damages{
        [&] { damage_file(0); }, [&] { damage_file(fs::file_size(files[0]) / 2); },
        // A checksum that fits says nothing about whether the driver can use the program.
        [&] { forge("not a program at all"); }, [&] { forge(std::string(100000, '\x7f')); }};
    for (std::size_t i = 0; i < damages.size(); ++i) {
        damages[i]();
        const auto executor = make();
        Counting again(*executor, 100);
        EXPECT_TRUE(again.run(100, 0)) << i;
        EXPECT_FALSE(executor->builds().at(0).from_cache) << i;
        EXPECT_EQ(again.counts(), expected) << i;
        EXPECT_TRUE(cache.load(key)) << "case " << i << ": the entry was not mended";
    }
}

TEST_F(OpenclExecutor, WithoutAWritableCacheKernelsRun) {
    ::setenv("WEFT_CACHE_DIR", (folder_.write("file", "") / "below").c_str(), 1);
    const auto executor = make();
    Counting counting(*executor, 100);
    EXPECT_TRUE(counting.run(100, 0));
    EXPECT_EQ(counting.counts(), std::vector<float>(100, 1.0F));
}

TEST_F(OpenclExecutor, DevicesAreChosenByIndexAndName) {
    const std::vector<OpenClDevice> devices = opencl_devices();
    for (const OpenClDevice& device : devices)
        EXPECT_EQ(choose_opencl_device(std::to_string(device.info.index)).info.name,
                  device.info.name);
    const std::string name = devices.front().info.name;
    EXPECT_EQ(choose_opencl_device(name).info.index, 0);
    EXPECT_EQ(choose_opencl_device(name.substr(1, 3)).info.backend, "opencl");
    for (const std::string& wrong : {std::to_string(devices.size()), std::string("no such name"),
                                     std::string("99999999999999999999")}) {
        const auto [code, text] = failure_of([&] { (void)choose_opencl_device(wrong); });
        EXPECT_EQ(code, ExitCode::device);
        EXPECT_NE(text.find(wrong), std::string::npos);
        EXPECT_NE(text.find(name), std::string::npos) << text;
    }
}

}  // namespace
}  // namespace weft::opencl_executor_test

#endif
