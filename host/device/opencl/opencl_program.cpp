// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/opencl_program.h"

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <span>
#include <string_view>

#include "base/error.h"
#include "base/file.h"
#include "base/quote.h"
#include "base/stopwatch.h"
#include "device/kernel_signature.h"
#include "device/opencl/driver_folder.h"
#include "device/opencl/silenced_errors.h"

namespace weft {
namespace {

void check_argument_count(const cl::Kernel& kernel, KernelId id) {
    constexpr std::size_t of_all = 2;     // `params` and `range`
    constexpr std::size_t of_traced = 2;  // nodes and leaves of the BVH
    const std::size_t expected =
        of_all + (kernel_traces(id) ? of_traced : 0) + kernel_arguments(id).size();
    const auto count = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    if (count != expected)
        throw Error(ExitCode::device,
                    fmt::format("kernel {} has {} arguments on the device, expected {}",
                                kernel_name(id), count, expected));
}

/// The first line of a build log that has an error, or else the first line.
std::string_view first_error(std::string_view log) {
    constexpr std::string_view blanks = " \t\r\n";
    const std::size_t error = log.find("error");
    const std::size_t before = error != log.npos ? log.find_last_of('\n', error) : log.npos;
    log.remove_prefix(std::min(log.find_first_not_of(blanks, before + 1), log.size()));
    return log.substr(0, log.find('\n'));
}

/// Leaves a build log in the cache; returns where, or an empty path where that fails.
std::filesystem::path keep_log(const ProgramCache& cache, const std::string& name,
                               std::string_view log) {
    if (cache.folder().empty()) return {};
    std::filesystem::path file = cache.folder() / (name + ".log");
    try {
        make_cache_folder(cache.folder());
        write_file_atomically(file, std::as_bytes(std::span(log)), WriteMode::unflushed);
    } catch (const std::exception&) {
        return {};
    }
    return file;
}

}  // namespace

OpenClProgram::OpenClProgram(const cl::Context& context, const cl::Device& device,
                             const ProgramCache& cache, const KernelUse& use,
                             const ProgramRecipe& recipe, std::optional<double> compiled_ms)
    : key_(recipe.key) {
    const Stopwatch watch;
    const SilencedErrors silenced;
    build_.name = recipe.name;
    build_.flags = recipe.options;
    build_.use = use;
    cached_ = load(context, device, cache);
    build_.from_cache = cached_ && !compiled_ms;
    if (!cached_) compile(context, device, cache, recipe.source);
    kernel_ = cl::Kernel(program_, build_.name.c_str());
    check_argument_count(kernel_, use.kernel);
    build_.build_ms = watch.total() + compiled_ms.value_or(0.0);
}

bool OpenClProgram::load(const cl::Context& context, const cl::Device& device,
                         const ProgramCache& cache) {
    const auto binary = cache.load(key_);
    if (!binary) return false;
    try {
        program_ = cl::Program(context, {device}, {*binary});
        program_.build({device}, build_.flags.c_str());
        // A driver may accept a program that it cannot use; only making a kernel shows that.
        (void)cl::Kernel(program_, build_.name.c_str());
        return true;
    } catch (const cl::Error&) {
        cache.remove(key_);
        return false;
    }
}

void OpenClProgram::compile(const cl::Context& context, const cl::Device& device,
                            const ProgramCache& cache, const std::string& source) {
    program_ = cl::Program(context, source);
    try {
        program_.build({device}, build_.flags.c_str());
    } catch (const cl::Error& error) {
        if (error.err() == CL_OUT_OF_HOST_MEMORY)
            throw Error(ExitCode::out_of_memory, "no memory to compile kernel " + build_.name);
        throw Error(ExitCode::device,
                    driver_folder_is_full() ? full_driver_folder() : build_failure(device, cache));
    }
}

std::string OpenClProgram::build_failure(const cl::Device& device,
                                         const ProgramCache& cache) const {
    const std::string log = program_.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
    const std::filesystem::path file = keep_log(cache, build_.name, log);
    return fmt::format("kernel {} does not build on {} ({}, options {}): {}{}", build_.name,
                       one_line(device.getInfo<CL_DEVICE_NAME>()),
                       one_line(device.getInfo<CL_DRIVER_VERSION>()), build_.flags,
                       one_line(first_error(log)),
                       file.empty() ? "" : fmt::format(" (log: {})", one_line(file.string())));
}

void OpenClProgram::keep(const ProgramCache& cache, double launch_ms) {
    kept_ = true;
    build_.build_ms += launch_ms;
    if (cached_) return;
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
