// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/opencl_executor.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <deque>
#include <functional>
#include <map>
#include <new>
#include <numeric>
#include <optional>

#include "base/error.h"
#include "base/stopwatch.h"
#include "bvh/moving_bvh.h"
#include "device/kernel_signature.h"
#include "device/launch_pacer.h"
#include "device/opencl/compile_ahead.h"
#include "device/opencl/compile_history.h"
#include "device/opencl/group_spread.h"
#include "device/opencl/opencl_buffer.h"
#include "device/opencl/opencl_program.h"
#include "device/opencl/silenced_errors.h"

namespace weft {
namespace {

/// Launches that may wait in the queue: enough to keep the device busy, few enough that an
/// interrupted run ends soon.
constexpr std::size_t launches_ahead = 2;
/// A device with thousands of lanes needs larger launches to be busy.
constexpr std::uint32_t gpu_chunk_factor = 16;
/// Index of the argument `range`, which follows `params`.
constexpr cl_uint range_argument = 1;

class OpenClTracedScene : public TracedScene {
  public:
    TracedGeometry geometry;
    std::optional<MovingBvh> bvh;  ///< kept where triangles may move
    std::unique_ptr<Buffer> nodes;
    std::unique_ptr<Buffer> leaves;
    bool resting_on_device = false;  ///< both hold the part of the BVH that updates leave alone
};

template <class T>
std::span<const std::byte> bytes_of(const LargeVector<T>& values) noexcept {
    return std::as_bytes(std::span(values));
}

/// Bytes of the nodes, or leaves, that updates leave alone, except for the root.
std::size_t resting_node_bytes(const MovingBvh& bvh) noexcept {
    return bvh.resting_nodes() * sizeof(shared::BvhNode);
}
std::size_t resting_leaf_bytes(const MovingBvh& bvh) noexcept {
    return bvh.resting_floats() * sizeof(float);
}

std::uint32_t default_lanes(const DeviceInfo& device) {
    if (!device.is_cpu) return 1;
    return device.native_width >= 16 ? 16 : device.native_width >= 8 ? 8 : 4;
}

class OpenClExecutor : public Executor {
  public:
    OpenClExecutor(const OpenClDevice& device, int threads)
        : info_(device.info),
          device_(device.device),
          context_(device_),
          queue_(context_, device_, CL_QUEUE_PROFILING_ENABLE),
          cache_(default_cache_folder()),
          bvh_cache_(default_cache_folder()),
          arena_(threads > 0 ? threads : tbb::task_arena::automatic) {
        const std::uint32_t wanted = lanes_from_environment();
        settings_.lanes = wanted > 0 ? wanted : default_lanes(info_);
        settings_.local_size = info_.is_cpu ? 8 : 64;
        settings_.chunk_factor = info_.is_cpu ? 1 : gpu_chunk_factor;
        // Processors take one item in each group; other devices need whole groups.
        pacer_ = LaunchPacer(info_.is_cpu ? info_.compute_units
                                          : settings_.local_size * info_.compute_units);
    }

    [[nodiscard]] const DeviceInfo& device() const override { return info_; }
    [[nodiscard]] std::uint32_t lanes() const override { return settings_.lanes; }

    [[nodiscard]] std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                   std::string_view what) override {
        if (bytes > info_.max_allocation)
            throw Error(ExitCode::out_of_memory,
                        fmt::format("{} needs {} bytes, {} allows {} in one buffer", what, bytes,
                                    info_.name, info_.max_allocation));
        try {
            return std::make_unique<OpenClBuffer>(context_, queue_, info_, bytes, allocated_);
        } catch (const cl::Error& error) {
            rethrow(error, fmt::format("allocating {} ({} bytes)", what, bytes));
        } catch (const std::bad_alloc&) {
            throw Error(ExitCode::out_of_memory,
                        fmt::format("no memory is left for {} ({} bytes)", what, bytes));
        }
    }

