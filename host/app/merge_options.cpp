// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/merge_options.h"

#include "app/command_line.h"
#include "app/parse_values.h"
#include "base/quote.h"

namespace weft {

void add_merge(CLI::App& app) {
    CLI::App& merge = add_command(app, "merge", "Joins samples that were rendered apart");
    add_values(merge, "PART", "Images written with --samples or --resume");
    add_value(merge, "-o,--output", "FILE", "Image to write, .exr");
    add_value(merge, "--expect", "A:B",
              "Fails where the parts do not have just the samples A to B - 1");
    add_value(merge, "--missing", "N",
              "Writes no image, but prints which of the N parts of --expect have to be rendered, "
              "such as 2,5-7; files that are not there are missing parts");
}

MergeOptions read_merge(const CLI::App& command) {
    MergeOptions options;
    for (const std::string& part : values_of(command, "PART")) options.parts.emplace_back(part);
    const std::optional<std::string> output = value_of(command, "--output");
    if (const auto text = value_of(command, "--expect"))
        options.expect = parse_range("--expect", *text);
    if (const auto text = value_of(command, "--missing")) {
        if (!options.expect)
            throw usage_error("--missing: counts parts of the samples of --expect, expected both");
        if (output) throw usage_error("--missing: writes no image, expected no --output with it");
        options.missing =
            parse_unsigned("--missing", *text, 1, options.expect->end - options.expect->first);
        return options;
    }
    if (options.parts.empty())
        throw usage_error("no parts given, expected weft merge PART... -o OUT.exr");
    if (!output) throw usage_error("no output given, expected weft merge PART... -o OUT.exr");
    options.output = *output;
    if (extension_of(options.output) != ".exr")
        throw usage_error("--output: " + quote(*output) +
                          " cannot hold exact sums, expected an .exr file");
    return options;
}

}  // namespace weft
