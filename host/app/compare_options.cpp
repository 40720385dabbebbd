// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/compare_options.h"

#include <algorithm>
#include <array>

#include "app/command_line.h"
#include "app/parse_values.h"
#include "base/quote.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// The names of Metric in their order; the last one stands for all metrics.
constexpr std::array<std::string_view, 15> metric_names = {"hdrvdp",
                                                           "flip",
                                                           "hdrflip",
                                                           "relmse",
                                                           "relmse_trimmed",
                                                           "mape",
                                                           "bias",
                                                           "mean_ratio",
                                                           "psnr",
                                                           "ssim",
                                                           "pu21_psnr",
                                                           "pu21_ssim",
                                                           "unbiased_mse",
                                                           "unbiased_relmse",
                                                           "all"};
std::vector<Metric> read_metrics(const CLI::App& command) {
    std::vector<Metric> metrics;
    bool all = false;
    for (const std::string& text : values_of(command, "--metric")) {
        const std::size_t index = parse_name("--metric", text, metric_names);
        const auto metric = static_cast<Metric>(index);
        all = all || index + 1 == metric_names.size();
        if (std::find(metrics.begin(), metrics.end(), metric) == metrics.end())
            metrics.push_back(metric);
    }
    return all ? std::vector<Metric>{} : metrics;
}

}  // namespace

std::string_view to_string(Metric metric) {
    return metric_names.at(static_cast<std::size_t>(metric));
}

void add_compare(CLI::App& app) {
    CLI::App& compare = add_command(app, "compare", "Measures how two images differ");
    add_value(compare, "REF", "", "Reference image, .exr, .hdr or .png");
    add_value(compare, "TEST", "", "Image of the same size to compare with it");
    add_value(
        compare, "--metric", "NAME",
        "hdrvdp, flip, hdrflip, relmse, relmse_trimmed, mape, bias, mean_ratio, psnr, ssim, "
        "pu21_psnr, pu21_ssim, unbiased_mse, unbiased_relmse or all; may be given several times "
        "(default: all)");
    add_value(
        compare, "--second-reference", "REF2",
        "Independent image of the view of REF, for unbiased errors and the floor of hdrvdp and "
        "flip (default: the halves that REF may hold)");
    add_value(compare, "--luminance-scale", "K",
              "cd/m^2 of the value 1 (default: 100; 80 where both images are PNG)");
    add_value(compare, "--ppd", "N", "Pixels per degree (default: 30 for HDR-VDP, 67.02 for FLIP)");
    add_value(compare, "--map", "FILE",
              "Writes a heat map, .png, of the first metric given that has one");
    add_value(compare, "--layer", "NAME", "Layer of both images (default: beauty)");
    add_flag(compare, "--json", "Prints JSON");
    add_flag(compare, "--legacy-fan", "Orientations of HDR-VDP exactly as in its version 1.7");
    add_flag(compare, "--legacy-otf-grid", "Optics of HDR-VDP exactly as in its version 1.7");
}

CompareOptions read_compare(const CLI::App& command) {
    constexpr double max_scale = 1e6;
    constexpr double max_ppd = 1000.0;
    CompareOptions options;
    options.reference = *value_of(command, "REF");
    options.test = *value_of(command, "TEST");
    if (const auto text = value_of(command, "--second-reference")) options.second_reference = *text;
    options.metrics = read_metrics(command);
    if (const auto text = value_of(command, "--luminance-scale"))
        options.luminance_scale =
            parse_number("--luminance-scale", *text, 1.0 / max_scale, max_scale);
    if (const auto text = value_of(command, "--ppd"))
        options.ppd = parse_number("--ppd", *text, 1.0, max_ppd);
    if (const auto text = value_of(command, "--map")) options.map = *text;
    options.layer = value_of(command, "--layer");
    options.json = is_given(command, "--json");
    options.legacy_fan = is_given(command, "--legacy-fan");
    options.legacy_otf_grid = is_given(command, "--legacy-otf-grid");
    if (!options.map) return options;
    if (extension_of(*options.map) != ".png")
        throw usage_error("--map: " + quote(options.map->string()) + ", expected a name in .png");
    for (const fs::path& image :
         {options.reference, options.test, options.second_reference.value_or(options.test)})
        if (options.map->lexically_normal() == image.lexically_normal())
            throw usage_error("--map: names the same file as an image to compare");
    if (!options.metrics.empty() &&
        std::all_of(options.metrics.begin(), options.metrics.end(),
                    [](Metric metric) { return metric > Metric::relmse; }))
        throw usage_error(
            "--map: no metric given has a map, expected hdrvdp, flip, hdrflip or "
            "relmse");
    return options;
}

}  // namespace weft
