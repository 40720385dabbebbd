// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/references/references_run.h"

#include <algorithm>
#include <limits>

#include "base/diagnostics.h"
#include "base/error.h"
#include "base/stopwatch.h"
#include "bench/tables/shipped_scenes.h"
#include "device/shared_scene.h"
#include "plan/algorithm.h"
#include "render/camera_params.h"
#include "scene/flat_scene.h"
#include "scene/load/load_scene.h"
#include "scene/pose_scene.h"
#include "tradeoff/error_values.h"
#include "tradeoff/image_errors.h"

namespace weft::bench {
namespace {

namespace fs = std::filesystem;

/// A reference to make, and how many minutes it has had.
struct Task {
    const BenchScene* scene;
    ReferenceRow row;
    bool ended = false;  ///< its limit is reached
};

ReferenceWish wish_of(const ReferencesRun& run, const Task& task) {
    ReferenceWish wish{fs::path(task.scene->name).stem().string(), run.size,
                       task.row.filter == "centre", run.spp};
    wish.algorithm = run.algorithm;
    return wish;
}

void describe(const Reference& made, const FloorGoal& goal, ReferenceRow& row) {
    row.algorithm = made.algorithm();
    row.file = made.file.filename().string();
    row.samples = made.samples;
    row.seconds = made.seconds();
    row.floor = made.floor;
    row.reached = made.floor && made.floor->within(goal.floor);
    row.noise_relmse = noise_relmse_of(made.image);
    const auto between_halves = floor_errors(made.image, {.visible = false});
    if (!between_halves) return;
    row.hdrflip = between_halves->hdrflip;
    row.relmse = between_halves->relmse;
}

/// Lets a reference grow for some minutes.
void take_turn(const ReferencesRun& run, double minutes, Executor& executor, Task& task) {
    Diagnostics diagnostics;
    Scene scene = task.scene->load(diagnostics);
    hold_still(scene);
    const FlatScene flat = flatten(scene);
    const Camera camera = choose_camera(scene, flat, "", diagnostics);
    SharedScene shared(executor);
    ReferenceImages references(run.folder, shared, run.say,
                               [&](double) { return run.keep_going(); });
    FloorGoal goal = run.goal;
    goal.most_seconds = 60.0 * minutes;
    describe(references.reach(flat, camera, wish_of(run, task), goal), run.goal, task.row);
    task.ended = task.row.samples + 1 >= run.goal.most_spp;
}

std::vector<ReferenceRow> rows_of(const std::vector<Task>& tasks) {
    std::vector<ReferenceRow> rows;
    for (const Task& task : tasks) rows.push_back(task.row);
    return rows;
}

}  // namespace

std::vector<BenchScene> all_shipped_scenes(const fs::path& folder) {
    std::vector<BenchScene> scenes = load_shipped_scenes(folder);
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".gltf") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (const fs::path& file : files) {
        const std::string name = file.filename().string();
        const auto is_it = [&](const BenchScene& scene) { return scene.name == name; };
        if (std::none_of(scenes.begin(), scenes.end(), is_it))
            scenes.push_back(
                {name, [file](Diagnostics& diagnostics) { return load_scene(file, diagnostics); },
                 file});
    }
    return scenes;
}

std::vector<ReferenceRow> make_references(const ReferencesRun& run, Executor& executor,
                                          int& status) {
    std::vector<Task> tasks;
    for (const BenchScene& scene : run.scenes)
        for (const std::string& filter : run.filters) {
            tasks.push_back({&scene, {}});
            tasks.back().row.scene = scene.name;
            tasks.back().row.filter = filter;
            tasks.back().row.algorithm = to_string(run.algorithm);
        }
    const auto wants_turn = [](const Task& task) { return task.row.wants_more() && !task.ended; };
    for (std::uint32_t turn = 0; std::any_of(tasks.begin(), tasks.end(), wants_turn); ++turn) {
        for (Task& task : tasks) {
            if (!wants_turn(task)) continue;
            const double minutes = turn_minutes(turn, task.row.minutes, run.limit_minutes);
            const Stopwatch watch;
            try {
                take_turn(run, minutes, executor, task);
            } catch (const Error& error) {
                if (error.code() == ExitCode::interrupted) {
                    run.report(rows_of(tasks));
                    throw;
                }
                task.row.failure = error.what();
                run.say(task.row.scene + ": " + task.row.failure);
                if (status == 0) status = static_cast<int>(error.code());
            }
            task.row.minutes += watch.total() / 60e3;
            if (task.row.minutes >= run.limit_minutes) task.ended = true;
            run.report(rows_of(tasks));
        }
    }
    return rows_of(tasks);
}

}  // namespace weft::bench
