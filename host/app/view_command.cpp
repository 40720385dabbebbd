// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "app/camera_options.h"
#include "app/choose_executor.h"
#include "app/commands.h"
#include "app/image_settings.h"
#include "app/interrupt.h"
#include "app/print.h"
#include "app/reading_options.h"
#include "app/thread_limit.h"
#include "base/shell_word.h"
#include "render/camera_params.h"
#include "render/camera_placement.h"
#include "scene/load/load_scene.h"
#include "scene/moving_scene.h"
#include "scene/pose_scene.h"
#include "view/view_loop.h"
#include "view/view_server.h"
#include "view/view_token.h"

namespace weft {
namespace {

// Images by algorithms that nothing leads on to the truth end here.
constexpr std::uint32_t most_samples = 64;
// Of a frame while the camera moves, by the adaptive algorithm, which can keep to it.
constexpr double moving_seconds = 0.07;

/// Says how `weft render` renders what a view shows, with the options of the view.
class CommandRecipe : public ViewRecipe {
  public:
    /// `given`: the camera that the view begins with.
    CommandRecipe(const RenderOptions& options, const MovingScene& scene, Camera given)
        : options_(options), scene_(scene), given_(std::move(given)) {}

    [[nodiscard]] std::vector<Algorithm> algorithms() const override {
        std::vector<Algorithm> found;
        for (std::size_t i = 0; i < algorithm_names.size(); ++i) {
            const auto algorithm = static_cast<Algorithm>(i);
            // Materials that are more than diffuse are there for path tracing, or for none.
            const bool fits =
                !has_materials() || is_reference(algorithm) == is_reference(options_.algorithm);
            const bool knows_media =
                !scene_.flat().media.present() || algorithm != Algorithm::irradiance_cache;
            if (fits && knows_media) found.push_back(algorithm);
        }
        return found;
    }