    void with_mapped(Buffer& buffer, Access access,
                     const std::function<void(std::span<std::byte>)>& use) override;
    [[nodiscard]] std::unique_ptr<TracedScene> make_scene(const TracedGeometry& geometry) override;
    void update_scene(TracedScene& scene, const TracedGeometry& geometry) override;
    void compile(std::span<const KernelUse> uses) override;
    void watch_builds(const std::function<void(const BuildProgress&)>& watch) override {
        watch_ = watch;
    }
    void build(std::span<const KernelId> kernels, std::uint32_t features) override;
    bool run(const Launch& launch, const std::function<bool(double)>& keep_going) override;
    double take_milliseconds() override;

    [[nodiscard]] const std::vector<KernelBuild>& builds() const override {
        builds_.clear();
        for (const auto& [key, program] : programs_) builds_.push_back(program.build());
        return builds_;
    }
    [[nodiscard]] const BvhStats* bvh() const override { return bvh_ ? &*bvh_ : nullptr; }
    [[nodiscard]] double scene_ms() const override { return scene_ms_; }
    [[nodiscard]] std::size_t allocated_bytes() const override { return allocated_; }

  private:
    /// with_mapped for memory that the host does not reach.
    void with_copied(const cl::Buffer& memory, std::size_t bytes, Access access,
                     const std::function<void(std::span<std::byte>)>& use);
    /// Number of processes that may compile at the same time.
    [[nodiscard]] std::uint32_t processes() const {
        return static_cast<std::uint32_t>(arena_.max_concurrency());
    }
    [[nodiscard]] ProgramRecipe recipe_of(const KernelUse& use) const;
    [[nodiscard]] CompileTimes compile_in_parallel(const std::vector<ProgramRecipe>& recipes,
                                                   CompileHistory& history);
    void upload_bvh(OpenClTracedScene& scene);
    [[nodiscard]] std::unique_ptr<Buffer> upload_with_room(std::span<const std::byte> bytes,
                                                           std::size_t resting,
                                                           std::string_view what);
    void write_part(Buffer& buffer, std::span<const std::byte> bytes, std::size_t from);

    /// A launch that may still run, and where its time will be added.
    struct InFlight {
        cl::Event event;
        double* milliseconds;
        KernelId kernel;
        std::uint32_t most_items, items;
    };

    /// Sets all arguments of a kernel but its range.
    void bind(cl::Kernel& kernel, const Launch& launch);
    cl::Event enqueue(cl::Kernel& kernel, KernelId id, shared::LaunchRange range);
    /// Passed for buffers that a launch does not use, so that kernels need not check for null.
    [[nodiscard]] const cl::Buffer& unused();
    void retire_oldest();

