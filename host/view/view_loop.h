// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_LOOP_H
#define WEFT_VIEW_VIEW_LOOP_H

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "base/stopwatch.h"
#include "session/render_session.h"
#include "view/view_edits.h"
#include "view/view_files.h"
#include "view/view_front.h"
#include "view/view_judge.h"
#include "view/view_pace.h"
#include "view/view_recipe.h"
#include "view/view_server.h"

namespace weft {

/// Renders what the pages of a view ask for: small images at once while the camera or the scene
/// moves, then the image in full size, which is refined as long as nothing changes. Where the view
/// is compared, it renders the same by other means before, in the same time. While it is at rest it
/// judges what it shows, and measures settings, if pages want that.
class ViewLoop : public ViewEvents, private DisplayDriver {
  public:
    /// `session`, whose settings and camera are those of `choice`, and `recipe` must outlive it.
    /// Files are saved in `folder`; empty: nowhere.
    ViewLoop(RenderSession& session, const ViewRecipe& recipe, ViewChoice choice,
             std::filesystem::path folder, Diagnostics& diagnostics);
    ~ViewLoop() override;

    /// Renders until `ended` is set, and shows it by `server`.
    void run(ViewServer& server, const std::atomic<bool>& ended);

    [[nodiscard]] std::string hello() override;
    [[nodiscard]] std::uint64_t take(std::uint32_t page, const ViewMessage& message) override;

  private:
    enum class Phase : std::uint8_t { moving, refining, finished, paused, measuring };
    using Change = std::variant<ViewEdit, ViewUndo>;

    /// What pages have asked for since the loop last looked.
    struct Asked {
        std::optional<ViewCamera> camera;
        ViewSettings settings;
        std::vector<Change> changes;    ///< of the scene
        std::optional<bool> moving;     ///< whether more of the last request follows at once
        std::optional<bool> measuring;  ///< begins or ends it
        std::optional<std::uint32_t> adopted;
        std::vector<std::pair<std::uint32_t, ViewPick>> picks;
        std::vector<ViewSave> saves;
        std::uint64_t version = 0;

        [[nodiscard]] bool any() const {
            return version > 0 || measuring || adopted || !picks.empty() || !saves.empty();
        }
    };

    static constexpr double status_pause_ms = 100.0;

    /// What is shown in a pane.
    struct Shown {
        std::uint64_t samples = 0;         ///< of an image that a command makes; else 0
        std::optional<JudgedImage> image;  ///< the same, to be judged
    };

    void show(const DisplayFrame& frame) override;
    [[nodiscard]] double exposure_ev() const override { return choice_.exposure_ev; }
    [[nodiscard]] ToneCurve tone() const override { return choice_.tone; }

    [[nodiscard]] Asked take_asked();
    void wait_for_pages();

    void apply(const Asked& asked);
    void apply_camera(const ViewCamera& camera);
    /// Returns whether images look otherwise from then on.
    bool apply_settings(const ViewSettings& settings);
    void apply_changes(const std::vector<Change>& changes);
    /// Takes the settings of a point that was measured, and saves their preset.
    void apply_point(std::uint32_t point);
    /// Takes a choice, if there are settings for it; else says why not and returns false.
    bool adopt(const ViewChoice& choice);
    /// Begins anew: moving images, or the image at rest.
    void restart(bool moving);
    /// Forgets what holds for one view of the scene only.
    void forget_references();
    /// Writes what a page is told first, from what the view shows now.
    void write_hello();

    void render_moving();
    void render_still();
    /// Renders one image of the size of moving ones, of all that was asked for; returns
    /// milliseconds.
    double render_divided();
    /// Whether the first sample of the image at rest takes so long that a divided one goes before.
    [[nodiscard]] bool is_slow() const;
    /// Begins the image of a pane at rest.
    void begin_pane(std::uint32_t pane);
    /// Begins it again with as many samples as there is time for by its first one, which took so
    /// many milliseconds. Returns false where it need not: it goes on for ever, or has begun again.
    bool plan_samples(double sample_ms);
    /// What a pane shows.
    [[nodiscard]] ViewChoice choice_of(std::uint32_t pane) const;
    [[nodiscard]] bool is_shared() const { return choice_.comparison.has_value(); }
    /// Lets pages end what is being rendered, or no longer.
    void let_cancel(bool can);
    /// Calls RenderSession::render so that pages can end it. Returns milliseconds; empty where it
    /// was cancelled.
    std::optional<double> render(const RenderBudget& budget);
    /// Whether the session has one of pane 0, of all that was asked for.
    [[nodiscard]] bool has_image() const;
    /// Whether the image is one that a command makes.
    [[nodiscard]] bool has_command() const;
    /// Sends the image as a file, such as the command would write.
    void show_file();
    /// Sends the chosen overlay of an image that no command makes.
    void show_overlay();
    /// HDR-FLIP by pixel of pane 0, where that was judged.
    [[nodiscard]] std::span<const float> flip() const;

