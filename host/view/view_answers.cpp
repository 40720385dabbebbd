// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// What ViewLoop tells pages of the image and the scene, and what it saves for them.
#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/error.h"
#include "base/json_text.h"
#include "view/view_loop.h"
#include "view/view_report.h"

namespace weft {
namespace {

using Json = nlohmann::json;

}  // namespace

void ViewLoop::write_hello() {
    const FlatScene& flat = session_.scene().flat();
    Json hello{
        {"version", WEFT_VERSION},
        {"scene", std::filesystem::path(session_.scene().at_rest().source).filename().string()},
        {"algorithms", Json::array()},
        {"qualities", quality_names},
        {"tones", tone_names},
        {"cameras", Json::array()},
        {"settings", settings_report(choice_, paused_)},
        {"camera", camera_report(camera_, choice_.placement, flat)},
        {"radius", radius_of(flat)},
        {"centre", vector_report(centre_of(flat))},
        {"folder", files_.folder().string()}};
    for (const Algorithm algorithm : recipe_.algorithms())
        hello["algorithms"].push_back(to_string(algorithm));
    for (const Camera& camera : session_.scene().at_rest().cameras)
        hello["cameras"].push_back(camera.name);
    std::string text = json_line(hello);
    const std::lock_guard guard(mutex_);
    hello_ = std::move(text);
}

void ViewLoop::send_status() {
    if (server_ == nullptr) return;
    since_status_ = Stopwatch();
    constexpr std::array<const char*, 5> names = {"moving", "refining", "finished", "paused",
                                                  "measuring"};
    const auto command = [&](std::uint32_t pane) {
        const std::uint64_t samples = shown_.at(pane).samples;
        return samples > 0 ? recipe_.command(choice_of(pane), samples) : std::string();
    };
    const FilmSize size = size_of(session_.settings());
    Json status{{"phase", names.at(static_cast<std::size_t>(phase_))},
                {"samples", session_.samples()},
                {"ms", sample_ms_},
                {"command", command(0)},
                {"command_b", command(1)},
                {"size", {size.width, size.height}},
                {"settings", settings_report(choice_, paused_)},
                {"overlays", overlays_},
                {"records", nullptr},
                {"stages", Json::array()},
                {"rays_per_second", 0.0}};
    if (!session_.stats().last_frames().empty()) {
        const FrameStats& frame = session_.stats().last_frames().back();
        status["stages"] = stages_report(frame);
        status["records"] = records_report(frame);
        if (frame.ms > 0.0)
            status["rays_per_second"] = 1000.0 * static_cast<double>(frame.rays) / frame.ms;
    }
    server_->send_status(json_line(status), version_);
}

void ViewLoop::send_camera() {
    server_->send(json_line(
        {{"camera", camera_report(camera_, choice_.placement, session_.scene().flat())}}));
}

void ViewLoop::send_scene() {
    scene_told_ = true;
    std::string text = json_line(scene_report(session_.scene(), recipe_.timeline(), edits_));
    if (server_ != nullptr) server_->send(fmt::format(R"({{"scene":{}}})", text));
    const std::lock_guard guard(mutex_);
    scene_ = std::move(text);
}

void ViewLoop::send_front() {
    if (server_ == nullptr) return;
    const bool running = phase_ == Phase::measuring;
    const Json front = front_ ? front_->json(running, adopted_) : ViewFront({}).json(false, {});
    server_->send(json_line({{"front", front}}));
}

void ViewLoop::answer_picks() {
    // There is nothing to see before the first sample, and nothing to be sure of while it moves.
    const bool soon = phase_ == Phase::refining && (stale_ || changed_ || session_.samples() == 0);
    if (soon) return;
    const auto picks = std::exchange(picks_, {});
    if (picks.empty() || phase_ == Phase::moving || phase_ == Phase::measuring ||
        session_.samples() == 0)
        return;
    const SessionImage rendered = session_.image();
    for (const auto& [page, wish] : picks) pick(page, wish, rendered);
}

void ViewLoop::pick(std::uint32_t page, const ViewPick& pick, const SessionImage& rendered) {
    const Image& image = rendered.image;
    if (pick.x >= image.width || pick.y >= image.height) return;
    const std::size_t plane = std::size_t{image.width} * image.height;
    const std::size_t pixel = std::size_t{pick.y} * image.width + pick.x;
    Json values = Json::object();
    for (const Layer& layer : image.layers) {
        if (layer.words) continue;
        Json of_layer = Json::array();
        for (std::size_t c = 0; c < layer.channels.size(); ++c)
            of_layer.push_back(layer.values[c * plane + pixel]);
        values[layer.name] = of_layer;
    }
    Json picked{{"at", {pick.x, pick.y}}, {"values", values},    {"point", nullptr},
                {"object", nullptr},      {"material", nullptr}, {"samples", rendered.samples}};
    const Layer* const depth = image.find("depth");
    if (depth != nullptr && depth->values[pixel] > 0.0F)
        picked["point"] = vector_report(point_at(camera_, {image.width, image.height}, pick,
                                                 static_cast<double>(depth->values[pixel])));
    if (const auto index = session_.instance_at(pick.x, pick.y)) {
        const Scene& scene = session_.scene().now();
        const Instance& instance = scene.instances.at(*index);
        picked["object"] = instance.name;
        picked["material"] = scene.materials.at(instance.material).name;
    }
    server_->send(page, json_line({{"picked", picked}}));
}

void ViewLoop::save(const ViewSave& save) {
    const bool of_image = save.file == SavedFile::png || save.file == SavedFile::exr;
    const bool in_full_size = phase_ != Phase::moving && phase_ != Phase::measuring && has_image();
    try {
        std::filesystem::path file;
        if (save.file == SavedFile::edits) {
            if (edits_.count() == 0) return say("the scene has no edits to be saved");
            file = files_.write({{"edits", edits_.list()}}, ".edits.json");
        } else if (save.file == SavedFile::preset) {
            const std::uint64_t samples = choice_.samples.value_or(shown_[0].samples);
            if (samples == 0) return say("there is no image yet whose settings could be saved");
            file = files_.write(preset_json(recipe_.preset(choice_, samples)), ".preset.json");
        } else {
            file = files_.next(save.file == SavedFile::exr ? ".exr" : ".png");
            if (of_image && !in_full_size) return say("there is no image in full size yet");
            FileOutput output(recipe_.output(choice_, file), diagnostics_);
            output.write(session_.image());
        }
        server_->send(json_line({{"saved", file.string()}}));
    } catch (const Error& error) {
        say(error.what());
    }
}

void ViewLoop::say(const std::string& line) {
    if (server_ != nullptr) server_->send(json_line({{"error", line}}));
}

}  // namespace weft
