// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DEVICE_LAUNCH_H
#define WEFT_DEVICE_LAUNCH_H

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "device/device_buffer.h"
#include "device/executor.h"
#include "kernels/core/signatures.h"

namespace weft {

/// A buffer that a kernel always needs.
template <class Kind>
struct Required {
    Required(const DeviceBuffer<Kind>& of) : buffer(of.get()) {}
    Required(BufferRef<Kind> of) : buffer(of.get()) {}
    Buffer* buffer;
};

/// A buffer that some launches of a kernel do not use; for those it may be null.
template <class Kind>
struct Optional {
    Optional(const DeviceBuffer<Kind>& of) : buffer(of.get()) {}
    Optional(BufferRef<Kind> of) : buffer(of.get()) {}
    Optional(std::nullptr_t) {}
    Buffer* buffer = nullptr;
};

/// A struct or number that a kernel takes by value.
template <class T>
struct Value {
    Value(const T& of) : value(of) {}
    T value;
};

/// The scene that a kernel traces in.
struct TracedIn {
    TracedIn(const TracedScene& of) : scene(&of) {}
    const TracedScene* scene;
};

/// Gathers the arguments of a launch in the order of their kernel's signature.
class ArgumentBinder {
  public:
    explicit ArgumentBinder(KernelId kernel) : kernel_(kernel) {}

    template <class Kind>
    void bind(std::string_view name, const Required<Kind>& argument) {
        add_required(name, argument.buffer);
    }
    template <class Kind>
    void bind(std::string_view, const Optional<Kind>& argument) {
        arguments_.push_back({argument.buffer, nullptr, 0});
    }
    template <class T>
    void bind(std::string_view, const Value<T>& argument) {
        arguments_.push_back({nullptr, &argument.value, sizeof(T)});
    }
    void bind(std::string_view, const TracedIn& argument) { scene_ = argument.scene; }
    template <class Group>
    requires requires(const Group& group, ArgumentBinder& binder) { group.bind_to(binder); }
    void bind(std::string_view, const Group& group) { group.bind_to(*this); }

    [[nodiscard]] const std::vector<LaunchArgument>& arguments() const { return arguments_; }
    [[nodiscard]] const TracedScene* scene() const { return scene_; }

  private:
    /// Throws Error (exit code 3) where there is no buffer.
    void add_required(std::string_view name, Buffer* buffer);

    KernelId kernel_;
    std::vector<LaunchArgument> arguments_;
    const TracedScene* scene_ = nullptr;
};

#define WEFT_FIELD(mode, kind, name) WEFT_FIELD_##mode(kind, name)
#define WEFT_FIELD_READS(kind, name) Required<kinds::kind> name;
#define WEFT_FIELD_WRITES(kind, name) Required<kinds::kind> name;
#define WEFT_FIELD_MAY_READ(kind, name) Optional<kinds::kind> name;
#define WEFT_FIELD_MAY_WRITE(kind, name) Optional<kinds::kind> name;
#define WEFT_FIELD_VALUE(type, name) Value<type> name;
#define WEFT_FIELD_TRACES(kind, name) TracedIn name;
#define WEFT_FIELD_GROUP(group, name) groups::group name;
#define WEFT_BIND(mode, kind, name) binder.bind(#name, name);
#define WEFT_OWNED_FIELD(mode, kind, name) DeviceBuffer<kinds::kind> name;
#define WEFT_VIEW_FIELD(mode, kind, name) .name = owned.name,

/// WEFT_GROUP(name) defines three things for GROUP_<name> (kernels/core/argument_groups.h): its
/// buffers as arguments (groups::name), as memory that they own (owned::name), and view(), which
/// makes the arguments from the memory.
#define WEFT_GROUP(name)                                                      \
    namespace groups {                                                        \
    struct name {                                                             \
        GROUP_##name(WEFT_FIELD) void bind_to(ArgumentBinder& binder) const { \
            GROUP_##name(WEFT_BIND)                                           \
        }                                                                     \
    };                                                                        \
    }                                                                         \
    namespace owned {                                                         \
    struct name {                                                             \
        GROUP_##name(WEFT_OWNED_FIELD)                                        \
    };                                                                        \
    }                                                                         \
    [[nodiscard]] inline groups::name view(const owned::name& owned) {        \
        return {GROUP_##name(WEFT_VIEW_FIELD)};                               \
    }
WEFT_GROUP(Geometry)
WEFT_GROUP(LightTable)
WEFT_GROUP(EnvironmentImage)
WEFT_GROUP(SurfaceTables)
WEFT_GROUP(AreaLights)
WEFT_GROUP(MediaTables)
WEFT_GROUP(SeenSurfaces)
WEFT_GROUP(ComposedLight)
#undef WEFT_GROUP

/// The arguments of each kernel, as a struct of its name. Every field must be given, by its name,
/// and takes only buffers of its own kind.
namespace kernels {
using namespace shared;
#define WEFT_KERNEL_ENTRY(kernel, chunk, work)                                      \
    struct kernel {                                                                 \
        static constexpr KernelId id = KernelId::kernel;                            \
        ARGUMENTS_##kernel(WEFT_FIELD) void bind_to(ArgumentBinder& binder) const { \
            ARGUMENTS_##kernel(WEFT_BIND)                                           \
        }                                                                           \
    };
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
}  // namespace kernels

/// Runs one kernel; see Executor::run. `arguments` is a struct of weft::kernels.
template <class Kernel>
bool run_kernel(Executor& executor, const shared::RenderParams& params, const Kernel& arguments,
                std::uint32_t items, const LaunchOptions& options = {},
                const std::function<bool(double done)>& keep_going = {}) {
    ArgumentBinder binder(Kernel::id);
    arguments.bind_to(binder);
    return executor.run({Kernel::id, params, binder.scene(), binder.arguments(), items, options},
                        keep_going);
}

}  // namespace weft

#endif
