// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/merge_options.h"

#include "app/command_line.h"
#include "base/quote.h"

namespace weft {

void add_merge(CLI::App& app) {
    CLI::App& merge = add_command(app, "merge", "Joins samples that were rendered apart");
    add_values(merge, "PART", "Images written with --samples or --resume");
    add_value(merge, "-o,--output", "FILE", "Image to write, .exr");
}

MergeOptions read_merge(const CLI::App& command) {
    MergeOptions options;
    for (const std::string& part : values_of(command, "PART")) options.parts.emplace_back(part);
    if (options.parts.empty())
        throw usage_error("no parts given, expected weft merge PART... -o OUT.exr");
    const std::optional<std::string> output = value_of(command, "--output");
    if (!output) throw usage_error("no output given, expected weft merge PART... -o OUT.exr");
    options.output = *output;
    if (extension_of(options.output) != ".exr")
        throw usage_error("--output: " + quote(*output) +
                          " cannot hold exact sums, expected an .exr file");
    return options;
}

}  // namespace weft
