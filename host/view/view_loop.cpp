// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <nlohmann/json.hpp>
#include <variant>

#include "base/error.h"
#include "base/json_text.h"
#include "image/png.h"
#include "image/write_jpeg.h"
#include "scene/scene_edits.h"
#include "view/view_overlay.h"
#include "view/view_report.h"

namespace weft {
namespace {

using Json = nlohmann::json;

// Moving images are replaced at once; those at rest are looked at.
constexpr JpegSettings moving_jpeg{80, true};
constexpr JpegSettings resting_jpeg{92, false};
// A page that has said that more follows, and then nothing, has lost its pointer.
constexpr double most_silence_ms = 500.0;
constexpr double least_file_pause_ms = 300.0;
constexpr double file_pause_by_cost = 10.0;
constexpr double status_pause_ms = 100.0;
constexpr std::size_t most_waiting = 64;  // requests that wait for an answer
constexpr double unbiased_ms = 250.0;     // of path tracing, between two looks at what is asked

bool is_same_size(FilmSize a, FilmSize b) {
    return a.width == b.width && a.height == b.height;
}

FilmSize size_of(const ImageSettings& settings) {
    return std::visit([](const auto& of) { return FilmSize{of.width, of.height}; }, settings);
}

/// Reads edits in one line, which may be empty, for a scene.
std::function<EditTimeline(Scene&)> edits_of(const std::string& text) {
    return [&text](Scene& scene) {
        if (text.empty()) return EditTimeline{};
        return read_scene_edits(Json::parse(text), "edits", scene);
    };
}

/// The beauty of an image, plane by plane; empty where it has none.
std::vector<float> beauty_of(const Image& image) {
    const Layer* const layer = image.find("");
    return layer != nullptr && layer->channels == "RGB" ? layer->values : std::vector<float>();
}

template <class T>
void replace(T& now, const T& later) {
    if (later) now = later;
}

}  // namespace

ViewLoop::ViewLoop(RenderSession& session, const ViewRecipe& recipe, ViewChoice choice,
                   std::filesystem::path folder, Diagnostics& diagnostics)
    : session_(session),
      recipe_(recipe),
      diagnostics_(diagnostics),
      files_(std::move(folder)),
      choice_(std::move(choice)),
      camera_(session.camera()) {
    if (!choice_.edits.empty()) edits_ = ViewEdits(Json::parse(choice_.edits));
    pace_.set_full(choice_.size);
    send_scene();
    (void)adopt(choice_);
    session_.set_display(this);
}

ViewLoop::~ViewLoop() {
    session_.set_display(nullptr);
}

std::string ViewLoop::hello() {
    const std::lock_guard guard(mutex_);
    return fmt::format(R"({{"hello":{},"scene":{}}})", hello_, scene_);
}

std::uint64_t ViewLoop::take(std::uint32_t page, const ViewMessage& message) {
    const std::lock_guard guard(mutex_);
    const std::size_t waiting = asked_.picks.size() + asked_.saves.size() + asked_.changes.size();
    const auto check_room = [&] {
        if (waiting >= most_waiting)
            throw input_error("message#", "is one of too many that wait for an answer");
    };
    std::uint64_t version = 0;
    if (const auto* const camera = std::get_if<ViewCamera>(&message)) {
        asked_.camera = *camera;
        asked_.moving = camera->moving;
    } else if (const auto* const settings = std::get_if<ViewSettings>(&message)) {
        ViewSettings& all = asked_.settings;
        replace(all.algorithm, settings->algorithm);
        replace(all.quality, settings->quality);
        replace(all.size, settings->size);
        replace(all.exposure_ev, settings->exposure_ev);
        replace(all.tone, settings->tone);
        replace(all.paused, settings->paused);
        replace(all.camera, settings->camera);
        replace(all.frame, settings->frame);
        replace(all.samples, settings->samples);
        replace(all.overlay, settings->overlay);
        replace(all.compare, settings->compare);
        replace(all.trust, settings->trust);
        // A camera of the scene replaces a view that was asked for before.
        if (settings->camera) asked_.camera.reset();
        if (settings->frame) asked_.moving = settings->moving;
    } else if (const auto* const edit = std::get_if<ViewEdit>(&message)) {
        ViewEdit* const last =
            asked_.changes.empty() ? nullptr : std::get_if<ViewEdit>(&asked_.changes.back());
        if (last != nullptr && edit->continues) {
            last->change = edit->change;
        } else {
            check_room();
            asked_.changes.emplace_back(*edit);
        }
        asked_.moving = edit->moving;
    } else if (const auto* const undo = std::get_if<ViewUndo>(&message)) {
        check_room();
        asked_.changes.emplace_back(*undo);
        asked_.moving = false;
    } else if (const auto* const measuring = std::get_if<ViewMeasure>(&message)) {
        asked_.measuring = measuring->begin;
    } else if (const auto* const adopted = std::get_if<ViewAdopt>(&message)) {
        asked_.adopted = adopted->point;
    } else {
        check_room();
        if (const auto* const pick = std::get_if<ViewPick>(&message))
            asked_.picks.emplace_back(page, *pick);
        if (const auto* const save = std::get_if<ViewSave>(&message)) asked_.saves.push_back(*save);
    }
    if (state_of(message) > 0) asked_.version = version = ++asked_version_;
    // What is only looked at or saved can wait for the sample under way.
    const bool can_wait =
        std::holds_alternative<ViewPick>(message) || std::holds_alternative<ViewSave>(message);
    if (can_cancel_ && !can_wait) session_.cancel();
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
    has_asked_.wait_for(lock, most, [&] { return asked_.any(); });
}

void ViewLoop::run(ViewServer& server, const std::atomic<bool>& ended) {
    constexpr double idle_ms = 100.0;
    server_ = &server;
    ended_ = &ended;
    while (!ended) {
        apply(take_asked());
        if (phase_ == Phase::moving && since_request_.total() > most_silence_ms) restart(false);
        if (!scene_told_ && phase_ != Phase::moving) send_scene();
        take_judgement();
        const Phase phase = server.pages() == 0 ? Phase::paused : phase_;
        const bool is_idle = phase == Phase::paused || phase == Phase::finished;
        if (phase == Phase::moving) render_moving();
        if (phase == Phase::measuring) measure();
        if (phase == Phase::refining) render_still();
        if (is_idle && (phase == Phase::paused || !grow_references(idle_ms))) wait_for_pages();
    }
    server_ = nullptr;
    ended_ = nullptr;
}

void ViewLoop::apply(const Asked& asked) {
    if (asked.version > 0) {
        version_ = asked.version;
        const bool anew = apply_settings(asked.settings);
        apply_changes(asked.changes);
        if (asked.camera) apply_camera(*asked.camera);
        if (asked.moving)
            restart(*asked.moving);
        else if (anew)
            restart(phase_ == Phase::moving);
    }
    if (asked.adopted) apply_point(*asked.adopted);
    // Those of a pointer that waits no longer go.
    if (picks_.size() > most_waiting) picks_.clear();
    picks_.insert(picks_.end(), asked.picks.begin(), asked.picks.end());
    answer_picks();
    for (const ViewSave& wish : asked.saves) save(wish);
    if (asked.measuring && *asked.measuring)
        begin_measuring();
    else if (asked.measuring)
        end_measuring();
}

void ViewLoop::restart(bool moving) {
    since_request_ = Stopwatch();
    end_measuring();
    if (moving != (phase_ == Phase::moving)) stale_ = true;
    changed_ = true;
    glimpsed_ = false;
    phase_ = moving ? Phase::moving : Phase::refining;
}

void ViewLoop::forget_references() {
    references_.reset();
    unspent_ms_ = 0.0;
    if (front_) {
        front_.reset();
        adopted_.reset();
        send_front();
    }
}

void ViewLoop::apply_camera(const ViewCamera& camera) {
    ViewChoice next = choice_;
    next.placement.view = camera.view;
    next.placement.fov =
        camera_.orthographic() ? std::optional<double>() : std::optional(camera.fov);
    if (!adopt(next)) return;
    forget_references();
    begun_ = false;
}

bool ViewLoop::apply_settings(const ViewSettings& settings) {
    if (settings.paused) {
        paused_ = *settings.paused;
        if (!paused_ && phase_ == Phase::paused) phase_ = Phase::refining;
        write_hello();
    }
    const bool recoloured = settings.exposure_ev || settings.tone;
    // The image in pane 1 is gone from the session.
    const bool anew = settings.algorithm || settings.quality || settings.size || settings.camera ||
                      settings.samples || settings.compare || (recoloured && is_shared());
    if (!recoloured && !anew && !settings.frame && !settings.trust && !settings.overlay)
        return false;
    ViewChoice next = choice_;
    next.algorithm = settings.algorithm.value_or(next.algorithm);
    next.quality = settings.quality.value_or(next.quality);
    next.size = settings.size.value_or(next.size);
    next.exposure_ev = settings.exposure_ev.value_or(next.exposure_ev);
    next.tone = settings.tone.value_or(next.tone);
    next.overlay = settings.overlay.value_or(next.overlay);
    next.comparison = settings.compare.value_or(next.comparison);
    next.trust = settings.trust.value_or(next.trust);
    if (settings.samples)
        next.samples = *settings.samples > 0 ? settings.samples : std::optional<std::uint32_t>();
    if (settings.frame) next.frame = std::min(*settings.frame, recipe_.timeline().frames - 1);
    if (settings.camera) {
        next.camera = *settings.camera;
        next.placement = {};
    }
    const bool other_size = !is_same_size(next.size, choice_.size);
    if (!adopt(next)) return false;
    if (settings.trust && !*settings.trust) {
        references_.reset();
        judgement_.reset();
    }
    if (settings.algorithm || settings.quality) pixel_ms_.reset();
    if (other_size) pace_.set_full(choice_.size);
    if (other_size || settings.camera) forget_references();
    if (anew) {
        stale_ = true;
        begun_ = false;
        adopted_.reset();
    }
    if (settings.camera) send_camera();
    const bool shown_anew = recoloured || settings.overlay;
    const bool at_rest = phase_ != Phase::moving && phase_ != Phase::measuring;
    if (shown_anew && !anew && at_rest && has_image()) show_file();
    send_status();
    return anew;
}

void ViewLoop::apply_changes(const std::vector<Change>& changes) {
    if (changes.empty()) return;
    const ViewEdits before = edits_;
    ViewChoice next = choice_;
    try {
        for (const Change& change : changes) {
            if (const auto* const edit = std::get_if<ViewEdit>(&change))
                edits_.add(edit->change, choice_.frame, edit->continues);
            else if (std::get<ViewUndo>(change).all)
                edits_.clear();
            else
                edits_.undo();
        }
        next.edits = edits_.text();
    } catch (const Error& error) {
        edits_ = before;
        return say(error.what());
    }
    if (!adopt(next)) edits_ = before;
}

void ViewLoop::apply_point(std::uint32_t point) {
    if (!front_ || point >= front_->points()) return say("there is no such point");
    const ViewCandidate& candidate = front_->candidate(point);
    ViewChoice next = choice_;
    next.algorithm = candidate.choice.algorithm;
    next.quality = candidate.choice.quality;
    next.samples = candidate.choice.samples;
    next.comparison.reset();
    if (!adopt(next)) return;
    pixel_ms_.reset();
    adopted_ = point;
    restart(false);
    stale_ = true;
    send_front();
    if (!files_.folder().empty()) save({SavedFile::preset});
}

bool ViewLoop::adopt(const ViewChoice& choice) {
    const bool other_scene = choice.frame != choice_.frame || choice.edits != choice_.edits;
    try {
        const Camera camera = recipe_.camera(choice);
        (void)recipe_.settings(choice, choice.size, false);
        if (choice.comparison) {
            ViewChoice other = choice;
            other.algorithm = choice.comparison->algorithm;
            other.quality = choice.comparison->quality;
            (void)recipe_.settings(other, choice.size, false);
        }
        if (other_scene) {
            forget_references();
            session_.set_edits(edits_of(choice.edits), choice.frame, camera);
            begun_ = true;
            scene_told_ = false;
            stale_ = stale_ || phase_ != Phase::moving;
        }
        camera_ = camera;
        choice_ = choice;
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

void ViewLoop::render_moving() {
    const bool anew = stale_ || !is_same_size(size_of(session_.settings()), pace_.size());
    if (!anew && !changed_) return wait_for_pages();
    sample_ms_ = render_divided();
    // The first of a size has buffers to make.
    if (!anew) pace_.took(sample_ms_);
    if (since_status_.total() > status_pause_ms) send_status();
}

double ViewLoop::render_divided() {
    const Stopwatch watch;
    const FilmSize size = pace_.size();
    if (stale_ || !is_same_size(size_of(session_.settings()), size)) {
        session_.set_settings(recipe_.settings(choice_, size, true));
        session_.set_camera(camera_);
        shown_as_file_ = false;
        shown_ = {};
        server_->forget(1);
    } else if (!begun_) {
        session_.move_camera(camera_);
    }
    pane_ = 0;
    divided_ = true;
    stale_ = changed_ = begun_ = false;
    // A request that came as the last image ended has cancelled the next one, which is this.
    if (session_.render({}) == SessionEnd::cancelled) (void)session_.render({});
    if (!choice_.overlay.empty()) show_overlay();
    return watch.total();
}

bool ViewLoop::is_slow() const {
    constexpr double slow_ms = 300.0;
    const FilmSize size = choice_.size;
    // Before the very first image nothing has been waited for.
    if ((view_ == 0 && !divided_) || is_same_size(size, pace_.size())) return false;
    return !pixel_ms_ || *pixel_ms_ * size.width * size.height > slow_ms;
}

ViewChoice ViewLoop::choice_of(std::uint32_t pane) const {
    ViewChoice choice = choice_;
    if (pane == 1 && choice_.comparison) {
        choice.algorithm = choice_.comparison->algorithm;
        choice.quality = choice_.comparison->quality;
    }
    if (planned_.at(pane)) choice.samples = planned_.at(pane);
    return choice;
}

void ViewLoop::begin_pane(std::uint32_t pane) {
    if (stale_ || changed_) planned_ = {};
    const ViewChoice choice = choice_of(pane);
    if (stale_ || is_shared()) session_.set_settings(recipe_.settings(choice, choice.size, false));
    session_.set_camera(camera_);
    if (stale_ || changed_) {
        ++view_;
        judgement_.reset();
        judged_by_ = judged_samples_ = 0;
        shown_ = {};
        server_->forget(1);
    }
    pane_ = pane;
    pane_ms_ = 0.0;
    last_ = recipe_.samples(choice);
    stale_ = changed_ = begun_ = divided_ = false;
    shown_as_file_ = false;
    next_file_ms_ = 0.0;
}

void ViewLoop::let_cancel(bool can) {
    const std::lock_guard guard(mutex_);
    can_cancel_ = can;
}

bool ViewLoop::plan_samples(double sample_ms) {
    constexpr double most = 4096.0;
    if (!is_shared() || !last_ || choice_.samples || planned_.at(pane_)) return false;
    const double time = 1000.0 * choice_.comparison->seconds;
    planned_.at(pane_) = static_cast<std::uint32_t>(std::clamp(time / sample_ms, 1.0, most));
    begin_pane(pane_);
    return true;
}

std::optional<double> ViewLoop::render(const RenderBudget& budget) {
    let_cancel(true);
    const Stopwatch watch;
    const SessionEnd end = session_.render(budget);
    let_cancel(false);
    return end == SessionEnd::cancelled ? std::nullopt : std::optional(watch.total());
}

void ViewLoop::render_still() {
    // What a command makes has no hasty BVH.
    const bool waits = paused_ || is_shared();
    if (session_.is_hasty() && (glimpsed_ || waits) && session_.settle(waits)) {
        // Requests that came in the meantime go first.
        changed_ = true;
        return;
    }
    const bool begins = stale_ || changed_;
    if (begins && !glimpsed_ && !is_shared() && is_slow()) {
        (void)render_divided();
        stale_ = glimpsed_ = true;
        return;
    }
    if (begins) begin_pane(is_shared() ? 1 : 0);
    glimpsed_ = true;
    RenderBudget budget;
    budget.end_early = ended_;
    if (std::holds_alternative<PathSettings>(session_.settings()))
        budget.time_ms = unbiased_ms;
    else
        budget.samples = static_cast<std::uint32_t>(session_.samples()) + 1;
    const std::uint64_t before = session_.samples();
    const std::optional<double> ms = render(budget);
    const std::uint64_t made = session_.samples() - before;
    if (!ms || made == 0) return;
    sample_ms_ = *ms / static_cast<double>(made);
    if (before == 0) {
        const double pixels = static_cast<double>(choice_.size.width) * choice_.size.height;
        pixel_ms_ = sample_ms_ / pixels;
        pace_.took_full(sample_ms_);
    }
    pane_ms_ += *ms;
    if (plan_samples(sample_ms_)) return;
    const bool in_time = !is_shared() || pane_ms_ < 1000.0 * choice_.comparison->seconds;
    const bool done = has_command() && (!in_time || (last_ && session_.samples() >= *last_));
    if (has_command() && (paused_ || done || since_file_.total() > next_file_ms_))
        show_file();
    else if (!has_command() && !choice_.overlay.empty())
        show_overlay();
    if (done && pane_ > 0)
        begin_pane(0);
    else if (done)
        phase_ = Phase::finished;
    if (paused_) phase_ = Phase::paused;
    send_status();
    answer_picks();
    // A quarter of the time is theirs.
    constexpr double time_of_references = 1.0 / 3.0;
    if (phase_ == Phase::refining && shown_[0].samples > 0)
        (void)grow_references(time_of_references * *ms);
}

void ViewLoop::show(const DisplayFrame& frame) {
    // What refines a preview corrects it, which the film does not show.
    if (server_ == nullptr || shown_as_file_ || session_.refined_samples() > 0 ||
        phase_ == Phase::measuring || !choice_.overlay.empty())
        return;
    ViewFrame sent;
    sent.codec = ViewCodec::jpeg;
    sent.pane = pane_;
    sent.moving = divided_;
    sent.version = version_;
    sent.width = frame.width;
    sent.height = frame.height;
    sent.samples = static_cast<std::uint32_t>(frame.samples);
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(jpeg_bytes(
        frame.colours, frame.width, frame.height, divided_ ? moving_jpeg : resting_jpeg));
    server_->show(std::move(sent));
}

bool ViewLoop::has_image() const {
    return pane_ == 0 && session_.samples() > 0 && !stale_ && !changed_;
}

bool ViewLoop::has_command() const {
    if (session_.is_hasty()) return false;
    const auto* const preview = std::get_if<RenderSettings>(&session_.settings());
    if (preview == nullptr) return session_.samples() > 0;
    return session_.samples() >= last_.value_or(std::max(1U, preview->refined_after));
}

std::span<const float> ViewLoop::flip() const {
    if (!judgement_) return {};
    for (const JudgedErrors& errors : judgement_->images)
        if (errors.pane == 0) return errors.flip;
    return {};
}

void ViewLoop::show_overlay() {
    const Image image = session_.image().image;
    overlays_ = overlay_names(image, false);
    const Image overlay = overlay_of(image, choice_.overlay, {}, choice_.exposure_ev);
    ViewFrame sent;
    sent.codec = ViewCodec::png;
    sent.pane = pane_;
    sent.moving = divided_;
    sent.version = version_;
    sent.width = image.width;
    sent.height = image.height;
    sent.samples = static_cast<std::uint32_t>(session_.samples());
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(
        overlay.layers.empty() ? png_bytes(image, {choice_.exposure_ev, choice_.tone, {}})
                               : png_bytes(overlay, 0.0));
    server_->show(std::move(sent));
}

void ViewLoop::show_file() {
    const Stopwatch cost;
    SessionImage image = session_.image();
    const FileOutputSettings settings = recipe_.output(choice_of(pane_), "view.png");
    describe(image, settings);
    Image overlay;
    if (pane_ == 0) {
        overlays_ = overlay_names(image.image, !flip().empty());
        overlay = overlay_of(image.image, choice_.overlay, flip(), choice_.exposure_ev);
    }
    const bool plain = overlay.layers.empty();
    ViewFrame sent;
    sent.codec = ViewCodec::png;
    sent.pane = pane_;
    sent.final = has_command() && plain;
    sent.version = version_;
    sent.width = image.image.width;
    sent.height = image.image.height;
    sent.samples = static_cast<std::uint32_t>(image.samples);
    sent.milliseconds = static_cast<float>(sample_ms_);
    sent.file = std::make_shared<const std::vector<std::byte>>(
        plain ? png_bytes(image.image, png_settings(image.image, settings))
              : png_bytes(overlay, 0.0));
    shown_as_file_ = true;
    Shown& shown = shown_.at(pane_);
    shown.samples = has_command() ? image.samples : 0;
    shown.image = {pane_, image.samples, beauty_of(image.image)};
    server_->show(std::move(sent));
    next_file_ms_ = std::max(least_file_pause_ms, file_pause_by_cost * cost.total());
    since_file_ = Stopwatch();
    send_status();
}

bool ViewLoop::grow_references(double ms) {
    constexpr std::uint64_t most_samples = 4096;
    if (!choice_.trust || stale_ || changed_) return false;
    if (!references_) references_ = session_.make_references();
    if (references_->samples() >= most_samples) {
        begin_judgement();
        return false;
    }
    unspent_ms_ += ms;
    if (unspent_ms_ < references_->next_ms()) return true;
    const Stopwatch watch;
    const std::uint64_t before = references_->samples();
    let_cancel(true);
    (void)session_.grow(*references_, unspent_ms_, ended_);
    let_cancel(false);
    unspent_ms_ -= watch.total();
    if (references_->samples() == before) return true;
    begin_judgement();
    if (since_status_.total() > status_pause_ms && !judgement_)
        server_->send(json_line({{"trust", trust_report(references_->samples(), judgement_)}}));
    return true;
}

JudgeTask ViewLoop::task_by_references() {
    return {view_,
            choice_.size.width,
            choice_.size.height,
            references_->samples(),
            {beauty_of(references_->half(0)), beauty_of(references_->half(1))},
            {}};
}

void ViewLoop::begin_judgement() {
    const std::optional<JudgedImage>& first = shown_[0].image;
    const std::uint64_t samples = references_->samples();
    if (!first || samples == 0 || !judge_.is_idle()) return;
    // Each judgement takes a while, and tells little where neither has grown much.
    if (samples < 2 * judged_by_ && first->samples < 2 * judged_samples_) return;
    judged_by_ = samples;
    judged_samples_ = first->samples;
    JudgeTask task = task_by_references();
    for (const Shown& shown : shown_)
        if (shown.image) task.images.push_back(*shown.image);
    judge_.begin(std::move(task));
}

void ViewLoop::take_judgement() {
    std::optional<Judgement> found = judge_.take();
    if (!found || found->version != view_ || !references_ || stale_ || changed_) return;
    judgement_ = std::move(found);
    server_->send(json_line({{"trust", trust_report(references_->samples(), judgement_)}}));
    const bool at_rest = phase_ == Phase::refining || phase_ == Phase::finished;
    if (at_rest && pane_ == 0 && shown_[0].samples > 0 &&
        (choice_.overlay == error_overlay_name || overlays_.empty() ||
         overlays_.back() != error_overlay_name))
        show_file();
}

void ViewLoop::begin_measuring() {
    if (phase_ == Phase::moving || phase_ == Phase::paused)
        return say("settings are measured while the view is at rest and not paused");
    if (session_.is_hasty()) stale_ = session_.settle(true);
    if (stale_ || changed_) begin_pane(0);
    if (!references_) references_ = session_.make_references();
    front_.emplace(recipe_.candidates(choice_));
    adopted_.reset();
    measuring_ms_ = 0.0;
    phase_ = Phase::measuring;
    send_front();
    send_status();
}

void ViewLoop::end_measuring() {
    if (phase_ != Phase::measuring) return;
    phase_ = Phase::refining;
    stale_ = true;
    send_front();
}

void ViewLoop::measure() {
    constexpr std::uint64_t enough_samples = 32;
    constexpr double most_reference_ms = 4000.0;
    constexpr double at_once_ms = 250.0;
    if (references_->samples() == 0 ||
        (references_->samples() < enough_samples && measuring_ms_ < most_reference_ms)) {
        const Stopwatch watch;
        let_cancel(true);
        (void)session_.grow(*references_, at_once_ms, ended_);
        let_cancel(false);
        measuring_ms_ += watch.total();
        return;
    }
    const std::optional<ViewFront::Step> step = front_->next();
    if (!step) return end_measuring();
    const ViewCandidate& candidate = front_->candidate(step->point);
    ViewChoice choice = choice_;
    choice.algorithm = candidate.choice.algorithm;
    choice.quality = candidate.choice.quality;
    choice.samples = candidate.choice.samples;
    session_.set_settings(recipe_.settings(choice, choice.size, false));
    session_.set_camera(camera_);
    RenderBudget budget;
    budget.end_early = ended_;
    budget.samples = step->counts ? candidate.samples : 1;
    const Stopwatch watch;
    if (!render(budget)) return;
    const std::vector<float> image = beauty_of(session_.image().image);
    const double ms = watch.total();
    if (step->judged) {
        const ImageFlip found = flip_by_halves(task_by_references(), image);
        front_->set_floor(found.floor);
        front_->took(ms, found.error);
    } else {
        front_->took(ms);
    }
    send_front();
}

void ViewLoop::send_front() {
    if (server_ == nullptr) return;
    const bool running = phase_ == Phase::measuring;
    const Json front = front_ ? front_->json(running, adopted_) : ViewFront({}).json(false, {});
    server_->send(json_line({{"front", front}}));
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
