// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// How ViewLoop has images judged by references of the view, and measures settings on it.
#include <nlohmann/json.hpp>
#include <utility>

#include "base/json_text.h"
#include "view/view_loop.h"
#include "view/view_overlay.h"
#include "view/view_report.h"

namespace weft {

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

}  // namespace weft
