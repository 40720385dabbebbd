// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/algorithm_options.h"
#include "app/background_options.h"
#include "app/camera_options.h"
#include "app/command_line.h"
#include "app/compare_options.h"
#include "app/device_options.h"
#include "app/merge_options.h"
#include "app/overlay_output.h"
#include "app/selftest_options.h"
#include "app/tev_options.h"
#include "app/tradeoff_options.h"
#include "app/view_options.h"
#include "base/error.h"
#include "base/json_text.h"
#include "base/limits.h"
#include "base/quote.h"
#include "base/shell_word.h"
#include "components/component.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// In the order of the enumerations.
constexpr std::array<std::string_view, 3> progress_names = {"auto", "plain", "none"};
constexpr std::array<std::string_view, 2> matte_names = {"object", "material"};
constexpr std::array<std::string_view, 8> command_names = {
    "render", "view", "merge", "compare", "tradeoff", "info", "devices", "selftest"};

void add_render(CLI::App& app) {
    CLI::App& render = add_command(app, "render", "Renders a scene to an EXR or PNG file");
    add_scene(render);
    add_value(render, "-o,--output", "FILE",
              "Image to write, .exr or .png (default: the scene's name with .exr, in the current "
              "folder)");
    add_algorithm(render);
    add_device_choice(
        render,
        "opencl, embree, or native: as embree, but tracing with Weft's own BVH (default: opencl "
        "where there is a device, else embree)");
    add_value(render, "--threads", "N", "CPU threads (default: all)");
    add_value(render, "--tile", "N", "Edge of a tile in pixels (default: 64)");
    add_value(render, "--size", "WxH", "Size of the image (default: the scene's, else 512x512)");
    add_camera(render);
    add_reading(render);
    add_frames(render);
    add_value(render, "--components", "LIST",
              fmt::format("Any of {} (default: {})", fmt::join(choosable_components(), ","),
                          fmt::join(choosable_components(Choice::by_default), ",")));
    add_value(
        render, "--spp", "N",
        "Samples per pixel (default: 6 of ais, 64 of path, else 1, or what fits into --time)");
    add_value(render, "--samples", "A:B",
              "Only samples A to B - 1 of a path-traced image, for `weft merge`");
    add_value(render, "--part", "I/N",
              "Only part I of the N equal parts, from 1 on, of the samples that --spp says");
    add_flag(render, "--keep-complete",
             "Renders nothing where the output has just these samples already");
    add_value(render, "--target-error", "E",
              "Ends path tracing at this relative standard error of the image's mean");
    add_value(render, "--resume", "FILE",
              "Keeps the exact sums of path tracing in this .exr file and goes on from there");
    add_value(render, "--checkpoint", "T",
              "Time between two savings of --resume, such as 10s (default: 60s)");
    add_value(render, "--pixel-filter", "NAME",
              "Of path tracing: box, or centre: every sample through the pixel's centre (default: "
              "box)");
    add_value(render, "--max-bounces", "N",
              "Ends the paths of path after N scatterings, for comparisons (default: no end)");
    add_value(render, "--denoise", "NAME",
              "Removes noise: statistical, of path and reference, or oidn, by Open Image Denoise "
              "(default: none)");
    add_value(render, "--time", "T", "Total wall time, such as 300ms, 2.5s or 2m");
    add_value(render, "--frame-time", "T", "Of ais: wall time of each frame, such as 300ms");
    add_value(render, "--seed", "N", "Seed of all random numbers (default: 0)");
    add_value(render, "--exposure", "EV|auto", "Exposure of a PNG in stops (default: 0)");
    add_value(render, "--tone", "NAME", "Tone curve of a PNG: none, filmic or agx (default: none)");
    add_value(
        render, "--background", "COLOUR|transparent",
        "Behind what the camera sees: white, black, #rrggbb or linear R,G,B, or nothing, with "
        "alpha (default: the environment)");
    add_value(render, "--cryptomatte", "LIST",
              "Identifiers of what pixels show as layers of an EXR: object, material or both");
    add_overlays(render);
    add_tev(render);
    add_value(render, "--stats", "FILE", "Writes times, counts and settings as JSON");
    add_value(render, "--progress", "MODE", "auto, plain or none (default: auto)");
    add_verbose(render);
}

