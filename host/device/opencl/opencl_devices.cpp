// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/opencl_devices.h"

#include <fmt/format.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

#include "base/error.h"

namespace weft {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
    DeviceInfo info;
    info.backend = "opencl";
    info.name = device.getInfo<CL_DEVICE_NAME>();
    info.driver = fmt::format("{} {}", platform.getInfo<CL_PLATFORM_NAME>(),
                              device.getInfo<CL_DRIVER_VERSION>());
    info.version = device.getInfo<CL_DEVICE_VERSION>();
    info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.max_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.native_width = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    info.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    info.is_cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    return info;
}

/// Rank of a device; the largest is used where the user names none.
int preference(const OpenClDevice& candidate) {
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
                found.push_back({device, describe(platform, device)});
                found.back().info.index = static_cast<int>(found.size()) - 1;
            }
        } catch (const cl::Error&) {
            continue;  // a platform without devices
        }
    }
    return found;
}

OpenClDevice choose_opencl_device(const std::string& wanted) {
    const std::vector<OpenClDevice> devices = opencl_devices();
    if (devices.empty())
        throw Error(ExitCode::device,
                    "no OpenCL device was found, expected an OpenCL driver such as the package "
                    "pocl-opencl-icd (or use --backend embree)");
    if (wanted.empty())
        return *std::max_element(devices.begin(), devices.end(), [](const auto& a, const auto& b) {
            return preference(a) < preference(b);
        });
    if (is_number(wanted)) {
        const auto index = std::stoul(wanted);
        if (index < devices.size()) return devices[index];
    } else {
        for (const OpenClDevice& candidate : devices)
            if (lower(candidate.info.name).find(lower(wanted)) != std::string::npos)
                return candidate;
    }
    std::string list;
    for (const OpenClDevice& candidate : devices)
        list += fmt::format("{}{} \"{}\"", list.empty() ? "" : ", ", candidate.info.index,
                            candidate.info.name);
    throw Error(ExitCode::device,
                fmt::format("no OpenCL device \"{}\", expected one of: {}", wanted, list));
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
