// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/native/native_executor.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <optional>
#include <thread>
#include <utility>

#include "base/cache_folder.h"
#include "base/error.h"
#include "base/large_memory.h"
#include "base/require_memory.h"
#include "base/stopwatch.h"
#include "bvh/moving_bvh.h"
#include "device/kernel_signature.h"
#include "device/launch_pacer.h"
#include "device/native/embree_scene.h"
#include "device/native/native_scene.h"
#include "device/native/native_variants.h"

namespace weft {
namespace {

class NativeBuffer : public Buffer {
  public:
    NativeBuffer(std::size_t bytes, std::size_t& total)
        : Buffer(bytes), memory_(bytes), total_(total) {
        total_ += bytes;
    }
    ~NativeBuffer() override { total_ -= bytes(); }
    NativeBuffer(const NativeBuffer&) = delete;
    NativeBuffer& operator=(const NativeBuffer&) = delete;

    [[nodiscard]] void* data() const noexcept { return memory_.data(); }

  private:
    LargeMemory memory_;
    std::size_t& total_;
};

class NativeTracedScene : public TracedScene {
  public:
    TracedGeometry geometry;
    std::unique_ptr<EmbreeScene> embree;
    mutable NativeScene view;      ///< kernels take pointers to what they only read
    std::optional<MovingBvh> own;  ///< used where Embree is not

    void build_own_bvh(const BvhCache& cache) {
        BvhSettings settings;
        settings.padding = geometry.box_padding;
        settings.spatial_splits = !geometry.passing;
        own.emplace(geometry.positions, geometry.triangles, geometry.first_moving, settings,
                    geometry.passing ? nullptr : &cache,
                    geometry.soon ? BvhEffort::soon : BvhEffort::best);
        view_own_bvh();
    }
    void update() {
        if (embree) {
            embree->update(geometry);
        } else {
            own->update(geometry.positions, geometry.triangles, geometry.box_padding);
            view_own_bvh();
        }
    }

  private:
    void view_own_bvh() {
        view.bvh_nodes = own->bvh().nodes.data();
        view.bvh_leaves = own->bvh().leaves.data();
    }
};

std::string processor_name() {
    std::ifstream info("/proc/cpuinfo");
    std::string line;
    while (std::getline(info, line))
        if (line.starts_with("model name")) {
            const auto colon = line.find(": ");
            if (colon != std::string::npos) return line.substr(colon + 2);
        }
    return "host processor";
}

class NativeExecutor : public Executor {
  public:
    NativeExecutor(NativeTraversal traversal, int threads, std::uint32_t lanes)
        : traversal_(traversal),
          threads_(threads),
          variant_(choose_variant(lanes)),
          device_(native_device_info(traversal, lanes)),
          arena_(threads > 0 ? threads : tbb::task_arena::automatic),
          pacer_(static_cast<std::uint32_t>(arena_.max_concurrency())) {
        device_.compute_units = static_cast<std::uint32_t>(arena_.max_concurrency());
        require_memory(arena_memory);
        arena_.initialize();
    }

    [[nodiscard]] const DeviceInfo& device() const override { return device_; }
    [[nodiscard]] std::uint32_t lanes() const override { return variant_.lanes; }

    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                   std::string_view what) override {
        try {
            return std::make_unique<NativeBuffer>(bytes, allocated_);
        } catch (const std::bad_alloc&) {
            throw Error(ExitCode::out_of_memory,
                        fmt::format("no memory for {} ({} bytes)", what, bytes));
        }
    }

    void with_mapped(Buffer& buffer, Access,
                     const std::function<void(std::span<std::byte>)>& use) override {
        auto& memory = dynamic_cast<NativeBuffer&>(buffer);
        use({static_cast<std::byte*>(memory.data()), memory.bytes()});
    }

    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override {
        const Stopwatch watch;
        auto scene = std::make_unique<NativeTracedScene>();
        scene->geometry = geometry;
        scene->view.positions = geometry.positions.data();
        scene->view.triangles = geometry.triangles.data();
        arena_.execute([&] {
            if (traversal_ == NativeTraversal::embree) {
                scene->embree = std::make_unique<EmbreeScene>(geometry, threads_);
                scene->view.embree = scene->embree.get();
            } else {
                scene->build_own_bvh(bvh_cache_);
            }
        });
        if (geometry.passing || geometry.further) return scene;
        scene_ms_ = watch.total();
        bvh_.reset();
        if (scene->own) bvh_ = stats_of(scene->own->bvh());
        return scene;
    }

    void update_scene(TracedScene& scene, const TracedGeometry& geometry) override {
        const Stopwatch watch;
        auto& updated = dynamic_cast<NativeTracedScene&>(scene);
        check_update(updated.geometry, geometry);
        updated.geometry = geometry;
        arena_.execute([&] { updated.update(); });
        if (geometry.further) return;
        scene_ms_ += watch.total();
        if (updated.own) bvh_ = stats_of(updated.own->bvh());
    }

