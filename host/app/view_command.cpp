// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>

#include "app/choose_executor.h"
#include "app/command_recipe.h"
#include "app/commands.h"
#include "app/frame_options.h"
#include "app/image_settings.h"
#include "app/interrupt.h"
#include "app/print.h"
#include "app/thread_limit.h"
#include "base/free_memory.h"
#include "render/camera_params.h"
#include "scene/load/load_scene.h"
#include "scene/moving_scene.h"
#include "view/view_edits.h"
#include "view/view_loop.h"
#include "view/view_server.h"
#include "view/view_token.h"

namespace weft {
namespace {

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

/// Brings the scene to the frame that a view begins with, and edits it as its options say. Returns
/// these edits. Throws Error as MovingScene::set_edits does.
EditTimeline begin_with(const RenderOptions& options, MovingScene& scene, ViewChoice& choice) {
    if (!options.edits) {
        scene.set_frame(choice.frame);
        return {};
    }
    const GivenEdits given = given_edits(*options.edits);
    EditTimeline edits;
    (void)scene.set_edits(
        [&](Scene& at_rest) {
            edits = read_scene_edits(given.json, given.place, at_rest);
            return edits;
        },
        choice.frame);
    choice.edits = ViewEdits(given.json).text();
    return edits;
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
    map_large_blocks();
    const ThreadLimit limit(image.threads);
    Scene scene = load_scene(image.scene, diagnostics, image.reading);
    if (!is_reference(image.algorithm)) empty_surfaces(scene);
    MovingScene moving(std::move(scene), {}, image.frame_rate);
    Diagnostics unheard;
    const Camera given = choose_camera(moving.at_rest(), moving.flat(), image.camera.value_or(""),
                                       image.placement.view ? unheard : diagnostics);
    warn_about_darkness(moving.flat(), moving.at_rest().source, diagnostics);
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
    const EditTimeline edits = begin_with(image, moving, choice);
    const ViewTimeline timeline = timeline_of(moving.at_rest(), edits, image.frame_rate);
    const CommandRecipe first(image, moving, given, timeline);
    const ImageSettings settings = first.settings(choice, choice.size, false);
    const Camera camera = first.camera(choice);
    // The page shows the last frame alone, and a view makes millions.
    constexpr std::size_t kept_frames = 16;
    RenderSession session(std::move(executor), std::move(moving), camera, settings, kept_frames);
    const CommandRecipe recipe(image, session.scene(), given, timeline);
    ViewLoop loop(session, recipe, choice, options.folder, diagnostics);
    const std::string token = make_view_token();
    ViewServer server({options.port, options.socket}, token, loop);
    print_address(options, server, token);
    guard.keep_work();
    loop.run(server, interrupt_flag());
    return ExitCode::success;
}

}  // namespace weft
