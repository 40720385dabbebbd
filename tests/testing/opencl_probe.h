// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// For tests that run functions of kernels/ on OpenCL devices by a kernel of their own.
#ifndef WEFT_TESTS_TESTING_OPENCL_PROBE_H
#define WEFT_TESTS_TESTING_OPENCL_PROBE_H

#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#define CL_HPP_TARGET_OPENCL_VERSION 120
#include <gtest/gtest.h>

#include <CL/opencl.hpp>
#include <cstddef>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <vector>

// One text for both sides: compiled here in namespace `native`, and `kernel_text` for a device.
#define BOTH_SIDES(...) \
    namespace native {  \
    __VA_ARGS__         \
    }                   \
    constexpr std::string_view kernel_text = #__VA_ARGS__;

namespace weft::test {

/// A file of kernels/ with its includes put in place, each once.
inline std::string expand(const std::string& name, std::set<std::string>& done) {
    if (!done.insert(name).second) return "";
    std::ifstream file(std::string(WEFT_SOURCE_DIR) + "/kernels/" + name);
    EXPECT_TRUE(file.is_open()) << name;
    std::string text;
    for (std::string line; std::getline(file, line);) {
        constexpr std::string_view directive = "#include \"kernels/";
        if (line.starts_with(directive)) {
            // The C++ half must stay out: its text would not even pass the device's preprocessor.
            const std::string inner =
                line.substr(directive.size(), line.find('"', directive.size()) - directive.size());
            text += inner == "core/port_native.h" ? "" : expand(inner, done);
        } else {
            text += line + '\n';
        }
    }
    return text;
}

/// Every device of every platform.
inline std::vector<cl::Device> all_devices() {
    std::vector<cl::Device> devices;
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return {};
    }
    for (const cl::Platform& platform : platforms) {
        std::vector<cl::Device> found;
        try {
            platform.getDevices(CL_DEVICE_TYPE_ALL, &found);
        } catch (const cl::Error&) {
            continue;
        }
        devices.insert(devices.end(), found.begin(), found.end());
    }
    return devices;
}

/// Whether the device promises what kernels/core/maths.h asks of the arithmetic.
inline bool rounds_correctly(const cl::Device& device) {
    const auto config = device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>();
    const bool cpu = (device.getInfo<CL_DEVICE_TYPE>() & CL_DEVICE_TYPE_CPU) != 0;
    return (config & CL_FP_DENORM) != 0 &&
           (cpu || (config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0);
}

/// A program at one lane; `definitions` are further compiler options. A failed build is a failed
/// test, and its kernels do not exist.
inline cl::Program build_program(const cl::Context& context, const cl::Device& device,
                                 const std::string& source, const std::string& definitions) {
    std::string options = "-cl-std=CL1.2 -DLANES=1" + definitions;
    if ((device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0)
        options += " -cl-fp32-correctly-rounded-divide-sqrt";
    cl::Program program(context, source);
    try {
        program.build(options.c_str());
    } catch (const cl::Error&) {
        ADD_FAILURE() << program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
    }
    return program;
}

/// Runs a kernel over `count` work-items and those that fill the last group of eight.
inline void run_items(const cl::CommandQueue& queue, const cl::Kernel& kernel, std::size_t count) {
    constexpr std::size_t local_size = 8;
    const std::size_t padded = (count + local_size - 1) / local_size * local_size;
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(padded), cl::NDRange(local_size));
}

/// Whether it takes seconds for what a device does in milliseconds.
inline bool is_interpreter(const cl::Device& device) {
    const cl::Platform platform(device.getInfo<CL_DEVICE_PLATFORM>());
    return platform.getInfo<CL_PLATFORM_NAME>().find("grind") != std::string::npos;
}

}  // namespace weft::test

#endif
