// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <exception>
#include <limits>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "session/deadline.h"
#include "session/render_session.h"

// How RenderSession spends a budget.
namespace weft {
namespace {

/// Share of a frame that is done, by the time that its stages usually take.
double share_of_frame(Stage stage, double done) {
    constexpr double before_gather = 0.1;
    constexpr double direct = 0.15;
    if (stage == Stage::vpl_gather || stage == Stage::hemisphere_rays ||
        stage == Stage::bounce_rays)
        return before_gather + direct + 0.7 * done;
    if (stage == Stage::area_lights || stage == Stage::distant_light)
        return before_gather + direct * done;
    if (stage == Stage::vpl_residual) return 0.95;
    if (stage == Stage::reconstruction || stage == Stage::composition) return 0.97;
    return before_gather * done * 0.5;
}

/// Whether all later stages need this one, which reads no light: the first frame finishes it.
bool is_needed_by_all(Stage stage) {
    return stage == Stage::primary_rays || stage == Stage::receivers;
}

bool is_ended(const RenderBudget& budget) {
    return budget.end_early != nullptr && *budget.end_early;
}

/// Of so many samples of a refined preview, how many are its own. Its noise falls faster than that
/// of unbiased samples in the same time, until it is as small as its errors of other kinds.
std::uint64_t preview_samples(std::uint32_t refined_after, std::uint64_t samples) {
    constexpr std::uint64_t most = 4;
    const std::uint64_t least = refined_after;
    return std::min(samples, std::clamp((samples + 1) / 2, least, most * least));
}

/// Frames of exact samples take this share of the time that is left: several until the end, each
/// with a better idea of what a sample takes.
constexpr double share_of_rest = 0.35;

/// Checks whether an image's error is small enough, after 16, 32, 64 ... samples: reading it costs
/// as much as some samples do, and with frequent checks rendering would end by chance.
class ErrorTarget {
  public:
    explicit ErrorTarget(const std::optional<double>& target) : target_(target) {}

    bool reached(ExactRenderer& renderer, const Executor& executor) {
        if (!target_ || renderer.has_open_frame() || renderer.samples() < next_check_) return false;
        next_check_ = 2 * renderer.samples();
        const PixelNoise noise =
            renderer.plan().exact ? PixelNoise::shared : PixelNoise::independent;
        return relative_error(renderer.sums(), noise, [&] { return !executor.cancelled(); }) <=
               *target_;
    }

  private:
    std::optional<double> target_;
    std::uint64_t next_check_ = 16;
};

}  // namespace

SessionEnd RenderSession::render(const RenderBudget& budget) {
    SessionEnd end{};
    {
        const CancellableExecutor::Scope cancelling(executor_);
        end = exact_ != nullptr ? render_reference(budget) : render_preview(budget);
    }
    if (executor_.take_request()) return SessionEnd::cancelled;
    deliver(end == SessionEnd::complete);
    return end;
}

bool RenderSession::render_frame(const KeepGoing& keep_going) {
    const std::uint64_t before = renderer_->samples();
    const bool more = renderer_->render_frame(keep_going);
    stats_.add(renderer_->take_stats());
    if (display_ != nullptr && renderer_->samples() > before && !executor_.cancelled())
        resolve_.show(renderer_->film(), *display_);
    if (renderer_->samples() > before) update_watch();
    return more;
}

void RenderSession::update_watch() {
    if (watch_ == nullptr || executor_.cancelled() || watched_.total() < next_watch_ms_) return;
    const Stopwatch cost;
    watch_->update(image());
    constexpr double least_pause_ms = 200.0;
    constexpr double pause_by_cost = 9.0;
    next_watch_ms_ = std::max(least_pause_ms, pause_by_cost * cost.total());
    watched_ = Stopwatch();
}

/// One call of `render` for a preview.
class RenderSession::PreviewLoop {
  public:
    PreviewLoop(RenderSession& session, const RenderBudget& budget)
        : session_(session),
          budget_(budget),
          deadline_(budget.time_ms, budget.spent_ms),
          samples_(budget.samples.value_or(
              deadline_.is_set() ? std::numeric_limits<std::uint32_t>::max()
                                 : static_cast<std::uint32_t>(session.samples()) + 1)) {}

