// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/dynamic_run.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "bench/dynamic/dynamic_frames.h"
#include "bench/dynamic/dynamic_report.h"
#include "bench/dynamic/sequence_errors.h"
#include "bench/dynamic/thumbnails.h"
#include "image/png.h"
#include "render/camera_params.h"
#include "scene/flat_scene.h"
#include "scene/pose_scene.h"

namespace weft::bench {
namespace {

/// Small images of the first, the middle and the last frame, all with one exposure.
class ContactSheet {
  public:
    ContactSheet(const DynamicRun& run, std::string sequence)
        : run_(run), sequence_(std::move(sequence)) {}

    void begin(const Image& reference) {
        if (!exposed_ && !run_.images.empty()) exposure_ = auto_exposure(reference);
        exposed_ = true;
    }
    /// The entry of an image for JSON; null where none is wanted of this frame.
    nlohmann::json add(const std::string& method, const Image& image, std::uint32_t frame) const {
        if (run_.images.empty() ||
            (frame > 0 && frame != run_.frames / 2 && frame + 1 != run_.frames))
            return {};
        return {{"frame", frame},
                {"file", write_thumbnail(run_.images,
                                         sequence_ + "-" + method + "-" + std::to_string(frame),
                                         image, exposure_)}};
    }

  private:
    const DynamicRun& run_;
    std::string sequence_;
    bool exposed_ = false;
    double exposure_ = 0.0;  // stops
};

void append(nlohmann::json& list, nlohmann::json entry) {
    if (!entry.is_null()) list.push_back(std::move(entry));
}

/// A method under way, with what it has so far.
struct Entrant {
    Entrant(Executor& executor, const DynamicMethod& method, std::uint32_t edge)
        : renderer(executor, method, edge) {}

    DynamicRenderer renderer;
    Image before{};
    nlohmann::json frames = nlohmann::json::array();
    nlohmann::json images = nlohmann::json::array();
};

bool asks_visible(const DynamicRun& run, std::uint32_t frame) {
    return run.visible == Visible::all || (run.visible == Visible::last && frame + 1 == run.frames);
}

void render_entrant(Entrant& entrant, const FlatScene& flat, const Camera& camera,
                    const SequenceJudge& judge, const ContactSheet& sheet, std::uint32_t frame) {
    DynamicFrame made = entrant.renderer.render(flat, camera);
    const FrameErrors errors = judge.judge(frame > 0 ? &entrant.before : nullptr, made.light);
    entrant.frames.push_back(frame_json(made, errors));
    append(entrant.images, sheet.add(entrant.renderer.method().name, made.light, frame));
    entrant.before = std::move(made.light);
}

/// Records that were compared with what they would be if computed anew.
struct Validation {
    std::uint64_t frames = 0;  ///< in which anything was
    std::uint64_t compared = 0;
    std::uint64_t differing = 0;
    std::uint64_t traced = 0;
    std::uint64_t affected = 0;

    void add(const DynamicFrame& frame) {
        // Light paths are only checked where something has changed, and only then all is compared.
        const bool followed = std::any_of(
            frame.stages.begin(), frame.stages.end(),
            [](const StageStats& stage) { return stage.stage == Stage::vpl_invalidation; });
        if (!frame.cache || !followed) return;
        ++frames;
        compared += frame.cache->kept;
        differing += frame.cache->differing;
        traced += frame.cache->traced;
        affected += frame.cache->affected;
    }
    [[nodiscard]] nlohmann::json json(const std::string& method) const {
        return {{"method", method},
                {"frames", frames},
                {"compared", compared},
                {"differing", differing},
                {"connections_traced", traced},
                {"connections_affected", affected}};
    }
};

}  // namespace

DynamicScene load_dynamic_scene(const BenchScene& source, Diagnostics& diagnostics) {
    DynamicScene loaded;
    loaded.name = source.name;
    loaded.scene = source.load(diagnostics);
    hold_still(loaded.scene);
    FlatScene flat = flatten(loaded.scene);
    loaded.camera = choose_camera(loaded.scene, flat, "", diagnostics);
    loaded.probe = std::make_unique<SceneProbe>(std::move(flat), loaded.camera);
    return loaded;
}

nlohmann::json measure_sequence(const DynamicScene& scene, Event event,
                                const std::vector<DynamicMethod>& methods, const DynamicRun& run,
                                Executor& executor) {
    DynamicSequence sequence(scene.scene, scene.camera, *scene.probe, event, run.frames);
    FlatScene flat = flatten(sequence.at(0));
    std::deque<Entrant> entrants;
    for (const DynamicMethod& method : methods) entrants.emplace_back(executor, method, run.edge);
    ReferenceRenderer references(executor, run.edge, run.converged);
    SequenceJudge judge;
    ContactSheet sheet(run, scene.name + "-" + to_string(event));
    nlohmann::json images = nlohmann::json::array();
    for (std::uint32_t frame = 0; frame < run.frames; ++frame) {
        update_flat(sequence.at(frame), flat);
        const Camera camera = sequence.camera_at(frame);
        judge.next(references.render(flat, camera), camera, asks_visible(run, frame));
        sheet.begin(judge.reference().converged);
        append(images, sheet.add("reference", judge.reference().converged, frame));
        for (Entrant& entrant : entrants)
            render_entrant(entrant, flat, camera, judge, sheet, frame);
    }
    nlohmann::json json{{"scene", scene.name},
                        {"happening", to_string(event)},
                        {"triangles", flat.triangles.size()},
                        {"moving_triangles", flat.triangles.size() - flat.first_moving_triangle}};
    if (!images.empty()) json["pictures"] = images;
    for (const Entrant& entrant : entrants) {
        nlohmann::json row = method_json(entrant.renderer.method(), entrant.frames);
        if (!entrant.images.empty()) row["pictures"] = entrant.images;
        json["methods"].push_back(std::move(row));
    }
    return json;
}

nlohmann::json validate_sequence(const DynamicScene& scene, Event event,
                                 const std::vector<DynamicMethod>& methods, const DynamicRun& run,
                                 Executor& executor) {
    DynamicSequence sequence(scene.scene, scene.camera, *scene.probe, event, run.frames);
    FlatScene flat = flatten(sequence.at(0));
    struct Validated {
        Validated(Executor& to, DynamicMethod method, std::uint32_t edge)
            : renderer(to, method, edge) {}
        DynamicRenderer renderer;
        Validation validation{};
    };
    std::deque<Validated> all;
    for (DynamicMethod method : methods) {
        if (!method.temporal()) continue;
        method.sampling.validate_cache = true;
        all.emplace_back(executor, method, run.edge);
    }
    for (std::uint32_t frame = 0; frame < run.frames; ++frame) {
        update_flat(sequence.at(frame), flat);
        for (Validated& validated : all)
            validated.validation.add(validated.renderer.render(flat, sequence.camera_at(frame)));
    }
    nlohmann::json json{{"scene", scene.name},
                        {"happening", to_string(event)},
                        {"methods", nlohmann::json::array()}};
    for (const Validated& validated : all)
        json["methods"].push_back(validated.validation.json(validated.renderer.method().name));
    return json;
}

}  // namespace weft::bench
