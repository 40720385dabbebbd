// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/opencl_devices.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string_view>
#include <utility>

#include "base/error.h"
#include "base/memory_limit.h"
#include "base/quote.h"
#include "device/opencl/driver_fault.h"
#include "device/opencl/usable_drivers.h"

namespace weft {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

/// Whether devices are to be used as if they were GPUs of the least that OpenCL asks for.
bool simulates_gpu() {
    const char* const text = std::getenv("WEFT_SIMULATE_GPU");
    return text != nullptr && std::string_view(text) == "1";
}

/// Takes from a device what GPUs lack.
void limit_as_gpu(DeviceInfo& info) {
    constexpr std::uint64_t least_of_opencl = std::uint64_t{128} << 20;
    constexpr double windows_ms = 2000.0;  // after which Windows resets a graphics card
    info.is_cpu = false;
    info.maps_memory = false;
    info.max_allocation = std::min(info.max_allocation, least_of_opencl);
    info.watchdog_ms = windows_ms;
}

/// What images may miss on a device, in few words each.
std::vector<std::string> shortcomings_of(const cl::Device& device) {
    constexpr cl_ulong roomy = cl_ulong{256} << 20;
    const cl_device_fp_config floats = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
    std::vector<std::string> found;
    if (device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>() == CL_FALSE)
        found.emplace_back("a compiler");
    if ((floats & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) == 0)
        found.emplace_back(
            "correctly rounded division and square roots, so that images may differ from those of "
            "other devices in their last digits");
    if ((floats & CL_FP_INF_NAN) == 0) found.emplace_back("infinities and NaNs");
    if ((floats & CL_FP_DENORM) == 0) found.emplace_back("denormal numbers");
    if (const cl_ulong most = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>(); most < roomy)
        found.push_back(fmt::format("buffers of more than {} MiB", most >> 20));
    return found;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device, bool as_gpu) {
    DeviceInfo info;
    info.backend = "opencl";
    info.name = one_line(device.getInfo<CL_DEVICE_NAME>());
    info.driver = one_line(fmt::format("{} {}", platform.getInfo<CL_PLATFORM_NAME>(),
                                       device.getInfo<CL_DRIVER_VERSION>()));
    info.version = device.getInfo<CL_DEVICE_VERSION>();
    info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.max_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.native_width = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.lacks = shortcomings_of(device);
    info.is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    info.compiles_alone = info.is_cpu;
    info.maps_memory = info.is_cpu || device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() == CL_TRUE;
    if (as_gpu) limit_as_gpu(info);
    return info;
}

/// Rank of a device; the largest is used where the user names none.
int preference(const OpenClDevice& candidate) {
    if (!candidate.info.failure.empty()) return -1;
    if (is_simulator(candidate.info)) return 0;
    const auto type = candidate.device.getInfo<CL_DEVICE_TYPE>();
    if ((type & CL_DEVICE_TYPE_GPU) != 0) return 3;
    if ((type & CL_DEVICE_TYPE_ACCELERATOR) != 0) return 2;
    return 1;
}

bool is_number(const std::string& text) {
    return !text.empty() && text.size() < 10 &&
           std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

const OpenClDevice* device_named(const std::string& wanted,
                                 const std::vector<OpenClDevice>& devices) {
    if (is_number(wanted)) {
        const auto index = std::stoul(wanted);
        return index < devices.size() ? &devices[index] : nullptr;
    }
    const OpenClDevice* found = nullptr;
    for (const OpenClDevice& candidate : devices)
        if (lower(candidate.info.name).find(lower(wanted)) != std::string::npos &&
            (found == nullptr || (!found->info.failure.empty() && candidate.info.failure.empty())))
            found = &candidate;
    return found;
}

std::string list_of(const std::vector<OpenClDevice>& devices) {
    std::string list;
    for (const OpenClDevice& candidate : devices)
        list += fmt::format("{}{} \"{}\"", list.empty() ? "" : ", ", candidate.info.index,
                            candidate.info.name);
    return list;
}

/// Drivers that could not be opened, and the memory that they may use where that is limited.
std::string refused_in_brackets() {
    std::string text = refused_drivers();
    if (const auto limit = memory_limit())
        text += fmt::format("{}drivers may fail under this process's limit of {} MiB of memory",
                            text.empty() ? "" : "; ", *limit >> 20);
    return text.empty() ? text : " (" + text + ")";
}

/// Lets PoCL bind each of its threads to a processor, unless the user has decided that. They sleep
/// between kernels and are often woken on one processor together: with two processors, every third
/// launch of 15 ms took twice as long. Where there are fewer threads than processors they are not
/// bound, or all programs would crowd the first processors.
void bind_driver_threads() {
    cpu_set_t allowed;
    if (sched_getaffinity(0, sizeof(allowed), &allowed) != 0) return;
    if (CPU_COUNT(&allowed) == sysconf(_SC_NPROCESSORS_CONF)) setenv("POCL_AFFINITY", "1", 0);
}

/// Lets PoCL compile kernels once, unless the user has decided that. It would compile a second time
/// for the binary that is kept, without the launch's sizes: these hardly matter here, since kernels
/// declare the size of their groups. Images take as long either way.
void compile_once() {
    setenv("POCL_WORK_GROUP_SPECIALIZATION", "0", 0);
}

}  // namespace

std::vector<OpenClDevice> opencl_devices() {
    bind_driver_threads();
    compile_once();
    const bool as_gpu = simulates_gpu();
    const DriverOpening opening;
    std::vector<OpenClDevice> found;
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return found;  // the loader reports an error where no driver is installed
    }
    for (const cl::Platform& platform : platforms) {
        std::vector<cl::Device> devices;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
            for (const cl::Device& device : devices) {
                found.push_back({device, describe(platform, device, as_gpu), 0});
                found.back().info.index = static_cast<int>(found.size()) - 1;
            }
        } catch (const cl::Error&) {
            continue;  // a platform without devices
        }
    }
    std::map<std::pair<std::string, std::string>, std::size_t> before;
    for (auto& [device, info, twins] : found) {
        twins = before[{info.name, info.driver}]++;
        info.failure = known_failure(info.name, info.driver, twins);
    }
    return found;
}