    DeviceInfo info_;
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    ProgramCache cache_;
    BvhCache bvh_cache_;
    tbb::task_arena arena_;
    cl::Buffer unused_;
    ProgramSettings settings_;
    /// By kernel and the features of the frames it was built for.
    std::map<std::pair<KernelId, std::uint32_t>, OpenClProgram> programs_;
    mutable std::vector<KernelBuild> builds_;
    std::deque<InFlight> in_flight_;
    LaunchPacer pacer_{1};
    std::optional<BvhStats> bvh_;
    std::function<void(const BuildProgress&)> watch_;
    double milliseconds_ = 0.0;
    double scene_ms_ = 0.0;
    std::size_t allocated_ = 0;
};

void OpenClExecutor::with_mapped(Buffer& buffer, Access access,
                                 const std::function<void(std::span<std::byte>)>& use) {
    const cl::Buffer& memory = memory_of(buffer);
    if (!info_.maps_memory) return with_copied(memory, buffer.bytes(), access, use);
    try {
        const cl_map_flags flags =
            access == Access::read ? CL_MAP_READ : CL_MAP_WRITE_INVALIDATE_REGION;
        void* const data = queue_.enqueueMapBuffer(memory, CL_TRUE, flags, 0, buffer.bytes());
        try {
            use({static_cast<std::byte*>(data), buffer.bytes()});
        } catch (...) {
            queue_.enqueueUnmapMemObject(memory, data);
            queue_.finish();
            throw;
        }
        // Later launches see the bytes, because the queue keeps its order.
        queue_.enqueueUnmapMemObject(memory, data);
    } catch (const cl::Error& error) {
        rethrow(error, "mapping a buffer");
    }
}

void OpenClExecutor::with_copied(const cl::Buffer& memory, std::size_t bytes, Access access,
                                 const std::function<void(std::span<std::byte>)>& use) {
    try {
        LargeVector<std::byte> copy(bytes);
        if (access == Access::read)
            queue_.enqueueReadBuffer(memory, CL_TRUE, 0, bytes, copy.data());
        use(copy);
        if (access == Access::write)
            queue_.enqueueWriteBuffer(memory, CL_TRUE, 0, bytes, copy.data());
    } catch (const cl::Error& error) {
        rethrow(error, "copying a buffer");
    }
}

std::unique_ptr<TracedScene> OpenClExecutor::make_scene(const TracedGeometry& geometry) {
    const Stopwatch watch;
    auto scene = std::make_unique<OpenClTracedScene>();
    scene->geometry = geometry;
    BvhSettings settings;
    settings.padding = geometry.box_padding;
    settings.spatial_splits = !geometry.passing;
    const std::optional<BvhStats> before = bvh_;
    arena_.execute([&] {
        scene->bvh.emplace(geometry.positions, geometry.triangles, geometry.first_moving, settings,
                           geometry.passing ? nullptr : &bvh_cache_,
                           geometry.soon ? BvhEffort::soon : BvhEffort::best);
    });
    upload_bvh(*scene);
    if (!scene->bvh->moves()) scene->bvh.reset();
    if (geometry.passing || geometry.further)
        bvh_ = before;
    else
        scene_ms_ = watch.total();
    return scene;
}

void OpenClExecutor::update_scene(TracedScene& scene, const TracedGeometry& geometry) {
    const Stopwatch watch;
    auto& updated = dynamic_cast<OpenClTracedScene&>(scene);
    check_update(updated.geometry, geometry);
    if (!updated.bvh) return;
    const std::optional<BvhStats> before = bvh_;
    arena_.execute([&] {
        if (updated.bvh->update(geometry.positions, geometry.triangles, geometry.box_padding))
            updated.resting_on_device = false;
    });
    const auto nodes = bytes_of(updated.bvh->bvh().nodes);
    const auto leaves = bytes_of(updated.bvh->bvh().leaves);
    try {
        if (!updated.resting_on_device || nodes.size() > updated.nodes->bytes() ||
            leaves.size() > updated.leaves->bytes()) {
            queue_.finish();  // launches under way read memory that the old buffers own
            upload_bvh(updated);
        } else {
            write_part(*updated.nodes, nodes.first(sizeof(shared::BvhNode)), 0);
            write_part(*updated.nodes, nodes, resting_node_bytes(*updated.bvh));
            write_part(*updated.leaves, leaves, resting_leaf_bytes(*updated.bvh));
        }
    } catch (const cl::Error& error) {
        rethrow(error, "updating the BVH");
    }
    bvh_ = geometry.further ? before : std::optional(stats_of(updated.bvh->bvh()));
    if (!geometry.further) scene_ms_ += watch.total();
}

void OpenClExecutor::upload_bvh(OpenClTracedScene& scene) {
    const WideBvh& bvh = scene.bvh->bvh();
    auto nodes = upload_with_room(bytes_of(bvh.nodes), resting_node_bytes(*scene.bvh), "BVH nodes");
    scene.leaves =
        upload_with_room(bytes_of(bvh.leaves), resting_leaf_bytes(*scene.bvh), "BVH leaves");
    scene.nodes = std::move(nodes);
    scene.resting_on_device = true;
    bvh_ = stats_of(bvh);
}

/// Allocates a buffer that holds `bytes`, and has room for twice as many of those behind the first
/// `resting`.
std::unique_ptr<Buffer> OpenClExecutor::upload_with_room(std::span<const std::byte> bytes,
                                                         std::size_t resting,
                                                         std::string_view what) {
    const std::size_t wanted = bytes.size() + (bytes.size() - resting);
    const auto most = static_cast<std::size_t>(info_.max_allocation);
    auto buffer = allocate(std::max(bytes.size(), std::min(wanted, most)), what);
    write_buffer(*this, *buffer, bytes);
    return buffer;
}

/// Writes `bytes` from `from` on, after all earlier launches.
void OpenClExecutor::write_part(Buffer& buffer, std::span<const std::byte> bytes,
                                std::size_t from) {
    if (from < bytes.size())
        queue_.enqueueWriteBuffer(memory_of(buffer), CL_TRUE, from, bytes.size() - from,
                                  bytes.data() + from);
}

ProgramRecipe OpenClExecutor::recipe_of(const KernelUse& use) const {
    try {
        return program_recipe(device_, use.kernel, settings_, use.features);
    } catch (const cl::Error& error) {
        rethrow(error, fmt::format("building kernel {}", kernel_name(use.kernel)));
    }
}

void OpenClExecutor::compile(std::span<const KernelUse> uses) {
    std::vector<ProgramRecipe> recipes;
    for (const KernelUse& use : uses) recipes.push_back(recipe_of(use));
    CompileHistory history(cache_.folder(), info_);
    (void)compile_in_parallel(recipes, history);
}

CompileTimes OpenClExecutor::compile_in_parallel(const std::vector<ProgramRecipe>& recipes,
                                                 CompileHistory& history) {
    const auto tell = [this](std::size_t programs, double left_ms) { watch_({programs, left_ms}); };
    CompileTimes times = compile_ahead(recipes, info_, cache_, processes(), history,
                                       watch_ ? CompileWatch(tell) : CompileWatch());
    history.store();
    return times;
}

void OpenClExecutor::build(std::span<const KernelId> kernels, std::uint32_t features) {
    std::vector<KernelId> missing;
    std::vector<ProgramRecipe> recipes;
    for (const KernelId kernel : kernels) {
        if (programs_.contains({kernel, features})) continue;
        recipes.push_back(recipe_of({kernel, features}));
        missing.push_back(kernel);
    }
    CompileHistory history(cache_.folder(), info_);
    const CompileTimes compiled = compile_in_parallel(recipes, history);
    // What is left has to be compiled here, one after the other. These times are not kept: drivers
    // may leave a part of the work to the first launch.
    std::vector<double> expected;
    for (const ProgramRecipe& recipe : recipes)
        expected.push_back(cache_.contains(recipe.key) ? 0.0 : history.expected_ms(recipe));
    double left_ms = std::accumulate(expected.begin(), expected.end(), 0.0);
    const auto count = static_cast<std::size_t>(
        std::count_if(expected.begin(), expected.end(), [](double ms) { return ms > 0.0; }));
    for (std::size_t i = 0; i < missing.size(); ++i) {
        const KernelUse use{missing[i], features};
        if (watch_ && expected[i] > 0.0) watch_({count, left_ms});
        left_ms -= expected[i];
        try {
            programs_.try_emplace({use.kernel, features}, context_, device_, cache_, use,
                                  recipes[i], compiled[i]);
        } catch (const cl::Error& error) {
            rethrow(error, fmt::format("building kernel {}", kernel_name(use.kernel)));
        }
    }
}

const cl::Buffer& OpenClExecutor::unused() {
    constexpr std::size_t bytes = 64;
    if (unused_() == nullptr) unused_ = cl::Buffer(context_, CL_MEM_READ_WRITE, bytes);
    return unused_;
}

void OpenClExecutor::bind(cl::Kernel& kernel, const Launch& launch) {
    check_arguments(launch);
    cl_uint index = 0;
    kernel.setArg(index, sizeof(launch.params), &launch.params);
    index = range_argument + 1;
    if (launch.scene != nullptr) {
        const auto& scene = dynamic_cast<const OpenClTracedScene&>(*launch.scene);
        kernel.setArg(index++, memory_of(*scene.nodes));
        kernel.setArg(index++, memory_of(*scene.leaves));
    }
    for (const LaunchArgument& argument : launch.arguments) {
        if (argument.value != nullptr)
            kernel.setArg(index++, argument.bytes, argument.value);
        else
            kernel.setArg(index++,
                          argument.buffer != nullptr ? memory_of(*argument.buffer) : unused());
    }
}

cl::Event OpenClExecutor::enqueue(cl::Kernel& kernel, KernelId id, shared::LaunchRange range) {
    const std::uint32_t groups =
        busy_groups(launch_size(id, settings_) / settings_.local_size, range.count);
    const std::uint32_t size = groups * settings_.local_size;
    range.spread = range.count <= groups || range.count == size ? 1 : group_spread(groups);
    kernel.setArg(range_argument, sizeof(range), &range);
    cl::Event event;
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(size),
                                cl::NDRange(settings_.local_size), nullptr, &event);
    return event;
}

