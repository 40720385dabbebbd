// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/program_source.h"

#include <algorithm>
#include <set>

#include "base/error.h"
#include "device/kernel_sources.h"

namespace weft {
namespace {

std::string_view find_source(std::string_view name) {
    for (const KernelSource& source : kernel_sources())
        if (source.name == name) return source.text;
    throw Error(ExitCode::device, "kernel source " + std::string(name) + " is not embedded");
}

/// The file between the quotes of an #include line, or empty.
std::string_view included_file(std::string_view line) {
    constexpr std::string_view directive = "#include \"";
    if (!line.starts_with(directive)) return {};
    line.remove_prefix(directive.size());
    return line.substr(0, line.find('"'));
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as headers include each other
void append_expanded(std::string_view name, std::set<std::string_view>& seen, std::string& out) {
    std::string_view text = find_source(name);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end);
        const std::string_view file = included_file(line);
        // The C++ half of a header is left out by the preprocessor, and so are its files here.
        if (file.empty()) {
            out += line;
        } else if (!file.ends_with("_native.h") && seen.insert(file).second) {
            append_expanded(file, seen, out);
        }
    }
}

}  // namespace

std::string program_source(std::string_view kernel) {
    std::string out;
    // types.h names no header for its own types: float4 is built in on devices.
    std::set<std::string_view> seen;
    append_expanded(std::string(kernel) + ".cl", seen, out);
    return out;
}

}  // namespace weft
