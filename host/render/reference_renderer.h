// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_REFERENCE_RENDERER_H
#define WEFT_RENDER_REFERENCE_RENDERER_H

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/exact_film.h"
#include "render/exact_renderer.h"
#include "render/path_renderer.h"
#include "render/renderer.h"

namespace weft {

/// Renders references by virtual point lights for what is far and paths for the rest: VPLs that
/// neighbouring pixels choose by what they bring, with a bound that is the same in all samples, and
/// path tracing of what the bound and the number of bounces leave out. Unbiased, like PathRenderer,
/// with less variance at the same time where VPLs land on what is seen. Pixels of a sample share
/// VPLs, so that their errors are correlated; samples are independent. Not for scenes with media.
class ReferenceRenderer : public ExactRenderer {
  public:
    /// `scene` must outlive the renderer. To be followed by `begin`.
    ReferenceRenderer(Executor& executor, const FlatScene& scene,
                      std::shared_ptr<SceneBuffers> uploaded, const Camera& camera,
                      const PathSettings& settings);
    /// Continues the sums where they hold words; see PathRenderer.
    void begin(FilmSums sums) { film_.begin(std::move(sums), identity()); }

    /// Adds one sample, whatever `keep_going` returns; a cancelled one is not added. Returns
    /// whether it was added, more remain and `keep_going` never returned false.
    bool render_frame(const KeepGoing& keep_going) override;

    void set_camera(const Camera& camera) override;
    void update_scene() override;
    void follow_scene() override;

    [[nodiscard]] std::uint32_t samples_left() const noexcept override { return film_.left(); }
    void limit_frames(double, std::uint32_t) noexcept override {}
    [[nodiscard]] bool has_open_frame() const noexcept override { return false; }
    [[nodiscard]] double next_frame_ms() const noexcept override { return sample_ms_; }
    [[nodiscard]] std::uint64_t samples() const override { return film_.samples(); }
    [[nodiscard]] Image image() override { return resolve_sums(sums()); }
    [[nodiscard]] FilmSums sums() override { return film_.read(identity()); }
    [[nodiscard]] const FramePlan& plan() const override { return renderer_.plan(); }
    [[nodiscard]] const std::vector<FrameStats>& stats() const override {
        return renderer_.stats();
    }
    [[nodiscard]] std::vector<FrameStats> take_stats() override { return renderer_.take_stats(); }
    [[nodiscard]] FilmView film() override;

    /// Share of the VPLs of a sample that land on surfaces; 1 where there are none.
    [[nodiscard]] double landed_share() { return renderer_.landed_share(); }

  private:
    [[nodiscard]] const std::string& identity();

    const FlatScene& scene_;
    PathSettings settings_;
    Renderer renderer_;
    ExactFilm film_;
    std::string identity_;  ///< of the image; empty until it is computed
    double sample_ms_ = 0.0;
};

/// The renderer that `settings.algorithm` names. For Algorithm::reference that is a
/// ReferenceRenderer, or a PathRenderer where that is the better one: in scenes with media, and
/// where too few VPLs land on surfaces.
[[nodiscard]] std::unique_ptr<ExactRenderer> make_exact_renderer(
    Executor& executor, const FlatScene& scene, std::shared_ptr<SceneBuffers> uploaded,
    const Camera& camera, const PathSettings& settings, FilmSums sums);

}  // namespace weft

#endif
