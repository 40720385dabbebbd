// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/program_recipe.h"

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <set>
#include <string_view>

#include "device/opencl/program_cache.h"
#include "device/opencl/program_source.h"

namespace weft {
namespace {

/// The features that `source` depends on: FEATURE_ bits whose names occur outside of their
/// definition.
std::uint32_t asked_features(std::string_view source) {
    constexpr std::string_view prefix = "FEATURE_";
    constexpr std::string_view definition = "#define ";
    std::map<std::string_view, std::uint32_t> bits;
    std::set<std::string_view> asked;
    for (std::size_t at = source.find(prefix); at != std::string_view::npos;
         at = source.find(prefix, at + 1)) {
        const std::size_t end =
            source.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_", at);
        const std::string_view name = source.substr(at, end - at);
        if (!source.substr(0, at).ends_with(definition)) {
            asked.insert(name);
        } else if (end != std::string_view::npos) {
            std::uint32_t bit = 0;
            std::from_chars(source.data() + end + 1, source.data() + source.size(), bit);
            bits.emplace(name, bit);
        }
    }
    std::uint32_t all = 0;
    for (const auto& [name, bit] : bits)
        if (asked.contains(name)) all |= bit;
    return all;
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

}  // namespace

std::uint32_t launch_size(KernelId kernel, const ProgramSettings& settings) {
    const std::uint32_t chunk = kernel_chunk(kernel) * settings.chunk_factor;
    return (chunk + settings.local_size - 1) / settings.local_size * settings.local_size;
}

std::string program_key(const cl::Device& device, const std::string& source,
                        const std::string& options) {
    const std::string name = device.getInfo<CL_DEVICE_NAME>();
    const std::string vendor = device.getInfo<CL_DEVICE_VENDOR>();
    const std::string version = device.getInfo<CL_DEVICE_VERSION>();
    const std::string driver = device.getInfo<CL_DRIVER_VERSION>();
    const std::array<std::string_view, 6> parts{source, options, name, vendor, version, driver};
    return ProgramCache::key(parts);
}

ProgramRecipe program_recipe(const cl::Device& device, KernelId kernel,
                             const ProgramSettings& settings, std::uint32_t features) {
    ProgramRecipe recipe;
    recipe.name = kernel_name(kernel);
    recipe.source = program_source(recipe.name);
    recipe.options = build_options(device, settings, features & asked_features(recipe.source));
    recipe.key = program_key(device, recipe.source, recipe.options);
    recipe.global_size = launch_size(kernel, settings);
    recipe.local_size = settings.local_size;
    return recipe;
}

}  // namespace weft
