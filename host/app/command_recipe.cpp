// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/command_recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/camera_options.h"
#include "app/image_settings.h"
#include "app/reading_options.h"
#include "base/error.h"
#include "base/limits.h"
#include "base/shell_word.h"
#include "render/camera_params.h"
#include "render/camera_placement.h"
#include "scene/pose_scene.h"

namespace weft {
namespace {

// Images by algorithms that nothing leads on to the truth end here.
constexpr std::uint32_t most_samples = 64;
// Of a frame while the camera moves, by the adaptive algorithm, which can keep to it.
constexpr double moving_seconds = 0.07;

}  // namespace

ViewTimeline timeline_of(const Scene& scene, const EditTimeline& edits, double frame_rate) {
    constexpr std::uint64_t most = 1000000;
    std::uint64_t frames = 1;
    for (const SceneEdit& edit : edits.edits)
        frames = std::max<std::uint64_t>(frames, std::uint64_t{edit.until} + 1);
    const bool moves =
        is_animated(scene) || std::ranges::any_of(scene.cameras, [](const Camera& camera) {
            return camera.motion.moves();
        });
    double seconds = 0.0;
    for (const AnimationClip& clip : scene.animation.clips)
        seconds = std::max(seconds, clip.duration);
    if (moves) frames = std::max<std::uint64_t>(frames, frame_count(seconds, frame_rate));
    return {static_cast<std::uint32_t>(std::min(most, frames)), frame_rate};
}

std::vector<Algorithm> CommandRecipe::algorithms() const {
    std::vector<Algorithm> found;
    for (std::size_t i = 0; i < algorithm_names.size(); ++i) {
        const auto algorithm = static_cast<Algorithm>(i);
        // Media inside of surfaces are there for path tracing, or for none.
        const bool fits =
            !has_filled_surfaces() || is_reference(algorithm) == is_reference(options_.algorithm);
        const bool knows_all = algorithm != Algorithm::irradiance_cache ||
                               !(has_materials() || scene_.flat().media.present());
        if (fits && knows_all) found.push_back(algorithm);
    }
    return found;
}

ImageSettings CommandRecipe::settings(const ViewChoice& choice, FilmSize size, bool moving) const {
    RenderOptions options = options_of(choice);
    const std::vector<Algorithm> all = algorithms();
    if (std::ranges::find(all, options.algorithm) == all.end())
        throw Error(ExitCode::usage,
                    fmt::format("{} does not render what this scene holds, expected another "
                                "algorithm, or weft view with --algorithm {}",
                                to_string(options.algorithm), to_string(options.algorithm)));
    options.size = size;
    if (moving) {
        const bool is_slow =
            is_reference(options.algorithm) || options.algorithm == Algorithm::irradiance_cache;
        if (is_slow && !has_filled_surfaces()) options.algorithm = Algorithm::ais;
        options.spp = 1;
        if (options.algorithm == Algorithm::ais) options.frame_seconds = moving_seconds;
    } else if (choice.samples) {
        options.spp = choice.samples;
    } else if (goes_on(options)) {
        options.time_seconds = 1.0;
    } else {
        options.spp = most_samples;
    }
    check_media(options, scene_.flat());
    const RenderSettings common = image_settings(options, scene_.at_rest());
    check_orthographic(options, common, scene_.flat(), camera(choice));
    if (is_reference(options.algorithm)) return path_settings(options, common);
    return common;
}

std::optional<std::uint32_t> CommandRecipe::samples(const ViewChoice& choice) const {
    if (choice.samples) return choice.samples;
    if (goes_on(options_of(choice))) return {};
    return most_samples;
}

Camera CommandRecipe::camera(const ViewChoice& choice) const {
    const Scene& scene = scene_.at_rest();
    Diagnostics unheard;
    const Camera chosen = choice.camera.empty()
                              ? given_
                              : choose_camera(scene, scene_.flat(), choice.camera, unheard);
    const Camera placed = placed_camera(chosen, choice.placement);
    return has_frame(choice) ? camera_at(scene, placed, choice.frame / timeline_.rate) : placed;
}

FileOutputSettings CommandRecipe::output(const ViewChoice& choice,
                                         std::filesystem::path file) const {
    return {.file = std::move(file),
            .exposure_ev = choice.exposure_ev,
            .tone = choice.tone,
            .background = {},
            .overlays = false,
            .sums = {},
            .with_sums = false,
            .scene = options_.scene.filename().string()};
}

std::string CommandRecipe::command(const ViewChoice& choice, std::uint64_t samples) const {
    const RenderOptions options = options_of(choice);
    std::string line =
        "weft render " + shell_file(options.scene.string()) + reading_arguments(options.reading);
    const auto add = [&](const std::string& name, const std::string& value) {
        line += " " + name + " " + shell_word(value);
    };
    if (options.backend) add("--backend", std::string(to_string(*options.backend)));
    if (options.device) add("--device", *options.device);
    if (options.algorithm != default_algorithm)
        add("--algorithm", std::string(to_string(options.algorithm)));
    if (options.quality != Quality::preview && !is_reference(options.algorithm))
        add("--quality", std::string(to_string(options.quality)));
    add("--size", fmt::format("{}x{}", choice.size.width, choice.size.height));
    if (options.camera) add("--camera", *options.camera);
    const std::vector<std::string> placement = placement_arguments(options.placement);
    for (std::size_t i = 0; i + 1 < placement.size(); i += 2) add(placement[i], placement[i + 1]);
    if (has_frame(choice)) add("--frame", std::to_string(choice.frame));
    if (has_frame(choice) && timeline_.rate != default_frame_rate)
        add("--frame-rate", fmt::format("{}", timeline_.rate));
    if (!choice.edits.empty()) add("--edits", choice.edits);
    if (options.seed != 0) add("--seed", std::to_string(options.seed));
    if (choice.exposure_ev != 0.0) add("--exposure", fmt::format("{}", choice.exposure_ev));
    if (choice.tone != ToneCurve::none) add("--tone", std::string(to_string(choice.tone)));
    add("--spp", std::to_string(samples));
    return line + " -o view.png";
}

Preset CommandRecipe::preset(const ViewChoice& choice, std::uint64_t samples) const {
    Preset preset;
    preset.algorithm = choice.algorithm;
    preset.samples =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(samples, limits::max_samples_per_pixel));
    const ImageSettings found = settings(choice, choice.size, false);
    if (const auto* const preview = std::get_if<RenderSettings>(&found)) {
        preset.sampling = preview->sampling;
        preset.refined_after = preview->refined_after;
    }
    return preset;
}