    SessionEnd run() {
        while (session_.samples() < samples_ && !is_ended(budget_)) {
            const std::uint32_t unbiased = unbiased_next();
            if (!(unbiased > 0 ? refine(unbiased) : add_sample())) break;
            if (deadline_.left_ms() > 0.0 && deadline_.is_set())
                deadline_.reserve(session_.delivery_ms() + budget_.reserved_ms);
        }
        return is_ended(budget_) ? SessionEnd::ended_early : SessionEnd::complete;
    }

  private:
    /// How many unbiased samples come next, before the next one of the preview.
    [[nodiscard]] std::uint32_t unbiased_next() const {
        const std::uint32_t after = std::get<RenderSettings>(session_.settings_).refined_after;
        const std::uint64_t preview = session_.renderer_->samples();
        const std::uint64_t done = session_.samples();
        if (after == 0 || !has_time_to_refine()) return 0;
        std::uint32_t count = 0;
        while (done + count < samples_ && count < most_at_once &&
               preview >= preview_samples(after, done + count + 1))
            ++count;
        return count;
    }

    [[nodiscard]] bool has_time_to_refine() const {
        if (!deadline_.is_set() || session_.renderer_->samples() == 0) return true;
        if (session_.refinement_) return deadline_.left_ms() > session_.refinement_->next_ms();
        // A correction takes two unbiased samples at least, each of which takes about twice as long
        // as one of the preview, or several times as long where there is much to trace.
        constexpr double worth_beginning = 8.0;
        return sample_ms_ > 0.0 && deadline_.left_ms() > worth_beginning * sample_ms_;
    }

    /// Adds a sample of the preview. Returns whether that was possible.
    bool add_sample() {
        const bool first = session_.renderer_->samples() == 0;
        if (!first && deadline_.left_ms() <= finish_ms_) return false;
        const double begin_ms = deadline_.ms();
        double asked_ms = begin_ms;  // when the frame was last asked whether to go on
        const bool added = session_.render_frame([&](Stage stage, double done) {
            asked_ms = deadline_.ms();
            report(share_of_frame(stage, done), stage);
            // A first frame is finished even when the time is up, so that there is an image.
            if (first && is_needed_by_all(stage)) return true;
            const bool out_of_time = !first && deadline_.left_ms() < finish_ms_;
            return !is_ended(budget_) && !out_of_time;
        });
        finish_ms_ = deadline_.ms() - asked_ms;
        sample_ms_ = deadline_.ms() - begin_ms;
        return added;
    }

    /// Adds up to `most` unbiased samples. Returns whether that was possible.
    bool refine(std::uint32_t most) {
        std::optional<Refinement>& refinement = session_.refinement_;
        if (!refinement)
            refinement.emplace(session_.executor_, session_.scene_.flat(), session_.buffers_,
                               session_.camera_, std::get<RenderSettings>(session_.settings_));
        const bool could_correct = refinement->can_correct();
        const bool added = refinement->render_frame(most, share_of_rest * deadline_.left_ms(),
                                                    [&](Stage stage, double) {
                                                        report(0.0, stage);
                                                        return !is_ended(budget_);
                                                    });
        session_.stats_.add(refinement->take_stats());
        if (added) session_.update_watch();
        // A correction takes time of its own.
        if (refinement->can_correct() && !could_correct) session_.delivery_ms_.reset();
        return added;
    }

    /// Tells how far the call has come: never less than before. `done`: of the next sample.
    void report(double done, Stage stage) {
        const double of_time = deadline_.is_set() ? deadline_.share() : 0.0;
        const double of_samples = (static_cast<double>(session_.samples()) + done) / samples_;
        shown_ = std::max({shown_, of_samples, of_time});
        if (budget_.progress) budget_.progress({shown_, stage});
    }

