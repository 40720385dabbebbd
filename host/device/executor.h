// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_EXECUTOR_H
#define WEFT_DEVICE_EXECUTOR_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bvh/wide_bvh.h"
#include "shared/shared_types.h"

namespace weft {

/// Every kernel, by the names of kernels/core/kernels.def.
enum class KernelId : std::uint32_t {
#define WEFT_KERNEL_ENTRY(name, chunk, work) name,
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
};

[[nodiscard]] std::string_view kernel_name(KernelId kernel);

/// The most work-items that one launch has on a CPU device. Drivers compile for this launch size.
[[nodiscard]] std::uint32_t kernel_chunk(KernelId kernel);

/// Describes a device for users and reports.
struct DeviceInfo {
    int index = -1;       ///< position in the list of OpenCL devices; -1 for native backends
    std::string backend;  ///< "opencl", "embree" or "native"
    std::string name;
    std::string driver;
    std::string version;
    std::uint64_t memory = 0;          ///< bytes
    std::uint64_t max_allocation = 0;  ///< bytes of one buffer
    std::uint32_t native_width = 1;    ///< floats per vector
    std::uint32_t compute_units = 1;
    bool is_cpu = true;          ///< work-items take packets of rays; false: they take single rays
    bool maps_memory = true;     ///< the host reaches buffers in place; false: it copies them
    bool compiles_alone = true;  ///< one program at a time in a process, whatever its threads
    double watchdog_ms = 0.0;    ///< a launch that takes longer fails; 0: there is no such limit
    std::string failure;         ///< why it cannot be used, where that is known
    std::vector<std::string> lacks;  ///< what images may miss on it, in few words each
};

/// Device memory. Contents are undefined until written.
class Buffer {
  public:
    virtual ~Buffer() = default;
    [[nodiscard]] std::size_t bytes() const noexcept { return bytes_; }

  protected:
    explicit Buffer(std::size_t bytes) : bytes_(bytes) {}

  private:
    std::size_t bytes_;
};

/// The acceleration structure in which rays are traced, as a backend keeps it.
class TracedScene {
  public:
    virtual ~TracedScene() = default;
};

/// Triangles as kernels read them, for building a TracedScene; must outlive it.
struct TracedGeometry {
    std::span<const shared::float4> positions;
    std::span<const shared::Triangle> triangles;
    float box_padding = 0.0F;  ///< see BvhSettings::padding
    /// Triangles from here on may move: see Executor::update_scene. By default none does.
    std::size_t first_moving = std::numeric_limits<std::size_t>::max();
    bool passing = false;  ///< temporary: built quickly; Executor::bvh and scene_ms ignore it
    bool soon = false;     ///< somebody waits: see BvhEffort::soon
    bool further = false;  ///< beside that of a scene: Executor::bvh and scene_ms ignore it, too
};

/// One argument of a launch: a buffer, a value, or neither for a buffer that the launch does not
/// use. They are made from typed arguments: see device/launch.h.
struct LaunchArgument {
    Buffer* buffer = nullptr;
    const void* value = nullptr;
    std::size_t bytes = 0;  ///< of the value
};

/// How a kernel is run.
struct LaunchOptions {
    std::uint32_t items_per_launch = 0;  ///< at most; 0: the kernel's own chunk
    std::uint32_t first_item = 0;
    std::uint32_t counter = 0;  ///< which shared::RayCounter counts its rays
    /// Where not null, the launches' time on the device is added here, by take_milliseconds at the
    /// latest, which must be called while the target still exists.
    double* milliseconds = nullptr;
    /// Runs to its end even after a cancel, because what it adds to must get either all of it or
    /// nothing.
    bool whole = false;
};

/// A kernel to run over the work-items [first_item, first_item + items). The executor cuts it into
/// short launches, each with a shared::LaunchRange of its own.
struct Launch {
    KernelId kernel;
    const shared::RenderParams& params;
    const TracedScene* scene;                   ///< null for kernels that trace nothing
    std::span<const LaunchArgument> arguments;  ///< those after it, in the order of the signature
    std::uint32_t items = 0;
    LaunchOptions options = {};
};

/// A kernel and the features of the frames that it is for.
struct KernelUse {
    KernelId kernel{};
    std::uint32_t features = 0;
};

/// How a kernel was built, and in what time.
struct KernelBuild {
    std::string name;
    std::string flags;
    double build_ms = 0.0;  ///< program build or load, and the compilation at the first launch
    bool from_cache = false;
    KernelUse use{};
};

/// How far kernels are that are being compiled.
struct BuildProgress {
    std::size_t programs = 0;  ///< that are compiled
    double left_ms = 0.0;      ///< until all are, estimated
};

enum class Access : std::uint8_t { read, write };

/// Runs kernels on one device. Not thread-safe. Failures are Errors with exit code 3, or 4 where
/// the device has no memory left.
class Executor {
  public:
    virtual ~Executor() = default;