void add_commands(CLI::App& app) {
    app.set_help_flag("-h,--help", "Prints this text");
    app.get_formatter()->label("SUBCOMMAND", "COMMAND");
    add_flag(app, "--version", "Prints the version");
    app.allow_extras();  // this file words the errors itself
    app.require_subcommand(0, 1);
    add_render(app);
    add_view(app);
    add_merge(app);
    add_compare(app);
    add_tradeoff(app);
    CLI::App& info = add_command(app, "info", "Says what a scene holds, and what is approximated");
    add_scene(info);
    add_reading(info);
    add_flag(info, "--json", "Prints JSON");
    add_verbose(info);
    CLI::App& devices = add_command(app, "devices", "Lists what can render");
    add_flag(devices, "--json", "Prints JSON");
    add_flag(devices, "--check", "Tries every device again, and fails where one does not work");
    add_selftest(app);
    for (CLI::App* command : app.get_subcommands({})) {
        command->group("Commands");
        command->add_flag("--version")->group("");  // works everywhere, listed once
    }
    // After the commands, which would inherit it.
    app.footer(
        "To begin: weft render scene.gltf -o image.png\n"
        "weft COMMAND --help lists the options of a command.");
}

/// The help of the command that is being parsed.
std::string help_text(CLI::App& app) {
    // Commands and arguments are required only here: parsing would stop at a less helpful error.
    app.require_subcommand(1);
    for (CLI::App* command : app.get_subcommands({}))
        for (CLI::Option* option : command->get_options())
            if (option->get_positional()) option->required();
    return app.help();
}

/// Arguments that were not understood, without the `--` that ends the options.
std::vector<std::string> unknown_arguments(const CLI::App& command) {
    std::vector<std::string> arguments = command.remaining();
    std::erase(arguments, "--");
    return arguments;
}

[[noreturn]] void refuse_extra(const CLI::App& command, const std::string& extra) {
    if (extra.size() < 2 || extra[0] != '-')
        throw usage_error("unexpected argument " + quote(extra));
    const std::string name = extra.substr(0, extra.find('='));
    std::vector<std::string> own;
    for (const CLI::Option* option : command.get_options())
        for (const std::string& long_name : option->get_lnames()) own.push_back("--" + long_name);
    const std::vector<std::string_view> names(own.begin(), own.end());
    const bool misplaced = command.get_parent() == nullptr && name.size() > 2;
    const std::string hint = did_you_mean(name, names);
    throw usage_error("unknown option " + quote(name) +
                      (hint.empty() && misplaced ? ", expected a command first" : hint));
}

/// Refuses an option that has swallowed the next one as its value.
void check_values(const CLI::App& command) {
    for (const CLI::Option* option : command.get_options())
        for (const std::string& value : option->results())
            if (value.starts_with("--") && command.get_option_no_throw(value) != nullptr)
                throw usage_error(option->get_name() + ": lacks its value");
}

bool is_scene_name(const fs::path& name) {
    constexpr std::array<std::string_view, 5> extensions = {".gltf", ".glb", ".xml", ".obj",
                                                            ".ply"};
    return std::find(extensions.begin(), extensions.end(), extension_of(name)) != extensions.end();
}

/// Arguments in which `help` as the first word is --help as the last.
std::vector<const char*> with_help_as_option(int argc, const char* const* argv) {
    std::vector<const char*> arguments(argv, argv + argc);
    if (argc < 2 || std::string_view(argv[1]) != "help") return arguments;
    arguments.erase(arguments.begin() + 1);
    arguments.push_back("--help");
    return arguments;
}

