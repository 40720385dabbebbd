// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/device_options.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>

#include "app/command_line.h"
#include "app/parse_values.h"

namespace weft {
namespace {

// In the order of the enumeration.
constexpr std::array<std::string_view, 3> backend_names = {"opencl", "embree", "native"};

}  // namespace

std::string_view to_string(Backend backend) {
    return backend_names.at(static_cast<std::size_t>(backend));
}

void add_device_choice(CLI::App& command, const std::string& backend) {
    add_value(command, "--backend", "NAME", backend);
    add_value(command, "--device", "N|NAME", "OpenCL device, as `weft devices` lists them");
}

std::optional<Backend> read_backend(const CLI::App& command) {
    const std::optional<std::string> text = value_of(command, "--backend");
    if (!text) return std::nullopt;
    return static_cast<Backend>(parse_name("--backend", *text, backend_names));
}

std::optional<std::string> read_device(const CLI::App& command) {
    std::optional<std::string> text = value_of(command, "--device");
    if (!text) return std::nullopt;
    const std::size_t first = text->front() == '-' ? 1 : 0;
    if (text->find_first_not_of("0123456789", first) == std::string::npos)
        static_cast<void>(
            parse_unsigned("--device", *text, 0, std::numeric_limits<std::uint32_t>::max()));
    return text;
}

}  // namespace weft