    void build(std::span<const KernelId> kernels, std::uint32_t features) override {
        for (const KernelId kernel : kernels) {
            const auto is_known = [&](const KernelBuild& known) {
                return known.use.kernel == kernel && known.use.features == features;
            };
            if (std::ranges::any_of(builds_, is_known)) continue;
            builds_.push_back({std::string(kernel_name(kernel)),
                               fmt::format("{} lanes {}", variant_.isa, variant_.lanes),
                               0.0,
                               true,
                               {kernel, features}});
        }
    }

    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override;

    double take_milliseconds() override { return std::exchange(milliseconds_, 0.0); }
    [[nodiscard]] const std::vector<KernelBuild>& builds() const override { return builds_; }
    [[nodiscard]] const BvhStats* bvh() const override { return bvh_ ? &*bvh_ : nullptr; }
    [[nodiscard]] double scene_ms() const override { return scene_ms_; }
    [[nodiscard]] std::size_t allocated_bytes() const override { return allocated_; }

  private:
    [[nodiscard]] std::vector<const void*> bind(const Launch& launch,
                                                const shared::LaunchRange& range) const;

    NativeTraversal traversal_;
    int threads_;
    NativeVariant variant_;
    DeviceInfo device_;
    tbb::task_arena arena_;
    LaunchPacer pacer_;
    BvhCache bvh_cache_{default_cache_folder()};
    std::size_t allocated_ = 0;
    std::vector<KernelBuild> builds_;
    std::optional<BvhStats> bvh_;
    double milliseconds_ = 0.0;
    double scene_ms_ = 0.0;
};

std::vector<const void*> NativeExecutor::bind(const Launch& launch,
                                              const shared::LaunchRange& range) const {
    // Passed for buffers that a launch does not use, so that kernels need not check for null.
    static const std::array<shared::float4, 4> unused{};
    check_arguments(launch);
    std::vector<const void*> arguments{&launch.params, &range};
    if (launch.scene != nullptr)
        arguments.push_back(&dynamic_cast<const NativeTracedScene&>(*launch.scene).view);
    for (const LaunchArgument& argument : launch.arguments) {
        if (argument.value != nullptr)
            arguments.push_back(argument.value);
        else if (argument.buffer != nullptr)
            arguments.push_back(dynamic_cast<const NativeBuffer&>(*argument.buffer).data());
        else
            arguments.push_back(unused.data());
    }
    return arguments;
}

bool NativeExecutor::run(const Launch& launch, const std::function<bool(double)>& keep_going) {
    const NativeKernel& kernel = variant_.kernels[static_cast<std::size_t>(launch.kernel)];
    const LaunchOptions& options = launch.options;
    shared::LaunchRange range{0, 0, options.counter, 1};
    const std::vector<const void*> arguments = bind(launch, range);
    const std::uint32_t chunk =
        options.items_per_launch > 0 ? options.items_per_launch : kernel_chunk(launch.kernel);
    const Stopwatch watch;
    bool complete = true;
    for (std::uint32_t first = 0; first < launch.items;) {
        range.first = options.first_item + first;
        range.count = std::min(pacer_.items(launch.kernel, chunk), launch.items - first);
        // Few ranges per thread keep the scheduler's cost small; a work-item of a packet kernel is
        // itself some thousand rays.
        const std::uint32_t grain = std::max<std::uint32_t>(1, range.count / 256);
        const Stopwatch of_launch;
        arena_.execute([&] {
            tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, range.count, grain),
                              [&](const tbb::blocked_range<std::uint32_t>& items) {
                                  kernel.run(arguments.data(), items.begin(), items.end());
                              });
        });
        pacer_.took(launch.kernel, chunk, range.count, of_launch.total());
        first += range.count;
        const double done = static_cast<double>(first) / launch.items;
        if (keep_going && !keep_going(done)) {
            complete = false;
            break;
        }
    }
    const double ms = watch.total();
    milliseconds_ += ms;
    if (options.milliseconds != nullptr) *options.milliseconds += ms;
    return complete;
}

}  // namespace

DeviceInfo native_device_info(NativeTraversal traversal, std::uint32_t lanes) {
    const NativeVariant variant = choose_variant(lanes);
    DeviceInfo device;
    device.backend = traversal == NativeTraversal::embree ? "embree" : "native";
    device.name = processor_name();
    device.driver = traversal == NativeTraversal::embree ? "Embree " + embree_version()
                                                         : "kernels compiled natively";
    device.version = fmt::format("{}, {} lanes", variant.isa, variant.lanes);
    device.memory = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
                    static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
    device.max_allocation = device.memory;
    device.native_width = choose_variant(0).lanes;
    device.compute_units = std::max(1U, std::thread::hardware_concurrency());
    return device;
}

std::unique_ptr<Executor> make_native_executor(NativeTraversal traversal, int threads,
                                               std::uint32_t lanes) {
    return std::make_unique<NativeExecutor>(traversal, threads, lanes);
}

}  // namespace weft
