// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/opencl_program.h"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "device/native/native_variants.h"

namespace weft {
namespace {

constexpr std::array<std::pair<std::string_view, std::uint32_t>, 16> feature_names{{
    {"FEATURE_TEXTURES", FEATURE_TEXTURES},
    {"FEATURE_VERTEX_COLOURS", FEATURE_VERTEX_COLOURS},
    {"FEATURE_SMOOTH_NORMALS", FEATURE_SMOOTH_NORMALS},
    {"FEATURE_ENVIRONMENT", FEATURE_ENVIRONMENT},
    {"FEATURE_DIRECTIONAL_LIGHTS", FEATURE_DIRECTIONAL_LIGHTS},
    {"FEATURE_ONE_SIDED", FEATURE_ONE_SIDED},
    {"FEATURE_INDIRECT", FEATURE_INDIRECT},
    {"FEATURE_SAMPLED_DIRECT", FEATURE_SAMPLED_DIRECT},
    {"FEATURE_EXACT_DIRECT", FEATURE_EXACT_DIRECT},
    {"FEATURE_DENSITY_GRIDS", FEATURE_DENSITY_GRIDS},
    {"FEATURE_MEDIA", FEATURE_MEDIA},
    {"FEATURE_AIRLIGHT", FEATURE_AIRLIGHT},
    {"FEATURE_EMISSIVE_MEDIA", FEATURE_EMISSIVE_MEDIA},
    {"FEATURE_CONVEX_MEDIA", FEATURE_CONVEX_MEDIA},
    {"FEATURE_TEMPORAL", FEATURE_TEMPORAL},
    {"FEATURE_HEMISPHERES", FEATURE_HEMISPHERES},
}};

/// The features that `source` asks about, beyond their definitions.
std::uint32_t asked_features(const std::string& source) {
    std::uint32_t asked = 0;
    for (const auto& [name, bit] : feature_names) {
        const std::size_t definition = source.find(name);
        if (definition != std::string::npos &&
            source.find(name, definition + 1) != std::string::npos)
            asked |= bit;
    }
    return asked;
}

std::string build_options(const cl::Device& device, const ProgramSettings& settings,
                          std::uint32_t features) {
    std::string options =
        fmt::format("-cl-std=CL1.2 -DLANES={} -DLOCAL_SIZE={} -DWEFT_FEATURES={}u", settings.lanes,
                    settings.local_size, features);
    // Where division and square root are exact, all devices give the same bits.
    if ((device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0)
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    return options;
}

void check_arguments(const cl::Kernel& kernel, KernelId id) {
    const NativeKernel& native = choose_variant(0).kernels->kernels[static_cast<std::size_t>(id)];
    const auto count = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    if (count != native.argument_count)
        throw Error(ExitCode::device,
                    fmt::format("kernel {} has {} arguments on the device, expected {}",
                                kernel_name(id), count, native.argument_count));
}

}  // namespace

OpenClProgram::OpenClProgram(const cl::Context& context, const cl::Device& device,
                             const ProgramCache& cache, KernelId kernel, const std::string& source,
                             const ProgramSettings& settings, std::uint32_t features) {
    const Stopwatch watch;
    build_.name = kernel_name(kernel);
    build_.flags = build_options(device, settings, features & asked_features(source));
    const std::string name = device.getInfo<CL_DEVICE_NAME>();
    const std::string vendor = device.getInfo<CL_DEVICE_VENDOR>();
    const std::string version = device.getInfo<CL_DEVICE_VERSION>();
    const std::string driver = device.getInfo<CL_DRIVER_VERSION>();
    const std::array<std::string_view, 6> parts{source, build_.flags, name,
                                                vendor, version,      driver};
    key_ = ProgramCache::key(parts);
    build_.from_cache = load(context, device, cache);
    if (!build_.from_cache) compile(context, device, source);
    kernel_ = cl::Kernel(program_, build_.name.c_str());
    check_arguments(kernel_, kernel);
    build_.build_ms = watch.total();
}

bool OpenClProgram::load(const cl::Context& context, const cl::Device& device,
                         const ProgramCache& cache) {
    const auto binary = cache.load(key_);
    if (!binary) return false;
    try {
        program_ = cl::Program(context, {device}, {*binary});
        program_.build({device}, build_.flags.c_str());
        // A driver may take a program that it cannot use; only a kernel proves it.
        (void)cl::Kernel(program_, build_.name.c_str());
        return true;
    } catch (const cl::Error&) {
        cache.remove(key_);
        return false;
    }
}

void OpenClProgram::compile(const cl::Context& context, const cl::Device& device,
                            const std::string& source) {
    program_ = cl::Program(context, source);
    try {
        program_.build({device}, build_.flags.c_str());
    } catch (const cl::Error& error) {
        if (error.err() == CL_OUT_OF_HOST_MEMORY)
            throw Error(ExitCode::out_of_memory, "no memory to compile kernel " + build_.name);
        throw Error(
            ExitCode::device,
            fmt::format("kernel {} does not build on {} ({}, options {}):\n{}", build_.name,
                        device.getInfo<CL_DEVICE_NAME>(), device.getInfo<CL_DRIVER_VERSION>(),
                        build_.flags, program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device)));
    }
}

void OpenClProgram::keep(const ProgramCache& cache, double launch_ms) {
    kept_ = true;
    build_.build_ms += launch_ms;
    if (build_.from_cache) return;
    const Stopwatch watch;
    try {
        const auto binaries = program_.getInfo<CL_PROGRAM_BINARIES>();
        if (!binaries.empty()) cache.store(key_, binaries.front());
    } catch (const cl::Error&) {
        return;  // a driver without binaries compiles again next time
    }
    build_.build_ms += watch.total();
}

}  // namespace weft
