// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_RENDER_SESSION_H
#define WEFT_SESSION_RENDER_SESSION_H

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "base/stopwatch.h"
#include "denoise/image_denoiser.h"
#include "device/cancellable_executor.h"
#include "render/reference_renderer.h"
#include "render/renderer.h"
#include "scene/moving_scene.h"
#include "session/better_tree.h"
#include "session/display_resolve.h"
#include "session/image_watch.h"
#include "session/matte_pass.h"
#include "session/output_driver.h"
#include "session/reference_pair.h"
#include "session/refinement.h"
#include "session/session_stats.h"

namespace weft {

/// Settings of an image, which is a preview or a reference.
using ImageSettings = std::variant<RenderSettings, PathSettings>;

/// Its size, pixels.
[[nodiscard]] inline FilmSize size_of(const ImageSettings& settings) {
    return std::visit([](const auto& of) { return FilmSize{of.width, of.height}; }, settings);
}

/// How far RenderSession::render has come.
struct SessionProgress {
    double fraction = 0.0;  ///< of the call that is done; never falls
    Stage stage{};
};

/// Limits that end rendering. What is empty sets no limit; with no limit at all a preview gets one
/// sample more, and path tracing all of its samples.
struct RenderBudget {
    std::optional<std::uint32_t> samples;  ///< of every pixel of a preview, earlier ones included
    std::optional<double> time_ms;
    double spent_ms = 0.0;     ///< part of time_ms that was spent before the call
    double reserved_ms = 0.0;  ///< part of time_ms for what the caller does after the call
    std::optional<double> target_error;  ///< of path tracing: see relative_error
    /// Ends rendering early once it is set, but with an image where there is any light: the stages
    /// that the first sample needs for one are finished, and it is shown with the light that it
    /// has. May be null.
    const std::atomic<bool>* end_early = nullptr;
    /// Called often, by the thread that renders. May be empty.
    std::function<void(const SessionProgress&)> progress;
};

enum class SessionEnd : std::uint8_t {
    complete,     ///< the budget is spent
    ended_early,  ///< RenderBudget::end_early
    cancelled,    ///< RenderSession::cancel
};

/// Renders one scene on one device interactively: image after image, while the camera, the scene,
/// the size or the algorithm change. The scene is uploaded once. All but cancel() belongs to one
/// thread at a time. Throws Error where Executor does.
class RenderSession {
  public:
    static constexpr std::size_t default_kept_frames = 4096;

    /// Uploads the scene and prepares the first image. `kept_frames`: number of last frames whose
    /// statistics are kept one by one.
    RenderSession(std::unique_ptr<Executor> executor, MovingScene scene, const Camera& camera,
                  const ImageSettings& settings, std::size_t kept_frames = default_kept_frames);
    /// The same, where path tracing continues `sums`; see PathRenderer.
    RenderSession(std::unique_ptr<Executor> executor, MovingScene scene, const Camera& camera,
                  const ImageSettings& settings, std::size_t kept_frames, FilmSums sums);
    RenderSession(const RenderSession&) = delete;
    RenderSession& operator=(const RenderSession&) = delete;

    /// Sets what receives the image of each call of `render`; may be null. Must outlive its use.
    void set_output(OutputDriver* output) {
        output_ = output;
        delivery_ms_.reset();
    }
    /// Sets what receives 8-bit images after each frame; may be null, which costs nothing. Must
    /// outlive its use.
    void set_display(DisplayDriver* display) { display_ = display; }

    /// Sets what receives the image now and then while it is rendered, and when it is finished; may
    /// be null. Must outlive its use. It takes at most a tenth of the time.
    void set_watch(ImageWatch* watch) { watch_ = watch; }

    /// Sets which identifiers images get that are handed to the output; by default none.
    void set_mattes(const MatteSettings& mattes) { mattes_ = mattes; }

    /// Sets what removes noise from images that are handed to the output; may be null. Must outlive
    /// its use. Sums, and images that are saved with them, stay as they are rendered.
    void set_denoiser(const ImageDenoiser* denoiser) {
        denoiser_ = denoiser;
        delivery_ms_.reset();
    }

    /// Adds samples to the image until the budget is spent, shows it after each frame, and writes
    /// it to the output in the end. What that takes is measured, and is part of the budget's time.
    /// A call that ends early before there is any light writes nothing. A cancelled call writes
    /// nothing either: the image is the mean of the frames that were complete, and the next call
    /// continues it.
    SessionEnd render(const RenderBudget& budget);
    /// Ends the call of `render` that is under way, or else the next one, as soon as the launches
    /// that have begun are done. From any thread.
    void cancel() noexcept { executor_.request_cancel(); }