    static constexpr std::uint32_t most_at_once = 256;

    RenderSession& session_;
    const RenderBudget& budget_;
    Deadline deadline_;
    std::uint32_t samples_;   ///< that the image is to have
    double finish_ms_ = 0.0;  ///< of a frame's end: reconstruction and composition
    double sample_ms_ = 0.0;  ///< of the preview's last sample in this call
    double shown_ = 0.0;
};

SessionEnd RenderSession::render_preview(const RenderBudget& budget) {
    return PreviewLoop(*this, budget).run();
}

SessionEnd RenderSession::render_reference(const RenderBudget& budget) {
    Deadline deadline(budget.time_ms, budget.spent_ms);
    if (delivery_ms_) deadline.reserve(*delivery_ms_ + budget.reserved_ms);
    const std::uint32_t all = exact_->samples_left();
    ErrorTarget target(budget.target_error);
    const std::optional<double> interval =
        output_ != nullptr ? output_->save_interval_ms() : std::nullopt;
    double saved = deadline.ms();
    const auto share_done = [&] {
        if (deadline.is_set()) return deadline.share();
        return all > 0 ? static_cast<double>(all - exact_->samples_left()) / all : 1.0;
    };
    const KeepGoing keep_going = [&](Stage stage, double) {
        if (budget.progress) budget.progress({share_done(), stage});
        return !is_ended(budget);
    };
    while (exact_->samples_left() > 0 && !is_ended(budget)) {
        const bool has_image = exact_->samples() > 0;
        if (deadline.is_set() && has_image && deadline.left_ms() > 0.0)
            deadline.reserve(delivery_ms() + budget.reserved_ms);
        exact_->limit_frames(share_of_rest * deadline.left_ms());
        if (has_image && exact_->next_frame_ms() > deadline.left_ms()) break;
        if (target.reached(*exact_, executor_)) break;
        if (!render_frame(keep_going)) break;
        if (interval && deadline.ms() - saved > *interval) {
            const FilmSums sums = exact_->sums();
            try {
                output_->save(sums, resolve_sums(sums));
            } catch (const Error&) {
                // A full disk may have room again: the last attempt decides (see `deliver`).
            }
            saved = deadline.ms();
        }
    }
    return is_ended(budget) ? SessionEnd::ended_early : SessionEnd::complete;
}

void RenderSession::deliver(bool complete) {
    if (output_ == nullptr) return;
    const Stopwatch watch;
    // It would be black, and an earlier image of that name may be in its place.
    if (!complete && (samples() == 0 || is_dark(light()))) return;
    SessionImage result = image();
    result.complete = complete;
    add_identifiers(result.image);
    // Sums that cannot be saved are no reason to lose the image.
    std::exception_ptr unsaved;
    if (result.sums && output_->save_interval_ms()) {
        try {
            output_->save(*result.sums, result.image);
        } catch (const Error&) {
            unsaved = std::current_exception();
        }
    }
    denoise(result);
    if (watch_ != nullptr) watch_->update(result);
    output_->write(std::move(result));
    delivery_ms_ = watch.total();
    if (unsaved) std::rethrow_exception(unsaved);
}

double RenderSession::delivery_ms() {
    if (output_ == nullptr) return 0.0;
    if (!delivery_ms_) {
        constexpr std::uint64_t least = 2;
        const Stopwatch watch;
        SessionImage now = image();
        // A first sample has no variance, but the image will have one, and then be denoised.
        const std::uint64_t samples = std::exchange(now.samples, std::max(now.samples, least));
        denoise(now);
        now.samples = samples;
        const double resolve_ms = watch.total();
        delivery_ms_ = resolve_ms + output_->write_ms(now);
    }
    return *delivery_ms_;
}

}  // namespace weft
