// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/tradeoff_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/command_line.h"
#include "app/device_options.h"
#include "app/parse_values.h"
#include "base/limits.h"
#include "base/shell_word.h"
#include "plan/algorithm.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {
namespace {

// tic is for sequences.
constexpr std::array<std::string_view, 7> measured_algorithms = {
    "ais", "amax", "igi", "ir", "ic", "irradiance-cache", "path"};
constexpr std::uint32_t max_repetitions = 1000;
constexpr double max_error = 1e6;
constexpr double least_error = 1e-9;

std::vector<std::string_view> measure_names() {
    std::vector<std::string_view> names;
    for (std::size_t i = 0; i < error_measures; ++i)
        names.emplace_back(to_string(static_cast<ErrorMeasure>(i)));
    return names;
}

/// Sorts values in ascending order, each once.
void sort_out(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
}

void read_questions(const CLI::App& command, TradeoffOptions& options) {
    // Rounds off the error of converting units.
    constexpr double parts = 1e6;  // of a millisecond
    for (const std::string& text : values_of(command, "--budget")) {
        const double ms = 1000.0 * parse_duration("--budget", text);
        options.budgets_ms.push_back(std::max(std::round(ms * parts), 1.0) / parts);
    }
    for (const std::string& text : values_of(command, "--error"))
        options.errors.push_back(parse_number("--error", text, least_error, max_error));
    sort_out(options.budgets_ms);
    sort_out(options.errors);
    if (const auto text = value_of(command, "--measure"))
        options.measure =
            static_cast<ErrorMeasure>(parse_name("--measure", *text, measure_names()));
}

void read_measurement(const CLI::App& command, TradeoffOptions& options) {
    options.quick = is_given(command, "--quick");
    options.repetitions = options.quick ? 3 : 5;
    options.reference_spp = options.quick ? 256 : 1024;
    if (const auto text = value_of(command, "--repetitions"))
        options.repetitions = parse_unsigned("--repetitions", *text, 2, max_repetitions);
    if (const auto text = value_of(command, "--reference-spp")) {
        options.reference_spp =
            parse_unsigned("--reference-spp", *text, 2, limits::max_samples_per_pixel);
        options.reference_spp_given = true;
    }
    if (const auto text = value_of(command, "--seed"))
        options.seed =
            parse_unsigned("--seed", *text, 0, std::numeric_limits<std::uint32_t>::max());
    if (const auto text = value_of(command, "--threads"))
        options.threads = parse_unsigned("--threads", *text, 1, limits::max_threads);
    if (const auto text = value_of(command, "--algorithms"))
        options.algorithms =
            parse_name_list("--algorithms", short_algorithm_names(*text), measured_algorithms);
}

}  // namespace

void add_tradeoff(CLI::App& app) {
    CLI::App& tradeoff =
        add_command(app, "tradeoff", "Measures what accuracy costs on a scene, and gives advice");
    add_scene(tradeoff);
    add_value(tradeoff, "-o,--output", "DIR",
              "Folder to write to (default: the scene's name with -tradeoff, in the current "
              "folder)");
    add_flag(tradeoff, "--quick", "Fewer settings, 3 repetitions, a reference of 256 samples");
    add_value(tradeoff, "--algorithms", "LIST",
              fmt::format("Any of {} (default: all that the scene needs)",
                          fmt::join(measured_algorithms, ",")));
    add_value(tradeoff, "--measure", "NAME",
              fmt::format("Error that the front and the advice go by: {} (default: hdrflip)",
                          fmt::join(measure_names(), ", ")));
    add_value(tradeoff, "--budget", "T",
              "Time of an image to advise on; may be given several times (default: 100ms, 300ms "
              "and 1s)");
    add_value(tradeoff, "--error", "E",
              "Error to advise on; may be given several times (default: three by what was "
              "measured)");
    add_value(tradeoff, "--repetitions", "N", "Images of every setting, 2 and up (default: 5)");
    add_value(tradeoff, "--reference-spp", "N",
              "Samples per pixel of the reference (default: 1024, or as many as one with little "
              "noise has that is kept)");
    add_value(tradeoff, "--references", "DIR",
              "Folder that keeps references (default: that of compiled kernels)");
    add_value(tradeoff, "--peers", "FILE", "JSON file of images by other renderers to compare");
    add_flag(tradeoff, "--verify",
             "Makes every image of the front again with three new seeds, and says how many lie "
             "where they should");
    add_device_choice(tradeoff,
                      "opencl, embree or native (default: opencl where there is a "
                      "device, else embree)");
    add_value(tradeoff, "--threads", "N", "CPU threads (default: all)");
    add_value(tradeoff, "--size", "WxH", "Size of the images (default: the scene's, else 512x512)");
    add_value(tradeoff, "--camera", "NAME", "Camera of the scene (default: its first)");
    add_reading(tradeoff);
    add_value(tradeoff, "--seed", "N", "First seed of the random numbers (default: 0)");
    add_value(tradeoff, "--progress", "MODE", "auto, plain or none (default: auto)");
    add_verbose(tradeoff);
}

