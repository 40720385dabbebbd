// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/render_session.h"

#include <algorithm>
#include <utility>

#include "base/cache_folder.h"
#include "base/free_memory.h"
#include "base/limits.h"
#include "base/stopwatch.h"
#include "pipeline/traced_geometry.h"

namespace weft {

RenderSession::RenderSession(std::unique_ptr<Executor> executor, MovingScene scene,
                             const Camera& camera, const ImageSettings& settings,
                             std::size_t kept_frames)
    : RenderSession(std::move(executor), std::move(scene), camera, settings, kept_frames, {}) {}

RenderSession::RenderSession(std::unique_ptr<Executor> executor, MovingScene scene,
                             const Camera& camera, const ImageSettings& settings,
                             std::size_t kept_frames, FilmSums sums)
    : executor_(std::move(executor)),
      scene_(std::move(scene)),
      camera_(camera),
      settings_(settings),
      stats_(kept_frames),
      resolve_(executor_) {
    upload(false);
    make_renderer(std::move(sums));
}

void RenderSession::upload(bool soon) {
    buffers_ = std::make_shared<SceneBuffers>(upload_scene(executor_, scene_.flat(), soon));
    ++uploads_;
    const FlatScene& flat = scene_.flat();
    const BvhStats* const bvh = executor_.bvh();
    hasty_ = soon && flat.first_moving_triangle < flat.triangles.size() && bvh != nullptr &&
             !bvh->from_cache;
}

void RenderSession::make_renderer(FilmSums sums) {
    delivery_ms_.reset();
    // The old renderer goes first, because two at once would need the memory of both.
    exact_ = nullptr;
    refinement_.reset();
    renderer_.reset();
    stats_.begin_renderer();
    if (const auto* const preview = std::get_if<RenderSettings>(&settings_)) {
        renderer_ =
            std::make_unique<Renderer>(executor_, scene_.flat(), buffers_, camera_, *preview);
        return;
    }
    auto exact = make_exact_renderer(executor_, scene_.flat(), buffers_, camera_,
                                     std::get<PathSettings>(settings_), std::move(sums));
    exact_ = exact.get();
    renderer_ = std::move(exact);
}

void RenderSession::set_camera(const Camera& camera) {
    camera_ = camera;
    refinement_.reset();
    renderer_->set_camera(camera);
}

void RenderSession::move_camera(const Camera& camera) {
    camera_ = camera;
    refinement_.reset();
    renderer_->move_camera(camera);
}

void RenderSession::set_frame(std::uint32_t frame, const Camera& camera) {
    scene_.set_frame(frame);
    if (scene_.moves()) follow_scene();
    move_camera(camera);
}

void RenderSession::set_settings(const ImageSettings& settings) {
    settings_ = settings;
    make_renderer({});
}

void RenderSession::resize(std::uint32_t width, std::uint32_t height) {
    std::visit(
        [&](auto& settings) {
            settings.width = width;
            settings.height = height;
        },
        settings_);
    make_renderer({});
}

void RenderSession::follow_scene() {
    update_scene(executor_, scene_.flat(), *buffers_);
    renderer_->follow_scene();
}

void RenderSession::edit(const std::function<void(const SceneParts&)>& change) {
    if (scene_.edit(change)) {
        follow_scene();
        move_camera(camera_);
        return;
    }
    upload(false);
    make_renderer({});
}

void RenderSession::set_edits(const std::function<EditTimeline(Scene&)>& read, std::uint32_t frame,
                              const Camera& camera) {
    if (scene_.set_edits(read, frame)) {
        follow_scene();
        move_camera(camera);
        return;
    }
    camera_ = camera;
    upload(true);
    make_renderer({});
}

bool RenderSession::settle(bool wait) {
    if (!hasty_) return true;
    if (!wait) {
        if (better_tree_ && !better_tree_->is_done()) return false;
        if (!better_tree_ || better_upload_ != uploads_) {
            better_tree_ = std::make_unique<BetterTree>(traced_geometry(scene_.flat()),
                                                        default_cache_folder());
            better_upload_ = uploads_;
            return false;
        }
    }
    better_tree_.reset();  // one that is being built may be the one
    upload(false);
    make_renderer({});
    return_free_memory();
    return true;
}

void RenderSession::rebuild(const std::function<void(Scene&)>& change) {
    scene_.rebuild(change);
    upload(false);
    make_renderer({});
}

void RenderSession::add_identifiers(Image& image) {
    if (!mattes_.any()) return;
    // As many as the image has, so that edges fit it: more where these are too few for a share, and
    // one through the centre where the image has such edges.
    constexpr std::uint32_t least = 16;
    constexpr std::uint32_t most = 64;
    std::uint32_t samples = 1;
    std::uint32_t seed = 0;
    if (const auto* const path = std::get_if<PathSettings>(&settings_)) {
        seed = path->seed;
        if (!path->through_centres)
            samples =
                static_cast<std::uint32_t>(std::clamp<std::uint64_t>(this->samples(), least, most));
    } else {
        const auto& preview = std::get<RenderSettings>(settings_);
        seed = preview.seed;
        if (preview.samples > 1 || plan().edge_samples > 0)
            samples = std::clamp(preview.samples, least, most);
    }
    (void)add_mattes(executor_, scene_.at_rest(), scene_.flat(), *buffers_,
                     {camera_, image.width, image.height, samples, seed}, mattes_, image);
}

std::unique_ptr<ReferencePair> RenderSession::make_references() {
    PathSettings settings;
    if (const auto* const preview = std::get_if<RenderSettings>(&settings_)) {
        settings = exact_settings(*preview);
    } else {
        settings = std::get<PathSettings>(settings_);
        settings.samples = {0, limits::max_samples_per_pixel};
    }
    return std::make_unique<ReferencePair>(executor_, scene_.flat(), buffers_, camera_, settings);
}

bool RenderSession::grow(ReferencePair& references, double ms, const std::atomic<bool>* end_early) {
    bool added = false;
    {
        const CancellableExecutor::Scope cancelling(executor_);
        added = references.render_frame(
            ms, [&](Stage, double) { return end_early == nullptr || !*end_early; });
    }
    return !executor_.take_request() && added;
}

std::optional<std::uint32_t> RenderSession::instance_at(std::uint32_t x, std::uint32_t y) {
    const FilmSize size = size_of(settings_);
    return weft::instance_at(executor_, scene_.flat(), *buffers_,
                             {camera_, size.width, size.height}, x, y);
}

void RenderSession::denoise(SessionImage& image) const {
    if (denoiser_ == nullptr) return;
    const Stopwatch watch;
    const bool media = scene_.flat().media.present();
    const DenoiseView view = denoise_view(camera_, image.image.width, image.image.height, media);
    if (denoiser_->denoise(image.image, image.samples, view))
        image.denoiser = denoiser_->denoiser();
    image.denoise_ms = watch.total();
}

SessionImage RenderSession::image() {
    SessionImage result;
    if (exact_ != nullptr) {
        result.sums = exact_->sums();
        result.image = resolve_sums(*result.sums);
        // What was chosen: paths alone make the same samples whatever the settings name.
        result.algorithm = plan().exact ? Algorithm::reference : Algorithm::path;
        result.seed = std::get<PathSettings>(settings_).seed;
    } else {
        result.image = renderer_->image();
        if (refinement_ && refinement_->can_correct()) {
            const Stopwatch watch;
            refinement_->correct(result.image, renderer_->samples());
            result.correct_ms = watch.total();
        }
        result.algorithm = std::get<RenderSettings>(settings_).algorithm;
        result.seed = std::get<RenderSettings>(settings_).seed;
    }
    stats_.add(renderer_->take_stats());
    result.samples = samples();
    result.light = renderer_->light();
    return result;
}

}  // namespace weft