    /// Begins another image from another camera, without any state of those before.
    void set_camera(const Camera& camera);
    /// Begins the next image of a sequence, which may use what those before it have found.
    void move_camera(const Camera& camera);
    /// Begins the next image of a sequence: the scene in another frame of its animation. Throws as
    /// MovingScene::set_frame does.
    void set_frame(std::uint32_t frame, const Camera& camera);
    /// Begins an image with other settings, without another upload of the scene.
    void set_settings(const ImageSettings& settings);
    /// Begins an image of another size, in pixels, likewise.
    void resize(std::uint32_t width, std::uint32_t height);
    /// Changes instances, materials and lights, and begins the next image of the sequence; uploads
    /// what has to be. Throws as MovingScene::edit does; then nothing has changed.
    void edit(const std::function<void(const SceneParts&)>& change);
    /// Replaces all edits of the scene and brings it to a frame of its animation, seen from a
    /// camera. Begins the next image of the sequence, or another image where instances begin or end
    /// to be movable. Their BVH may be a hasty one (is_hasty). Throws as MovingScene::set_edits
    /// does; then nothing has changed.
    void set_edits(const std::function<EditTimeline(Scene&)>& read, std::uint32_t frame,
                   const Camera& camera);
    /// Whether the BVH was built for somebody who waits (TracedGeometry::soon), so that a few
    /// pixels may differ from those of an image for which nobody waits.
    [[nodiscard]] bool is_hasty() const { return hasty_; }
    /// Replaces a hasty BVH, which is built anew in the background, and begins another image.
    /// Unless it shall `wait`, it returns false, with nothing changed, where the new one is not
    /// there yet. Does nothing where the BVH is not hasty.
    bool settle(bool wait);
    /// Changes anything in the scene and begins another image; uploads all of the scene. Throws as
    /// MovingScene::rebuild does; then nothing has changed.
    void rebuild(const std::function<void(Scene&)>& change);

    /// Begins references of the image that is being rendered. They hold until the scene, the
    /// camera, the size or the settings change, and must be gone before the session is.
    [[nodiscard]] std::unique_ptr<ReferencePair> make_references();
    /// Lets references grow: ReferencePair::render_frame. `cancel` ends that, and so does
    /// `end_early` once it is set, which may be null.
    bool grow(ReferencePair& references, double ms, const std::atomic<bool>* end_early);
    /// The instance that a pixel of the image shows at its centre; empty where that is none.
    [[nodiscard]] std::optional<std::uint32_t> instance_at(std::uint32_t x, std::uint32_t y);

    /// The image rendered so far, which has at least one sample; a path-traced frame that was
    /// cancelled is finished first.
    [[nodiscard]] SessionImage image();
    /// Samples of every pixel, those of the preview and those that refine it.
    [[nodiscard]] std::uint64_t samples() const { return renderer_->samples() + refined_samples(); }
    /// Those that refine the preview; see RenderSettings::refined_after.
    [[nodiscard]] std::uint64_t refined_samples() const {
        return refinement_ ? refinement_->samples() : 0;
    }
    /// See FrameRenderer::light.
    [[nodiscard]] std::vector<LightShare> light() const { return renderer_->light(); }
    [[nodiscard]] const FramePlan& plan() const { return renderer_->plan(); }
    [[nodiscard]] const Camera& camera() const { return camera_; }
    [[nodiscard]] const ImageSettings& settings() const { return settings_; }
    [[nodiscard]] const MovingScene& scene() const { return scene_; }
    [[nodiscard]] const Executor& executor() const { return executor_; }
    [[nodiscard]] const SessionStats& stats() const { return stats_; }

  private:
    void upload(bool soon);
    void make_renderer(FilmSums sums);
    /// Brings buffers and renderer up to date where the scene has changed in place.
    void follow_scene();
    SessionEnd render_preview(const RenderBudget& budget);
    class PreviewLoop;  // spends the budget of a preview
    SessionEnd render_reference(const RenderBudget& budget);
    /// Renders and shows one frame; returns what FrameRenderer::render_frame does.
    bool render_frame(const KeepGoing& keep_going);
    /// Hands the image to the watch, where that has waited long enough.
    void update_watch();
    void deliver(bool complete);
    /// Milliseconds that the next call of `deliver` will take: as long as the one before, or as the
    /// resolve of the image as it is now and a rehearsal of its output.
    double delivery_ms();
    void add_identifiers(Image& image);
    void denoise(SessionImage& image) const;

    CancellableExecutor executor_;
    MovingScene scene_;
    Camera camera_;
    ImageSettings settings_;
    std::shared_ptr<SceneBuffers> buffers_;
    bool hasty_ = false;                       ///< see is_hasty
    std::uint64_t uploads_ = 0;                ///< how often the scene was uploaded
    std::unique_ptr<BetterTree> better_tree_;  ///< in place of a hasty one
    std::uint64_t better_upload_ = 0;          ///< for which it is built
    std::unique_ptr<FrameRenderer> renderer_;
    ExactRenderer* exact_ = nullptr;        ///< renderer_, where it is an ExactRenderer
    std::optional<Refinement> refinement_;  ///< of renderer_'s image, once it has begun
    SessionStats stats_;
    DisplayResolve resolve_;
    OutputDriver* output_ = nullptr;
    std::optional<double> delivery_ms_;  ///< of the last image of these settings for this output
    DisplayDriver* display_ = nullptr;
    ImageWatch* watch_ = nullptr;
    Stopwatch watched_;           ///< since the last update of the watch
    double next_watch_ms_ = 0.0;  ///< when it gets the next
    MatteSettings mattes_;
    const ImageDenoiser* denoiser_ = nullptr;
};

}  // namespace weft

#endif