    [[nodiscard]] virtual const DeviceInfo& device() const = 0;
    /// Width of shadow-ray packets.
    [[nodiscard]] virtual std::uint32_t lanes() const = 0;

    /// `what` names the buffer in errors.
    [[nodiscard]] virtual std::unique_ptr<Buffer> allocate(std::size_t bytes,
                                                           std::string_view what) = 0;
    /// Calls `use` with the buffer's bytes in host memory. On CPU devices nothing is copied. With
    /// Access::write the old contents may be lost.
    virtual void with_mapped(Buffer& buffer, Access access,
                             const std::function<void(std::span<std::byte>)>& use) = 0;

    [[nodiscard]] virtual std::unique_ptr<TracedScene> make_scene(
        const TracedGeometry& geometry) = 0;
    /// Brings a scene that was made of this geometry up to date after the vertices of its moving
    /// triangles have moved, or these triangles have been given other vertices. The padding may
    /// differ, too; all else must be as it was (see check_update).
    virtual void update_scene(TracedScene& scene, const TracedGeometry& geometry) = 0;

    /// Compiles kernels that will be built later, in parallel where that is faster than one by one.
    /// `build` reports those that do not compile.
    virtual void compile(std::span<const KernelUse> uses) { (void)uses; }

    /// Sets what is called some times a second while kernels are compiled, which takes seconds
    /// where no earlier run has left them; may be empty.
    virtual void watch_builds(const std::function<void(const BuildProgress&)>& watch) {
        (void)watch;
    }

    /// Makes kernels ready for frames with these features (RenderParams::features of their
    /// launches).
    virtual void build(std::span<const KernelId> kernels, std::uint32_t features) = 0;

    /// Runs all launches of `launch`, in order, after all earlier ones. `keep_going`, where given,
    /// is called between launches with the share that is launched; once it returns false the rest
    /// is left out. Returns whether all ran.
    virtual bool run(const Launch& launch, const std::function<bool(double done)>& keep_going) = 0;

    /// Whether the work under way was cancelled: launches are left out, and host work should end as
    /// soon as it can.
    [[nodiscard]] virtual bool cancelled() const { return false; }

    /// Waits for everything launched and returns its milliseconds on the device since the call
    /// before.
    virtual double take_milliseconds() = 0;

    [[nodiscard]] virtual const std::vector<KernelBuild>& builds() const = 0;
    /// The BVH of the scene made or updated last, or null where the backend has its own (Embree).
    [[nodiscard]] virtual const BvhStats* bvh() const { return nullptr; }
    /// Milliseconds that the acceleration structure of the scene made last took, updates since then
    /// included.
    [[nodiscard]] virtual double scene_ms() const = 0;
    /// Bytes of device memory allocated now.
    [[nodiscard]] virtual std::size_t allocated_bytes() const = 0;
};

/// Throws Error (exit code 3) unless `given` may update a scene that was `made_of` other geometry:
/// it must be the same memory with as many moving triangles. Vertices, triangles and the padding
/// may have changed.
void check_update(const TracedGeometry& made_of, const TracedGeometry& given);

/// Copies `values` into a buffer, in which they fit.
template <class T>
void write_buffer(Executor& executor, Buffer& buffer, std::span<const T> values) {
    if (values.empty()) return;
    executor.with_mapped(buffer, Access::write, [&](std::span<std::byte> bytes) {
        std::copy_n(reinterpret_cast<const std::byte*>(values.data()), values.size_bytes(),
                    bytes.begin());
    });
}

/// Copies the first `count` values of a buffer to the host.
template <class T>
[[nodiscard]] std::vector<T> read_buffer(Executor& executor, Buffer& buffer, std::size_t count) {
    std::vector<T> values(count);
    executor.with_mapped(buffer, Access::read, [&](std::span<std::byte> bytes) {
        std::copy_n(bytes.begin(), count * sizeof(T), reinterpret_cast<std::byte*>(values.data()));
    });
    return values;
}

/// The packet width in the environment variable WEFT_LANES, or 0 where it is not set.
/// Throws Error (exit code 1) for anything but 1, 4, 8 or 16.
[[nodiscard]] std::uint32_t lanes_from_environment();

/// Allocates a buffer that holds `bytes`, or 16 bytes where there are none.
[[nodiscard]] std::unique_ptr<Buffer> upload_bytes(Executor& executor,
                                                   std::span<const std::byte> bytes,
                                                   std::string_view what);

}  // namespace weft

#endif
