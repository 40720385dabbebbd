// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/program_source.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "device/kernel_sources.h"

namespace weft {
namespace {

constexpr std::size_t max_source_bytes = std::size_t{1} << 20;

/// The text of a file of kernels/: from the folder that WEFT_KERNELS names, else as embedded.
std::string source_text(const std::string& name) {
    const char* const folder = std::getenv("WEFT_KERNELS");
    if (folder != nullptr && *folder != '\0') {
        const std::vector<std::byte> bytes =
            read_file(std::filesystem::path(folder) / name, max_source_bytes);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    for (const KernelSource& source : kernel_sources())
        if (source.name == name) return std::string(source.text);
    throw Error(ExitCode::device, "kernel source " + name + " is not embedded");
}

/// The file of kernels/ that holds a kernel: `<name>.cl`, in whichever folder.
std::string kernel_file(std::string_view kernel) {
    std::string file = std::string(kernel) + ".cl";
    for (const KernelSource& source : kernel_sources())
        if (source.name.ends_with("/" + file)) return std::string(source.name);
    return file;
}

/// The file that an #include line names, relative to kernels/; empty for other lines.
std::string_view included_file(std::string_view line) {
    constexpr std::string_view directive = "#include \"kernels/";
    if (!line.starts_with(directive)) return {};
    line.remove_prefix(directive.size());
    return line.substr(0, line.find('"'));
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as headers include each other
void append_expanded(const std::string& name, std::set<std::string>& seen, std::string& out) {
    const std::string source = source_text(name);
    std::string_view text = source;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(end);
        const std::string file(included_file(line));
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
    std::set<std::string> seen;
    append_expanded(kernel_file(kernel), seen, out);
    return out;
}

}  // namespace weft
