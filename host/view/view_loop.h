// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_LOOP_H
#define WEFT_VIEW_VIEW_LOOP_H

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/stopwatch.h"
#include "session/render_session.h"
#include "view/view_pace.h"
#include "view/view_recipe.h"
#include "view/view_server.h"

namespace weft {

/// Renders what the pages of a view ask for: small images at once while the camera moves, then the
/// image in full size, which is refined as long as nothing changes.
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
    enum class Phase : std::uint8_t { moving, refining, finished, paused };

    /// What pages have asked for since the loop last looked.
    struct Asked {
        std::optional<ViewCamera> camera;
        ViewSettings settings;
        std::vector<std::pair<std::uint32_t, ViewPick>> picks;
        std::vector<ViewSave> saves;
        std::uint64_t version = 0;
    };

    void show(const DisplayFrame& frame) override;
    [[nodiscard]] double exposure_ev() const override { return choice_.exposure_ev; }
    [[nodiscard]] ToneCurve tone() const override { return choice_.tone; }

    [[nodiscard]] Asked take_asked();
    void wait_for_pages();
    void apply(const Asked& asked);
    void apply_camera(const ViewCamera& camera);
    void apply_settings(const ViewSettings& settings);
    /// Takes a choice, if there are settings for it; else says why not and returns false.
    bool adopt(const ViewChoice& choice);
    /// Writes what a page is told first, from what the view shows now.
    void write_hello();
    void render_moving();
    void render_still();
    /// Whether the image is one that a command makes.
    [[nodiscard]] bool has_command() const;
    /// Sends the image as a file, such as the command would write.
    void show_file();
    void send_status();
    void send_camera();
    void pick(std::uint32_t page, const ViewPick& pick);
    void save(const ViewSave& save);
    [[nodiscard]] std::filesystem::path next_file(const char* extension) const;
    void say(const std::string& line);

    RenderSession& session_;
    const ViewRecipe& recipe_;
    Diagnostics& diagnostics_;
    std::filesystem::path folder_;
    ViewServer* server_ = nullptr;
    const std::atomic<bool>* ended_ = nullptr;

    // Of the thread that renders.
    ViewChoice choice_;
    Camera camera_;
    std::optional<std::uint32_t> last_;  ///< samples of a finished image; empty: it goes on
    ViewPace pace_;
    Phase phase_ = Phase::refining;
    bool paused_ = false;
    bool stale_ = true;          ///< the session has other settings than the phase needs
    bool camera_moved_ = false;  ///< since the last image
    bool shown_as_file_ = false;
    std::uint64_t file_samples_ = 0;  ///< of the file that is shown; 0: no command makes it
    std::uint64_t version_ = 0;
    double sample_ms_ = 0.0;
    double next_file_ms_ = 0.0;  ///< pause before the image is shown as a file again
    Stopwatch since_file_, since_camera_, since_status_;

    // Shared with the thread of the server.
    std::mutex mutex_;
    std::condition_variable has_asked_;
    Asked asked_;
    std::uint64_t asked_version_ = 0;
    bool can_cancel_ = false;  ///< what is being rendered is worth less than an answer
    std::string hello_;        ///< as it is now
};

}  // namespace weft

#endif