/// Refuses arguments that CLI11 left over, and a missing scene.
void check_command(const CLI::App& app, const CLI::App* command) {
    const std::vector<std::string> before = unknown_arguments(app);
    if (!before.empty()) {
        if (before[0][0] == '-' || command != nullptr) refuse_extra(app, before[0]);
        if (is_scene_name(before[0]))
            throw usage_error("unknown command " + quote(before[0]) + ", expected weft render " +
                              one_line(shell_file(before[0])));
        throw usage_error(
            "unknown command " + quote(before[0]) +
            ", expected render, view, merge, compare, tradeoff, info, devices or selftest" +
            did_you_mean(before[0], command_names));
    }
    if (command == nullptr)
        throw usage_error(
            "no command given, expected render, view, merge, compare, tradeoff, info, devices or "
            "selftest (see weft --help)");
    check_values(*command);
    const std::vector<std::string> extras = unknown_arguments(*command);
    const auto option = std::find_if(extras.begin(), extras.end(), [](const std::string& extra) {
        return extra.size() > 1 && extra[0] == '-';
    });
    // A mistyped option comes first, since its value turns up as a superfluous argument, too.
    if (option != extras.end()) refuse_extra(*command, *option);
    if (!extras.empty()) refuse_extra(*command, extras[0]);
    if (command->get_option_no_throw("SCENE") != nullptr && !value_of(*command, "SCENE"))
        throw usage_error("no scene given, expected weft " + command->get_name() + " SCENE");
    if (command->get_option_no_throw("TEST") != nullptr && !value_of(*command, "TEST"))
        throw usage_error("two images are needed, expected weft compare REF TEST");
}

fs::path output_path(const std::optional<std::string>& given, const fs::path& scene) {
    if (!given) return scene.stem().string() + ".exr";
    fs::path path = *given;
    const std::string extension = extension_of(path);
    if (extension != ".exr" && extension != ".png")
        throw usage_error("--output: " + quote(*given) +
                          " has no known extension, expected .exr or .png");
    return path;
}

void read_sampling(const CLI::App& command, RenderOptions& options) {
    constexpr std::uint32_t max_uint = std::numeric_limits<std::uint32_t>::max();
    if (const auto text = value_of(command, "--threads"))
        options.threads = parse_unsigned("--threads", *text, 1, limits::max_threads);
    if (const auto text = value_of(command, "--tile"))
        options.tile = parse_unsigned("--tile", *text, 1, limits::max_tile_edge);
    if (const auto text = value_of(command, "--spp"))
        options.spp = parse_unsigned("--spp", *text, 1, limits::max_samples_per_pixel);
    if (const auto text = value_of(command, "--time"))
        options.time_seconds = parse_duration("--time", *text);
    if (const auto text = value_of(command, "--frame-time"))
        options.frame_seconds = parse_duration("--frame-time", *text);
    if (const auto text = value_of(command, "--seed"))
        options.seed = parse_unsigned("--seed", *text, 0, max_uint);
}

void read_image(const CLI::App& command, RenderOptions& options) {
    if (const auto text = value_of(command, "--size")) options.size = parse_size("--size", *text);
    options.camera = value_of(command, "--camera");
    options.placement = read_placement(command);
    if (const auto text = value_of(command, "--components"))
        options.components = parse_name_list("--components", *text, choosable_components());
    if (const auto text = value_of(command, "--exposure")) {
        if (*text == "auto")
            options.exposure_ev.reset();
        else
            options.exposure_ev =
                parse_number("--exposure", *text, -max_exposure_ev, max_exposure_ev, "auto");
    }
    if (const auto text = value_of(command, "--tone"))
        options.tone = static_cast<ToneCurve>(parse_name("--tone", *text, tone_names));
    if (const auto text = value_of(command, "--background"))
        options.background = parse_background("--background", *text);
    options.output = output_path(value_of(command, "--output"), options.scene);
    if (const auto text = value_of(command, "--cryptomatte")) {
        for (const std::string& name : parse_name_list("--cryptomatte", *text, matte_names))
            (name == matte_names[0] ? options.object_mattes : options.material_mattes) = true;
        if (extension_of(options.output) != ".exr")
            throw usage_error(
                "--cryptomatte: needs a file with layers, expected an .exr file as "
                "--output");
    }
}