bool OpenClExecutor::run(const Launch& launch, const std::function<bool(double)>& keep_going) {
    const auto found = programs_.find({launch.kernel, launch.params.features});
    if (found == programs_.end())
        throw Error(ExitCode::device, fmt::format("kernel {} was launched but not built",
                                                  kernel_name(launch.kernel)));
    OpenClProgram& program = found->second;
    const LaunchOptions& options = launch.options;
    shared::LaunchRange range{0, 0, options.counter, 0};  // enqueue sets the spread
    std::uint32_t chunk = kernel_chunk(launch.kernel) * settings_.chunk_factor;
    if (options.items_per_launch > 0) chunk = std::min(chunk, options.items_per_launch);
    try {
        bind(program.kernel(), launch);
        if (!program.kept()) {
            const Stopwatch watch;
            const SilencedErrors silenced;
            enqueue(program.kernel(), launch.kernel, range).wait();
            program.keep(cache_, watch.total());
        }
        for (std::uint32_t first = 0; first < launch.items;) {
            range.first = options.first_item + first;
            range.count = std::min(pacer_.items(launch.kernel, chunk), launch.items - first);
            in_flight_.push_back({enqueue(program.kernel(), launch.kernel, range),
                                  options.milliseconds, launch.kernel, chunk, range.count});
            queue_.flush();
            first += range.count;
            while (in_flight_.size() > launches_ahead) retire_oldest();
            if (keep_going && !keep_going(static_cast<double>(first) / launch.items)) return false;
        }
    } catch (const cl::Error& error) {
        rethrow(error, fmt::format("kernel {}", kernel_name(launch.kernel)));
    }
    return true;
}