OpenClDevice choose_opencl_device(const std::string& wanted) {
    const std::vector<OpenClDevice> devices = opencl_devices();
    const std::string none = no_opencl_device(devices);
    if (devices.empty() || (wanted.empty() && !none.empty()))
        throw Error(ExitCode::device,
                    none +
                        ", expected an OpenCL driver such as the package pocl-opencl-icd (or "
                        "use --backend embree)");
    if (wanted.empty())
        return *std::max_element(devices.begin(), devices.end(), [](const auto& a, const auto& b) {
            return preference(a) < preference(b);
        });
    const OpenClDevice* const named = device_named(wanted, devices);
    if (named == nullptr)
        throw Error(ExitCode::device, fmt::format("no OpenCL device \"{}\", expected one of: {}{}",
                                                  wanted, list_of(devices), refused_in_brackets()));
    if (!named->info.failure.empty())
        throw Error(ExitCode::device,
                    fmt::format("OpenCL device {} \"{}\" is not usable: {} (weft devices --check "
                                "tries it again; or use --backend embree)",
                                named->info.index, named->info.name, named->info.failure));
    return *named;
}

std::string no_opencl_device(const std::vector<OpenClDevice>& devices) {
    if (std::ranges::any_of(devices,
                            [](const auto& device) { return device.info.failure.empty(); }))
        return {};
    if (devices.empty()) return "no OpenCL device was found" + refused_in_brackets();
    const OpenClDevice& first = devices.front();
    return fmt::format("no OpenCL device is usable ({} \"{}\": {}{})", first.info.index,
                       first.info.name, first.info.failure,
                       devices.size() > 1 ? "; weft devices says more" : "");
}

bool is_simulator(const DeviceInfo& device) {
    return lower(device.name + device.driver).find("oclgrind") != std::string::npos;
}

void limit_opencl_threads(int threads) {
    setenv("POCL_AFFINITY", "0", 0);
    const std::string count = std::to_string(threads);
    setenv("POCL_MAX_PTHREAD_COUNT", count.c_str(), 1);  // PoCL before 4
    setenv("POCL_CPU_MAX_CU_COUNT", count.c_str(), 1);   // PoCL 4 and later
}

}  // namespace weft