    /// Lets the references grow for about `ms`, and has images judged by them. Returns whether
    /// there was anything to do.
    bool grow_references(double ms);
    void begin_judgement();
    void take_judgement();

    void begin_measuring();
    void end_measuring();
    /// Makes one of the images that are measured.
    void measure();
    void send_front();
    /// What images are judged by now, without images.
    [[nodiscard]] JudgeTask task_by_references();

    void send_status();
    void send_camera();
    void send_scene();
    /// Answers the picks that wait, once there is an image.
    void answer_picks();
    void pick(std::uint32_t page, const ViewPick& pick, const SessionImage& rendered);
    void save(const ViewSave& save);
    void say(const std::string& line);

    RenderSession& session_;
    const ViewRecipe& recipe_;
    Diagnostics& diagnostics_;
    ViewFiles files_;
    ViewServer* server_ = nullptr;
    const std::atomic<bool>* ended_ = nullptr;

    // Of the thread that renders.
    ViewChoice choice_;
    ViewEdits edits_;
    Camera camera_;
    ViewPace pace_;
    Phase phase_ = Phase::refining;
    bool paused_ = false;
    bool stale_ = true;     ///< the session has other settings than the phase needs
    bool changed_ = false;  ///< the camera or the scene, since the last image
    bool divided_ = false;  ///< the session's image has the size of moving ones
    bool glimpsed_ =
        false;            ///< of that change: a divided image was shown, or the one at rest begun
    bool begun_ = false;  ///< the session has begun the image of that change already
    bool scene_told_ = true;  ///< pages know how the scene is now
    bool shown_as_file_ = false;
    std::uint32_t pane_ = 0;  ///< that is being rendered
    double pane_ms_ = 0.0;    ///< that it has taken
    /// Samples that there is time for, of what is compared and does not go on for ever.
    std::array<std::optional<std::uint32_t>, view_panes> planned_;
    std::optional<std::uint32_t> last_;  ///< samples of its finished image; empty: it goes on
    std::array<Shown, view_panes> shown_;
    std::vector<std::string> overlays_;                      ///< of the image in pane 0
    std::vector<std::pair<std::uint32_t, ViewPick>> picks_;  ///< that wait for an image
    std::uint64_t version_ = 0;
    double sample_ms_ = 0.0;
    /// Of one pixel in the last first sample at rest by this algorithm; empty: unknown.
    std::optional<double> pixel_ms_;
    double next_file_ms_ = 0.0;  ///< pause before the image is shown as a file again
    Stopwatch since_file_, since_request_, since_status_;

    std::unique_ptr<ReferencePair> references_;  ///< of the image at rest
    double unspent_ms_ = 0.0;                    ///< time that they have left
    ViewJudge judge_;
    std::optional<Judgement> judgement_;  ///< the last of this image
    std::uint64_t view_ = 0;              ///< counts the images at rest
    std::uint64_t judged_by_ = 0;         ///< reference samples of the judgement that was begun
    std::uint64_t judged_samples_ = 0;    ///< of the image, likewise

    std::optional<ViewFront> front_;
    std::optional<std::size_t> adopted_;  ///< the point of front_ whose settings the view has
    double measuring_ms_ = 0.0;           ///< that the references got for it

    // Shared with the thread of the server.
    std::mutex mutex_;
    std::condition_variable has_asked_;
    Asked asked_;
    std::uint64_t asked_version_ = 0;
    bool can_cancel_ = false;  ///< what is being rendered is worth less than an answer
    std::string hello_;        ///< as it is now, likewise scene_
    std::string scene_;
};

}  // namespace weft

#endif