TradeoffOptions read_tradeoff(const CLI::App& command) {
    TradeoffOptions options;
    options.scene = *value_of(command, "SCENE");
    options.output =
        value_of(command, "--output").value_or(options.scene.stem().string() + "-tradeoff");
    options.backend = read_backend(command);
    options.device = read_device(command);
    if (const auto text = value_of(command, "--size")) {
        options.size = parse_size("--size", *text);
        check_comparable(*options.size);
    }
    options.camera = value_of(command, "--camera");
    options.reading = parse_reading(command);
    read_measurement(command, options);
    read_questions(command, options);
    if (const auto text = value_of(command, "--references")) options.references = *text;
    if (const auto text = value_of(command, "--peers")) options.others = *text;
    options.verify = is_given(command, "--verify");
    options.progress = read_progress(command);
    options.verbose = is_given(command, "--verbose");
    return options;
}

void check_comparable(const FilmSize& size) {
    if (size.width < 2 || size.height < 2 ||
        std::size_t{size.width} * size.height > limits::max_hdr_vdp_pixels)
        throw usage_error(fmt::format(
            "--size: images of {} x {} pixels cannot be compared, expected at least 2 x 2 and at "
            "most {} pixels",
            size.width, size.height, limits::max_hdr_vdp_pixels));
}

std::string tradeoff_image_options(const TradeoffOptions& options) {
    std::string line;
    if (options.size)
        line += fmt::format(" --size {}x{}", options.size->width, options.size->height);
    if (options.camera) line += " --camera " + shell_word(*options.camera);
    line += reading_arguments(options.reading);
    if (options.backend) line += fmt::format(" --backend {}", to_string(*options.backend));
    if (options.device) line += " --device " + shell_word(*options.device);
    if (options.threads) line += fmt::format(" --threads {}", *options.threads);
    return line;
}

std::string tradeoff_command_line(const TradeoffOptions& options) {
    std::string line = "weft tradeoff " + shell_file(options.scene.string());
    if (options.quick) line += " --quick";
    line += tradeoff_image_options(options);
    if (!options.algorithms.empty())
        line += fmt::format(" --algorithms {}", fmt::join(options.algorithms, ","));
    line += fmt::format(" --measure {} --repetitions {}", to_string(options.measure),
                        options.repetitions);
    if (options.reference_spp_given)
        line += fmt::format(" --reference-spp {}", options.reference_spp);
    line += fmt::format(" --seed {}", options.seed);
    for (const double budget : options.budgets_ms) line += fmt::format(" --budget {}ms", budget);
    for (const double error : options.errors) line += fmt::format(" --error {}", error);
    if (options.others) line += " --peers " + shell_file(options.others->string());
    if (options.verify) line += " --verify";
    return line;
}

}  // namespace weft
