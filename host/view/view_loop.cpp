// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>
#include <variant>

#include "base/error.h"
#include "base/json_text.h"
#include "image/png.h"
#include "image/write_jpeg.h"
#include "pipeline/stage.h"
#include "scene/field_of_view.h"

namespace weft {
namespace {

using Json = nlohmann::json;

// Moving images are replaced at once; those at rest are looked at.
constexpr JpegSettings moving_jpeg{80, true};
constexpr JpegSettings resting_jpeg{92, false};
// A page that has said that the camera moves, and then nothing, has lost its pointer.
constexpr double most_silence_ms = 500.0;
constexpr double least_file_pause_ms = 300.0;
constexpr double file_pause_by_cost = 10.0;
constexpr double status_pause_ms = 100.0;
constexpr double unbiased_ms = 250.0;  // of path tracing, between two looks at what is asked

Json json_of(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

/// A column of a camera's transform: where it stands, or an axis of any length.
glm::dvec3 column(const Camera& camera, int i) {
    return {camera.to_world[i]};
}

glm::dvec3 centre_of(const FlatScene& scene) {
    return scene.units.centre;
}

double radius_of(const FlatScene& scene) {
    return static_cast<double>(scene.radius) / scene.units.scale;
}

/// A camera as pages know it. What it looks at is as far off as the scene's centre.
Json camera_json(const Camera& camera, const CameraPlacement& placement, const FlatScene& scene) {
    CameraView view;
    if (placement.view) {
        view = *placement.view;
    } else {
        constexpr double least_share = 0.1;
        const glm::dvec3 forward = viewing_axis(camera);
        view.from = column(camera, 3);
        const double along = glm::dot(centre_of(scene) - view.from, forward);
        view.at = view.from + forward * std::max(along, least_share * radius_of(scene));
        view.up = glm::normalize(column(camera, 1));
    }
    return {{"from", json_of(view.from)},
            {"at", json_of(view.at)},
            {"up", json_of(view.up)},
            {"fov", placement.fov.value_or(glm::degrees(camera.fov))},
            {"orthographic", camera.orthographic()}};
}

Json settings_json(const ViewChoice& choice, bool paused) {
    return {{"algorithm", to_string(choice.algorithm)},
            {"quality", to_string(choice.quality)},
            {"size", {choice.size.width, choice.size.height}},
            {"exposure", choice.exposure_ev},
            {"tone", to_string(choice.tone)},
            {"paused", paused}};
}

/// Where the surface lies that a pixel shows at a depth, in scene units.
glm::dvec3 point_at(const Camera& camera, FilmSize size, const ViewPick& pick, double depth) {
    const double aspect = static_cast<double>(size.width) / size.height;
    const double across = 2.0 * (pick.x + 0.5) / size.width - 1.0;
    const double up = 1.0 - 2.0 * (pick.y + 0.5) / size.height;
    const double scale = camera.orthographic() ? half_height(camera, aspect)
                                               : depth * vertical_tangent(camera, aspect);
    const double side = camera.mirror_x ? -1.0 : 1.0;
    return column(camera, 3) + viewing_axis(camera) * depth +
           glm::normalize(column(camera, 0)) * (side * across * aspect * scale) +
           glm::normalize(column(camera, 1)) * (up * scale);
}

/// What each kind of stage of a frame took, in the order in which they ran.
Json stages_json(const FrameStats& frame) {
    std::vector<std::pair<std::string, double>> stages;
    for (const StageStats& stage : frame.stages) {
        const std::string name(stage_name(stage.stage));
        const auto found =
            std::ranges::find_if(stages, [&](const auto& one) { return one.first == name; });
        if (found == stages.end())
            stages.emplace_back(name, stage.ms);
        else
            found->second += stage.ms;
    }
    Json json = Json::array();
    for (const auto& [name, ms] : stages) json.push_back({name, ms});
    return json;
}

}  // namespace

ViewLoop::ViewLoop(RenderSession& session, const ViewRecipe& recipe, ViewChoice choice,
                   std::filesystem::path folder, Diagnostics& diagnostics)
    : session_(session),
      recipe_(recipe),
      diagnostics_(diagnostics),
      folder_(std::move(folder)),
      choice_(std::move(choice)),
      camera_(session.camera()) {
    pace_.set_full(choice_.size);
    (void)adopt(choice_);
    session_.set_display(this);
}

ViewLoop::~ViewLoop() {
    session_.set_display(nullptr);
}

std::string ViewLoop::hello() {
    const std::lock_guard guard(mutex_);
    return hello_;
}

std::uint64_t ViewLoop::take(std::uint32_t page, const ViewMessage& message) {
    const std::lock_guard guard(mutex_);
    std::uint64_t version = 0;
    if (const auto* const camera = std::get_if<ViewCamera>(&message)) {
        asked_.camera = *camera;
        asked_.version = version = ++asked_version_;
    } else if (const auto* const settings = std::get_if<ViewSettings>(&message)) {
        const auto replace = [](auto& now, const auto& later) {
            if (later) now = later;
        };
        ViewSettings& all = asked_.settings;
        replace(all.algorithm, settings->algorithm);
        replace(all.quality, settings->quality);
        replace(all.size, settings->size);
        replace(all.exposure_ev, settings->exposure_ev);
        replace(all.tone, settings->tone);
        replace(all.paused, settings->paused);
        replace(all.camera, settings->camera);
        // A camera of the scene replaces a view that was asked for before.
        if (settings->camera) asked_.camera.reset();
        asked_.version = version = ++asked_version_;
    } else {
        constexpr std::size_t most_waiting = 64;
        if (asked_.picks.size() + asked_.saves.size() >= most_waiting)
            throw input_error("message#", "is one of too many that wait for an answer");
        if (const auto* const pick = std::get_if<ViewPick>(&message))
            asked_.picks.emplace_back(page, *pick);
        if (const auto* const save = std::get_if<ViewSave>(&message)) asked_.saves.push_back(*save);
    }
    if (can_cancel_) session_.cancel();
    has_asked_.notify_one();
    return version;
}

ViewLoop::Asked ViewLoop::take_asked() {
    const std::lock_guard guard(mutex_);
    return std::exchange(asked_, {});
}

void ViewLoop::wait_for_pages() {
    constexpr std::chrono::milliseconds most(100);
    std::unique_lock lock(mutex_);
    has_asked_.wait_for(lock, most, [&] {
        return asked_.version > 0 || !asked_.picks.empty() || !asked_.saves.empty();
    });
}

void ViewLoop::run(ViewServer& server, const std::atomic<bool>& ended) {
    server_ = &server;
    ended_ = &ended;
    while (!ended) {
        apply(take_asked());
        if (phase_ == Phase::moving && since_camera_.total() > most_silence_ms) {
            phase_ = Phase::refining;
            stale_ = true;
        }
        if (server.pages() == 0 || phase_ == Phase::finished || phase_ == Phase::paused)
            wait_for_pages();
        else if (phase_ == Phase::moving)
            render_moving();
        else
            render_still();
    }
    server_ = nullptr;
    ended_ = nullptr;
}

void ViewLoop::apply(const Asked& asked) {
    if (asked.version > 0) {
        version_ = asked.version;
        apply_settings(asked.settings);
        if (asked.camera) apply_camera(*asked.camera);
    }
    for (const auto& [page, wish] : asked.picks) pick(page, wish);
    for (const ViewSave& wish : asked.saves) save(wish);
}

void ViewLoop::apply_camera(const ViewCamera& camera) {
    ViewChoice next = choice_;
    next.placement.view = camera.view;
    next.placement.fov =
        camera_.orthographic() ? std::optional<double>() : std::optional(camera.fov);
    if (!adopt(next)) return;
    camera_moved_ = true;
    since_camera_ = Stopwatch();
    const Phase wanted = camera.moving ? Phase::moving : Phase::refining;
    if (wanted != phase_ && (wanted == Phase::moving || phase_ == Phase::moving)) stale_ = true;
    phase_ = wanted;
}

void ViewLoop::apply_settings(const ViewSettings& settings) {
    if (settings.paused) {
        paused_ = *settings.paused;
        if (!paused_ && phase_ == Phase::paused) phase_ = Phase::refining;
        write_hello();
    }
    const bool recoloured = settings.exposure_ev || settings.tone;
    const bool anew = settings.algorithm || settings.quality || settings.size || settings.camera;
    if (!recoloured && !anew) return;
    ViewChoice next = choice_;
    next.algorithm = settings.algorithm.value_or(next.algorithm);
    next.quality = settings.quality.value_or(next.quality);
    next.size = settings.size.value_or(next.size);
    next.exposure_ev = settings.exposure_ev.value_or(next.exposure_ev);
    next.tone = settings.tone.value_or(next.tone);
    if (settings.camera) {
        next.camera = *settings.camera;
        next.placement = {};
    }
    if (!adopt(next)) return;
    if (anew) {
        pace_.set_full(choice_.size);
        stale_ = true;
        if (phase_ != Phase::moving) phase_ = Phase::refining;
    }
    if (settings.camera) send_camera();
    if (recoloured && !anew && phase_ != Phase::moving && session_.samples() > 0) show_file();
}

bool ViewLoop::adopt(const ViewChoice& choice) {
    try {
        const Camera camera = recipe_.camera(choice);
        (void)recipe_.settings(choice, choice.size, false);
        camera_ = camera;
        choice_ = choice;
        last_ = recipe_.samples(choice);
    } catch (const Error& error) {
        say(error.what());
        return false;
    }
    write_hello();
    return true;
}

void ViewLoop::write_hello() {
    const FlatScene& flat = session_.scene().flat();
    Json hello{
        {"version", WEFT_VERSION},
        {"scene", std::filesystem::path(session_.scene().at_rest().source).filename().string()},
        {"algorithms", Json::array()},
        {"qualities", quality_names},
        {"tones", tone_names},
        {"cameras", Json::array()},
        {"settings", settings_json(choice_, paused_)},
        {"camera", camera_json(camera_, choice_.placement, flat)},
        {"radius", radius_of(flat)},
        {"centre", json_of(centre_of(flat))},
        {"folder", folder_.string()}};
    for (const Algorithm algorithm : recipe_.algorithms())
        hello["algorithms"].push_back(to_string(algorithm));
    for (const Camera& camera : session_.scene().at_rest().cameras)
        hello["cameras"].push_back(camera.name);
    std::string text = json_line({{"hello", hello}});
    const std::lock_guard guard(mutex_);
    hello_ = std::move(text);
}

void ViewLoop::render_moving() {
    const FilmSize size = pace_.size();
    const Stopwatch watch;
    const auto same_size = [&](const auto& settings) {
        return settings.width == size.width && settings.height == size.height;
    };
    const bool anew = stale_ || !std::visit(same_size, session_.settings());
    if (!anew && !camera_moved_) return wait_for_pages();
    if (anew) {
        session_.set_settings(recipe_.settings(choice_, size, true));
        session_.set_camera(camera_);
        shown_as_file_ = false;
        file_samples_ = 0;
    } else {
        session_.move_camera(camera_);
    }
    stale_ = false;
    camera_moved_ = false;
    (void)session_.render({});
    sample_ms_ = watch.total();
    // The first of a size has buffers to make.
    if (!anew) pace_.took(sample_ms_);
    if (since_status_.total() > status_pause_ms) send_status();
}

void ViewLoop::render_still() {
    if (stale_) session_.set_settings(recipe_.settings(choice_, choice_.size, false));
    if (stale_ || camera_moved_) {
        session_.set_camera(camera_);
        shown_as_file_ = false;
        file_samples_ = 0;
        next_file_ms_ = 0.0;
    }
    stale_ = false;
    camera_moved_ = false;
    RenderBudget budget;
    budget.end_early = ended_;
    if (std::holds_alternative<PathSettings>(session_.settings()))
        budget.time_ms = unbiased_ms;
    else
        budget.samples = static_cast<std::uint32_t>(session_.samples()) + 1;
    {
        const std::lock_guard guard(mutex_);
        can_cancel_ = true;
    }
    const std::uint64_t before = session_.samples();
    const Stopwatch watch;
    const SessionEnd end = session_.render(budget);
    {
        const std::lock_guard guard(mutex_);
        can_cancel_ = false;
    }
    const std::uint64_t made = session_.samples() - before;
    if (end == SessionEnd::cancelled || made == 0) return;
    sample_ms_ = watch.total() / static_cast<double>(made);
    const bool done = last_ && session_.samples() >= *last_;
    if (has_command() && (paused_ || done || since_file_.total() > next_file_ms_)) show_file();
    if (done) phase_ = Phase::finished;
    if (paused_) phase_ = Phase::paused;
    send_status();
}

void ViewLoop::show(const DisplayFrame& frame) {
    // What refines a preview corrects it, which the film does not show.
    if (server_ == nullptr || shown_as_file_ || session_.refined_samples() > 0) return;
    const bool moving = phase_ == Phase::moving;
    ViewFrame sent;
    sent.codec = ViewCodec::jpeg;
    sent.moving = moving;
    sent.version = version_;
    sent.width = frame.width;
    sent.height = frame.height;
    sent.samples = static_cast<std::uint32_t>(frame.samples);
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(
        jpeg_bytes(frame.colours, frame.width, frame.height, moving ? moving_jpeg : resting_jpeg));
    server_->show(std::move(sent));
}

bool ViewLoop::has_command() const {
    const auto* const preview = std::get_if<RenderSettings>(&session_.settings());
    if (preview == nullptr) return session_.samples() > 0;
    return session_.samples() >= last_.value_or(std::max(1U, preview->refined_after));
}

void ViewLoop::show_file() {
    const Stopwatch cost;
    SessionImage image = session_.image();
    const FileOutputSettings settings = recipe_.output(choice_, "view.png");
    describe(image, settings);
    ViewFrame sent;
    sent.codec = ViewCodec::png;
    sent.final = has_command();
    sent.version = version_;
    sent.width = image.image.width;
    sent.height = image.image.height;
    sent.samples = static_cast<std::uint32_t>(image.samples);
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(
        png_bytes(image.image, png_settings(image.image, settings)));
    shown_as_file_ = true;
    file_samples_ = sent.final ? image.samples : 0;
    server_->show(std::move(sent));
    next_file_ms_ = std::max(least_file_pause_ms, file_pause_by_cost * cost.total());
    since_file_ = Stopwatch();
    send_status();
}

void ViewLoop::send_status() {
    since_status_ = Stopwatch();
    constexpr std::array<const char*, 4> names = {"moving", "refining", "finished", "paused"};
    Json status{{"phase", names.at(static_cast<std::size_t>(phase_))},
                {"samples", session_.samples()},
                {"ms", sample_ms_},
                {"command", file_samples_ > 0 ? recipe_.command(choice_, file_samples_) : ""}};
    std::visit(
        [&](const auto& settings) {
            status["size"] = {settings.width, settings.height};
        },
        session_.settings());
    if (!session_.stats().last_frames().empty()) {
        const FrameStats& frame = session_.stats().last_frames().back();
        status["stages"] = stages_json(frame);
        status["rays_per_second"] =
            frame.ms > 0.0 ? 1000.0 * static_cast<double>(frame.rays) / frame.ms : 0.0;
    }
    server_->send_status(json_line(status), version_);
}

void ViewLoop::send_camera() {
    server_->send(
        json_line({{"camera", camera_json(camera_, choice_.placement, session_.scene().flat())}}));
}

void ViewLoop::pick(std::uint32_t page, const ViewPick& pick) {
    if (phase_ == Phase::moving || session_.samples() == 0) return;
    const SessionImage rendered = session_.image();
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
    Json picked{{"at", {pick.x, pick.y}},
                {"values", values},
                {"point", nullptr},
                {"samples", rendered.samples}};
    const Layer* const depth = image.find("depth");
    if (depth != nullptr && depth->values[pixel] > 0.0F)
        picked["point"] = json_of(point_at(camera_, {image.width, image.height}, pick,
                                           static_cast<double>(depth->values[pixel])));
    server_->send(page, json_line({{"picked", picked}}));
}

std::filesystem::path ViewLoop::next_file(const char* extension) const {
    constexpr int most = 9999;
    for (int number = 1; number <= most; ++number) {
        std::filesystem::path file = folder_ / fmt::format("view-{:03}{}", number, extension);
        std::error_code error;
        if (!std::filesystem::exists(file, error)) return file;
    }
    throw Error(ExitCode::output, folder_.string(), "has 9999 saved views, expected fewer");
}

void ViewLoop::save(const ViewSave& save) {
    if (folder_.empty())
        return say("nothing can be saved, expected weft view with --output FOLDER");
    if (phase_ == Phase::moving || session_.samples() == 0)
        return say("there is no image in full size yet");
    try {
        const std::filesystem::path file = next_file(save.exr ? ".exr" : ".png");
        FileOutput output(recipe_.output(choice_, file), diagnostics_);
        output.write(session_.image());
        server_->send(json_line({{"saved", file.string()}}));
    } catch (const Error& error) {
        say(error.what());
    }
}

void ViewLoop::say(const std::string& line) {
    if (server_ != nullptr) server_->send(json_line({{"error", line}}));
}

}  // namespace weft