void OpenClExecutor::retire_oldest() {
    const auto [event, milliseconds, kernel, most_items, items] = in_flight_.front();
    in_flight_.pop_front();
    event.wait();
    const auto start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
    const auto end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
    if (end <= start) return;
    const double ms = static_cast<double>(end - start) * 1e-6;
    if (info_.watchdog_ms > 0.0 && ms > info_.watchdog_ms)
        throw Error(ExitCode::device,
                    fmt::format("a launch of kernel {} took {:.0f} ms, expected at most {:.0f}",
                                kernel_name(kernel), ms, info_.watchdog_ms));
    pacer_.took(kernel, most_items, items, ms);
    milliseconds_ += ms;
    if (milliseconds != nullptr) *milliseconds += ms;
}

double OpenClExecutor::take_milliseconds() {
    try {
        while (!in_flight_.empty()) retire_oldest();
    } catch (const cl::Error& error) {
        // The times of a failed frame's other launches are dropped: their targets may be gone.
        in_flight_.clear();
        rethrow(error, "waiting for kernels");
    }
    return std::exchange(milliseconds_, 0.0);
}

}  // namespace

std::unique_ptr<Executor> make_opencl_executor(const OpenClDevice& device, int threads) {
    try {
        return std::make_unique<OpenClExecutor>(device, threads);
    } catch (const cl::Error& error) {
        rethrow(error, "opening " + device.info.name);
    }
}

}  // namespace weft