std::vector<ViewCandidate> CommandRecipe::candidates(const ViewChoice& choice) const {
    std::vector<ViewCandidate> found;
    const auto add = [&](Algorithm algorithm, Quality quality, std::uint32_t samples) {
        ViewCandidate candidate{"", choice, samples};
        candidate.choice.algorithm = algorithm;
        candidate.choice.quality = quality;
        candidate.choice.samples = samples;
        candidate.name = is_reference(algorithm)
                             ? fmt::format("{}, samples: {}", to_string(algorithm), samples)
                             : fmt::format("{}, {}, samples: {}", to_string(algorithm),
                                           to_string(quality), samples);
        found.push_back(std::move(candidate));
    };
    const std::vector<Algorithm> all = algorithms();
    if (std::ranges::find(all, Algorithm::ais) == all.end()) {
        for (const std::uint32_t samples : {1U, 4U, 16U, 64U}) add(Algorithm::path, {}, samples);
        return found;
    }
    const bool media = !scene_.at_rest().media.empty();
    constexpr std::uint32_t more = 4;
    for (const Quality quality : {Quality::draft, Quality::preview, Quality::high})
        add(Algorithm::ais, quality, samples_of(quality, media));
    // Beyond its own samples a preview is led on to the truth.
    add(Algorithm::ais, Quality::preview, more * samples_of(Quality::preview, media));
    if (choice.algorithm != Algorithm::ais)
        add(choice.algorithm, choice.quality, choice.samples.value_or(more * more));
    return found;
}

RenderOptions CommandRecipe::options_of(const ViewChoice& choice) const {
    RenderOptions options = options_;
    options.algorithm = choice.algorithm;
    options.quality = choice.quality;
    if (!choice.camera.empty()) options.camera = choice.camera;
    options.placement = choice.placement;
    return options;
}

bool CommandRecipe::goes_on(RenderOptions options) const {
    if (is_reference(options.algorithm)) return true;
    options.time_seconds = 1.0;
    return image_settings(options, scene_.at_rest()).refined_after > 0;
}

}  // namespace weft
