// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>
#include <variant>

#include "base/error.h"
#include "scene/scene_edits.h"

namespace weft {
namespace {

using Json = nlohmann::json;

// A page that has said that more follows, and then nothing, has lost its pointer.
constexpr double most_silence_ms = 500.0;
constexpr std::size_t most_waiting = 64;  // requests that wait for an answer
constexpr double unbiased_ms = 250.0;     // of path tracing, between two looks at what is asked

bool is_same_size(FilmSize a, FilmSize b) {
    return a.width == b.width && a.height == b.height;
}

/// Reads edits in one line, which may be empty, for a scene.
std::function<EditTimeline(Scene&)> edits_of(const std::string& text) {
    return [&text](Scene& scene) {
        if (text.empty()) return EditTimeline{};
        return read_scene_edits(Json::parse(text), "edits", scene);
    };
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
        if (choice.algorithm != choice_.algorithm || choice.quality != choice_.quality)
            pixel_ms_.reset();
        camera_ = camera;
        choice_ = choice;
    } catch (const Error& error) {
        say(error.what());
        return false;
    }
    write_hello();
    return true;
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
    if (before == 0 && pane_ == 0) {
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

}  // namespace weft