    [[nodiscard]] ImageSettings settings(const ViewChoice& choice, FilmSize size,
                                         bool moving) const override {
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
            if (is_slow && !has_materials()) options.algorithm = Algorithm::ais;
            options.spp = 1;
            if (options.algorithm == Algorithm::ais) options.frame_seconds = moving_seconds;
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

    [[nodiscard]] std::optional<std::uint32_t> samples(const ViewChoice& choice) const override {
        if (goes_on(options_of(choice))) return {};
        return most_samples;
    }

    [[nodiscard]] Camera camera(const ViewChoice& choice) const override {
        if (choice.camera.empty()) return placed_camera(given_, choice.placement);
        Diagnostics unheard;
        return placed_camera(choose_camera(scene_.at_rest(), scene_.flat(), choice.camera, unheard),
                             choice.placement);
    }

    [[nodiscard]] FileOutputSettings output(const ViewChoice& choice,
                                            std::filesystem::path file) const override {
        return {.file = std::move(file),
                .exposure_ev = choice.exposure_ev,
                .tone = choice.tone,
                .background = {},
                .overlays = false,
                .sums = {},
                .with_sums = false,
                .scene = options_.scene.filename().string()};
    }

    [[nodiscard]] std::string command(const ViewChoice& choice,
                                      std::uint64_t samples) const override {
        const RenderOptions options = options_of(choice);
        std::string line = "weft render " + shell_file(options.scene.string()) +
                           reading_arguments(options.reading);
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
        for (std::size_t i = 0; i + 1 < placement.size(); i += 2)
            add(placement[i], placement[i + 1]);
        if (options.seed != 0) add("--seed", std::to_string(options.seed));
        if (choice.exposure_ev != 0.0) add("--exposure", fmt::format("{}", choice.exposure_ev));
        if (choice.tone != ToneCurve::none) add("--tone", std::string(to_string(choice.tone)));
        add("--spp", std::to_string(samples));
        return line + " -o view.png";
    }

  private:
    /// Whether some materials are more than diffuse.
    [[nodiscard]] bool has_materials() const { return scene_.flat().surfaces.present(); }
    [[nodiscard]] RenderOptions options_of(const ViewChoice& choice) const {
        RenderOptions options = options_;
        options.algorithm = choice.algorithm;
        options.quality = choice.quality;
        if (!choice.camera.empty()) options.camera = choice.camera;
        options.placement = choice.placement;
        return options;
    }

    /// Whether samples lead such an image on to the truth for ever.
    [[nodiscard]] bool goes_on(RenderOptions options) const {
        if (is_reference(options.algorithm)) return true;
        options.time_seconds = 1.0;
        return image_settings(options, scene_.at_rest()).refined_after > 0;
    }

    const RenderOptions& options_;
    const MovingScene& scene_;
    Camera given_;
};

void print_address(const ViewOptions& options, const ViewServer& server, const std::string& token) {
    if (options.socket) {
        constexpr int any_port = 8123;
        print_result(fmt::format(
            "Serving a view. From another machine: ssh -N -L {0}:{1} USER@THIS-MACHINE\n"
            "then open http://localhost:{0}/#{2}\nCtrl-C ends it.\n",
            any_port, std::filesystem::absolute(*options.socket).string(), token));
        return;
    }
    print_result(
        fmt::format("Open http://127.0.0.1:{0}/#{1}\n"
                    "From another machine, first: ssh -N -L {0}:127.0.0.1:{0} "
                    "USER@THIS-MACHINE\nCtrl-C ends it.\n",
                    server.port(), token));
}

}  // namespace

ExitCode view_command(const ViewOptions& options, Diagnostics& diagnostics) {
    RenderOptions image = options.image;
    InterruptGuard guard("weft: interrupted");
    if (!options.folder.empty()) {
        std::error_code error;
        std::filesystem::create_directories(options.folder, error);
        if (!std::filesystem::is_directory(options.folder, error))
            throw Error(ExitCode::output, options.folder.string(),
                        "is no folder, expected one to write to");
    }
    const ThreadLimit limit(image.threads);
    Scene scene = load_scene(image.scene, diagnostics, image.reading);
    hold_still(scene);
    if (!is_reference(image.algorithm)) empty_surfaces(scene);
    MovingScene moving(std::move(scene), {}, image.frame_rate);
    Diagnostics unheard;
    const Camera given = choose_camera(moving.at_rest(), moving.flat(), image.camera.value_or(""),
                                       image.placement.view ? unheard : diagnostics);
    warn_about_darkness(moving.flat(), moving.at_rest().source, diagnostics);
    if (moving.flat().surfaces.present() && !is_reference(image.algorithm))
        diagnostics.warn(image.scene.string(),
                         "some materials are more than diffuse, the view renders them as diffuse, "
                         "expected --algorithm path");
    std::unique_ptr<Executor> executor = choose_executor(image, diagnostics);
    print_warnings(diagnostics, image.verbose);
    image.size = image.size.value_or(moving.at_rest().film.value_or(FilmSize{512, 512}));
    ViewChoice choice;
    choice.algorithm = image.algorithm;
    choice.quality = image.quality;
    choice.size = *image.size;
    choice.exposure_ev = image.exposure_ev.value_or(0.0);
    choice.tone = image.tone;
    choice.placement = image.placement;
    const CommandRecipe first(image, moving, given);
    const ImageSettings settings = first.settings(choice, choice.size, false);
    const Camera camera = first.camera(choice);
    RenderSession session(std::move(executor), std::move(moving), camera, settings);
    const CommandRecipe recipe(image, session.scene(), given);
    ViewLoop loop(session, recipe, choice, options.folder, diagnostics);
    const std::string token = make_view_token();
    ViewServer server({options.port, options.socket}, token, loop);
    print_address(options, server, token);
    guard.keep_work();
    loop.run(server, interrupt_flag());
    return ExitCode::success;
}

}  // namespace weft