RenderOptions read_render(const CLI::App& command) {
    RenderOptions options;
    options.scene = *value_of(command, "SCENE");
    options.backend = read_backend(command);
    options.device = read_device(command);
    options.reading = parse_reading(command);
    read_sampling(command, options);
    read_image(command, options);
    read_algorithm(command, options);
    options.tev = read_tev(command);
    if (const auto text = value_of(command, "--stats")) options.stats = *text;
    options.progress = read_progress(command);
    options.verbose = is_given(command, "--verbose");
    const std::array<std::pair<const char*, fs::path>, 3> others{
        {{"--output", options.output},
         {"the scene", options.scene},
         {"--preset", options.preset_file.value_or(fs::path())}}};
    for (const auto& [name, file] : others)
        if (options.stats && options.stats->lexically_normal() == file.lexically_normal())
            throw usage_error(std::string("--stats: names the same file as ") + name);
    read_frames(command, options);
    read_overlays(command, options);
    return options;
}

/// Text as valid UTF-8, which JSON needs and file names need not be.
nlohmann::json json_text(const std::string& text) {
    using nlohmann::json;
    return json::parse(json_line(text));
}

template <typename Value>
nlohmann::json json_or_null(const std::optional<Value>& value) {
    return value ? nlohmann::json(*value) : nlohmann::json();
}

}  // namespace

ProgressMode read_progress(const CLI::App& command) {
    const auto text = value_of(command, "--progress");
    return text ? static_cast<ProgressMode>(parse_name("--progress", *text, progress_names))
                : ProgressMode::automatic;
}

std::string_view to_string(ProgressMode mode) {
    return progress_names.at(static_cast<std::size_t>(mode));
}

bool RenderOptions::names_component(std::string_view name) const {
    return components &&
           std::find(components->begin(), components->end(), name) != components->end();
}

ParsedCommand parse_command_line(int argc, const char* const* argv) {
    CLI::App app("Weft, a portable global-illumination renderer.", "weft");
    add_commands(app);
    try {
        const std::vector<const char*> arguments = with_help_as_option(argc, argv);
        app.parse(static_cast<int>(arguments.size()), arguments.data());
    } catch (const CLI::CallForHelp&) {
        return HelpText{help_text(app)};
    } catch (const CLI::ArgumentMismatch& error) {
        const std::string message = error.what();
        const std::size_t flag = message.find(" was given a disallowed flag override");
        if (flag != std::string::npos)
            throw usage_error("--" + message.substr(0, flag) + ": takes no value");
        if (message.find(" required ") == std::string::npos) throw usage_error(message);
        throw usage_error(message.substr(0, message.find(':')) + ": lacks its value");
    } catch (const CLI::ParseError& error) {
        std::string message = error.what();
        std::replace(message.begin(), message.end(), '\n', ' ');
        throw usage_error(message);
    }
    const std::vector<CLI::App*> selected = app.get_subcommands();
    const CLI::App* command = selected.empty() ? nullptr : selected.front();
    if (is_given(app, "--version") || (command != nullptr && is_given(*command, "--version")))
        return HelpText{"weft " WEFT_VERSION "\n"};
    check_command(app, command);
    if (command->get_name() == "render") return read_render(*command);
    if (command->get_name() == "view") return read_view(*command);
    if (command->get_name() == "merge") return read_merge(*command);
    if (command->get_name() == "compare") return read_compare(*command);
    if (command->get_name() == "tradeoff") return read_tradeoff(*command);
    if (command->get_name() == "selftest") return read_selftest(*command);
    if (command->get_name() == "info")
        return InfoOptions{*value_of(*command, "SCENE"), parse_reading(*command),
                           is_given(*command, "--json"), is_given(*command, "--verbose")};
    return DevicesOptions{is_given(*command, "--json"), is_given(*command, "--check")};
}

