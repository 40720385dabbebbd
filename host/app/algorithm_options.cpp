// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/algorithm_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <array>
#include <string>
#include <vector>

#include "app/command_line.h"
#include "app/options.h"
#include "app/parse_values.h"
#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "components/component.h"
#include "film/sample_parts.h"

namespace weft {
namespace {

// In the order of the enumerations.
constexpr std::array<std::string_view, 2> switch_names = {"on", "off"};
constexpr std::array<std::string_view, 2> filter_names = {"box", "centre"};
constexpr std::uint32_t most_bounces = 1000000;

/// Reads which samples are rendered, where not all.
void read_samples(const CLI::App& command, RenderOptions& options) {
    const auto range = value_of(command, "--samples");
    const auto part = value_of(command, "--part");
    const char* const name = range ? "--samples" : "--part";
    if (range && part) throw usage_error("--part: says what --samples says, expected one of them");
    if (range) {
        if (options.spp) throw usage_error("--samples: says what --spp says, expected one of them");
        options.samples = parse_range("--samples", *range);
    }
    if (part) {
        const PartOfMany of = parse_part("--part", *part);
        if (!options.spp)
            throw usage_error("--part: is a part of the samples of --spp, expected both");
        if (of.parts > *options.spp)
            throw usage_error(
                fmt::format("--part: there are {} parts of {} samples, expected at "
                            "most one for each sample",
                            of.parts, *options.spp));
        options.samples = part_of({0, *options.spp}, of.part, of.parts);
        options.spp.reset();
    }
    if ((range || part) && options.output.extension() != ".exr")
        throw usage_error(std::string(name) +
                          ": needs a file that holds sums, expected an .exr file as --output");
    options.keep_complete = is_given(command, "--keep-complete");
    if (options.keep_complete && !options.samples)
        throw usage_error(
            "--keep-complete: is for parts, expected it together with --samples or --part");
}

/// Reads the options of path tracing.
void read_path(const CLI::App& command, RenderOptions& options) {
    namespace fs = std::filesystem;
    constexpr double least_error = 1e-9;
    for (const char* const name :
         {"--samples", "--part", "--target-error", "--resume", "--pixel-filter"})
        if (value_of(command, name) && !is_reference(options.algorithm))
            throw usage_error(std::string(name) +
                              ": is for references, expected it together with "
                              "--algorithm path or reference");
    read_samples(command, options);
    if (const auto text = value_of(command, "--target-error"))
        options.target_error = parse_number("--target-error", *text, least_error, 1.0);
    if (const auto text = value_of(command, "--resume")) {
        options.resume = *text;
        if (options.resume->extension() != ".exr")
            throw usage_error("--resume: unknown file type " + quote(*text) +
                              ", expected an .exr file");
        for (const fs::path& other : {options.output, options.scene})
            if (options.resume->lexically_normal() == other.lexically_normal())
                throw usage_error("--resume: names the same file as " +
                                  std::string(other == options.scene ? "the scene" : "--output"));
    }
    if (const auto text = value_of(command, "--checkpoint")) {
        if (!options.resume)
            throw usage_error("--checkpoint: is for the file of --resume, expected both");
        options.checkpoint_seconds = parse_duration("--checkpoint", *text);
    }
    if (const auto text = value_of(command, "--max-bounces")) {
        if (options.algorithm != Algorithm::path)
            throw usage_error(
                "--max-bounces: is for tests of path tracing, expected it together "
                "with --algorithm path");
        options.most_bounces = parse_unsigned("--max-bounces", *text, 0, most_bounces);
    }
    if (const auto text = value_of(command, "--pixel-filter"))
        options.through_centres = parse_name("--pixel-filter", *text, filter_names) == 1;
}

/// Refuses components of which path tracing has no layers.
void check_components(const RenderOptions& options) {
    if (!is_reference(options.algorithm)) return;
    if (options.components)
        for (const std::string_view name : choosable_components(Choice::on_request))
            if (options.names_component(name))
                throw usage_error(
                    fmt::format("--components: path tracing has no {}, expected {}", name,
                                fmt::join(choosable_components(Choice::by_default), ", ")));
    if (options.components && !options.names_component("direct") &&
        !options.names_component("indirect"))
        throw usage_error(
            fmt::format("--components: path tracing has the light of {} in direct, indirect",
                        fmt::join(*options.components, ", ")));
}

void read_indirect(const CLI::App& command, RenderOptions& options) {
    if (options.preset && has_indirect_source(options.algorithm))
        options.indirect = source_of(options.preset->sampling);
    const auto text = value_of(command, "--indirect");
    if (!text) return;
    options.indirect = static_cast<IndirectSource>(
        parse_name("--indirect", short_algorithm_name(*text), source_names));
    if (!has_indirect_source(options.algorithm))
        throw usage_error("--indirect: is for adaptive sampling, expected --algorithm ais or amax");
}

/// Reads the options of records that outlast their frame.
void read_temporal(const CLI::App& command, RenderOptions& options) {
    for (const char* const name : {"--cache-records", "--cache-masks"})
        if (value_of(command, name) && !options.keeps_records())
            throw usage_error(std::string(name) +
                              ": is for records that are kept from frame to frame, expected "
                              "--algorithm tic or --indirect tic");
    if (const auto text = value_of(command, "--cache-records"))
        options.cache_records =
            parse_unsigned("--cache-records", *text, 1, limits::max_cache_records);
    if (options.preset) options.cache_masks = options.preset->sampling.cache_masks;
    if (const auto text = value_of(command, "--cache-masks"))
        options.cache_masks = parse_name("--cache-masks", *text, switch_names) == 0;
}

void read_cache_error(const CLI::App& command, RenderOptions& options) {
    const auto text = value_of(command, "--cache-error");
    if (!text) return;
    if (options.algorithm != Algorithm::irradiance_cache && !options.caches_indirect())
        throw usage_error(
            "--cache-error: is for irradiance records, expected it together with --algorithm ic, "
            "tic or irradiance-cache, or with --indirect ic or tic");
    options.cache_error = parse_number("--cache-error", *text, 0.0, 1.0);
}

/// Reads the options of records that trace hemispheres.
void read_hemispheres(const CLI::App& command, RenderOptions& options) {
    const bool traced = options.algorithm == Algorithm::irradiance_cache;
    if (const auto text = value_of(command, "--cache-rays")) {
        if (!traced)
            throw usage_error(
                "--cache-rays: is for irradiance caching, expected it together with --algorithm "
                "irradiance-cache");
        options.cache_rays =
            parse_unsigned("--cache-rays", *text, limits::min_cache_rays, limits::max_cache_rays);
    }
    if (traced && options.compensation)
        throw usage_error(
            "--vpl-compensation: irradiance caching has no virtual lights, expected another "
            "--algorithm");
}

/// Reads the preset. Options given beside it are read later and override it.
void read_preset_file(const CLI::App& command, RenderOptions& options) {
    const auto text = value_of(command, "--preset");
    if (!text) return;
    if (value_of(command, "--quality"))
        throw usage_error("--quality: says what --preset says, expected one of them");
    options.preset_file = *text;
    options.preset = read_preset(*text);
    options.algorithm = options.preset->algorithm;
}

/// Takes the number of samples from the preset where no option says when to end.
void read_preset_samples(RenderOptions& options) {
    const bool ends_otherwise =
        options.spp || options.samples || options.time_seconds || options.target_error;
    if (options.preset && !ends_otherwise) options.spp = options.preset->samples;
}

void read_compensation(const CLI::App& command, RenderOptions& options) {
    options.compensation = is_given(command, "--vpl-compensation");
}

void refuse_compensation(const RenderOptions& options) {
    if (!options.compensation) return;
    if (options.caches_indirect())
        throw usage_error(
            "--vpl-compensation: records hold the light of VPLs alone, expected another "
            "--algorithm and --indirect vpl");
    if (is_reference(options.algorithm))
        throw usage_error(
            "--vpl-compensation: path tracing leaves nothing out, expected another --algorithm");
}

void read_quality(const CLI::App& command, RenderOptions& options) {
    const auto text = value_of(command, "--quality");
    if (!text) return;
    options.quality = static_cast<Quality>(parse_name("--quality", *text, quality_names));
    if (is_reference(options.algorithm))
        throw usage_error(
            "--quality: is for virtual lights, expected --spp, --time or --target-error of path "
            "tracing");
}

/// Takes the denoiser of the preset where the algorithm supports it; --denoise wins.
void read_denoiser(const CLI::App& command, RenderOptions& options) {
    if (options.preset && can_denoise(options.algorithm, options.preset->denoiser))
        options.denoiser = options.preset->denoiser;
    const auto text = value_of(command, "--denoise");
    if (!text) return;
    options.denoiser = static_cast<Denoiser>(parse_name("--denoise", *text, denoiser_names));
    if (!can_denoise(options.algorithm, options.denoiser))
        throw usage_error(
            "--denoise: statistical needs the variance of every pixel, which previews do not have, "
            "expected --algorithm path or reference, or --denoise oidn");
}

}  // namespace

void add_algorithm(CLI::App& render) {
    add_value(
        render, "--algorithm", "NAME",
        fmt::format("ais, amax, igi, ir, ic, tic, irradiance-cache, path or reference, which is as "
                    "exact as path with less noise (default: {})",
                    to_string(default_algorithm)));
    add_value(render, "--indirect", "NAME",
              "Of ais and amax: indirect light from vpl, from the records of ic or tic, or from "
              "rays, a path through each pixel (default: vpl, of ais in open scenes rays)");
    add_value(render, "--cache-records", "N",
              "Of tic: most records that are kept from frame to frame (default: 262144)");
    add_value(render, "--cache-masks", "on|off",
              "Of tic: each record keeps which VPLs it sees (default: on)");
    add_value(render, "--cache-rays", "N", "Of irradiance-cache: rays of a record (default: 256)");
    add_value(render, "--cache-error", "E",
              "Of ic, tic and irradiance-cache: relative error that records may have, 0 to 1 "
              "(default: by --quality)");
    add_flag(render, "--vpl-compensation",
             "Adds by path tracing what virtual lights leave out (not with path or records)");
    add_value(render, "--quality", "NAME",
              "draft, preview or high: how much time the image is worth (default: preview)");
    add_value(render, "--preset", "FILE",
              "Settings from a JSON file, as `weft tradeoff` writes them; options given beside it "
              "win");
}

void read_algorithm(const CLI::App& command, RenderOptions& options) {
    read_preset_file(command, options);
    if (const auto text = value_of(command, "--algorithm"))
        options.algorithm = static_cast<Algorithm>(
            parse_name("--algorithm", short_algorithm_name(*text), algorithm_names));
    read_path(command, options);
    if (options.frame_seconds && options.algorithm != Algorithm::ais)
        throw usage_error("--frame-time: is for adaptive sampling, expected --algorithm ais");
    check_components(options);
    read_indirect(command, options);
    read_temporal(command, options);
    read_compensation(command, options);
    read_cache_error(command, options);
    read_hemispheres(command, options);
    refuse_compensation(options);
    read_quality(command, options);
    read_denoiser(command, options);
    read_preset_samples(options);
}

}  // namespace weft
