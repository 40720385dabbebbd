// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/program_recipe.h"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "device/opencl/program_cache.h"
#include "device/opencl/program_source.h"

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