nlohmann::json options_json(const RenderOptions& options) {
    nlohmann::json json;
    json["scene"] = json_text(options.scene.string());
    json["output"] = json_text(options.output.string());
    json["algorithm"] = to_string(options.algorithm);
    json["backend"] = options.backend ? nlohmann::json(to_string(*options.backend)) : nullptr;
    json["device"] = options.device ? json_text(*options.device) : nullptr;
    json["threads"] = json_or_null(options.threads);
    json["tile"] = options.tile;
    json["size"] = nullptr;
    if (options.size) json["size"] = {options.size->width, options.size->height};
    json["camera"] = options.camera ? json_text(*options.camera) : nullptr;
    add_placement_json(options.placement, json);
    json["light"] = light_choice_json(options.reading.light);
    json["environment"] = nullptr;
    if (!options.reading.environment.empty())
        json["environment"] = json_text(options.reading.environment.string());
    json["environment_rotation"] = options.reading.environment_rotation;
    json["materials"] = material_detail_name(options.reading.materials);
    json["frames"] = nullptr;
    if (options.frames) json["frames"] = {options.frames->first, options.frames->end};
    json["frame"] = json_or_null(options.frame);
    json["frame_rate"] = options.frame_rate;
    json["edits"] = options.edits ? json_text(options.edits->string()) : nullptr;
    json["components"] = json_or_null(options.components);
    json["spp"] = json_or_null(options.spp);
    json["samples"] = nullptr;
    if (options.samples) json["samples"] = {options.samples->first, options.samples->end};
    json["target_error"] = json_or_null(options.target_error);
    json["resume"] = options.resume ? json_text(options.resume->string()) : nullptr;
    json["quality"] = options.preset ? nlohmann::json() : to_string(options.quality);
    json["preset"] = options.preset_file ? json_text(options.preset_file->string()) : nullptr;
    json["indirect"] = options.indirect ? nlohmann::json(to_string(*options.indirect)) : nullptr;
    json["cache_records"] = json_or_null(options.cache_records);
    json["cache_masks"] = options.cache_masks ? "on" : "off";
    json["cache_rays"] = json_or_null(options.cache_rays);
    json["cache_error"] = json_or_null(options.cache_error);
    json["vpl_compensation"] = options.compensation;
    json["max_bounces"] = json_or_null(options.most_bounces);
    json["pixel_filter"] = options.through_centres ? "centre" : "box";
    json["denoise"] = to_string(options.denoiser);
    json["time"] = json_or_null(options.time_seconds);
    json["frame_time"] = json_or_null(options.frame_seconds);
    json["seed"] = options.seed;
    json["overlays"] = options.overlays;
    json["exposure"] = options.exposure_ev ? nlohmann::json(*options.exposure_ev) : "auto";
    json["tone"] = to_string(options.tone);
    json["background"] =
        options.background ? nlohmann::json(to_string(*options.background)) : nullptr;
    json["cryptomatte"] = nlohmann::json::array();
    if (options.object_mattes) json["cryptomatte"].push_back(matte_names[0]);
    if (options.material_mattes) json["cryptomatte"].push_back(matte_names[1]);
    json["tev"] = nullptr;
    if (options.tev)
        json["tev"] = {{"host", json_text(options.tev->host)}, {"port", options.tev->port}};
    json["stats"] = options.stats ? json_text(options.stats->string()) : nullptr;
    json["progress"] = to_string(options.progress);
    json["verbose"] = options.verbose;
    return json;
}

}  // namespace weft
