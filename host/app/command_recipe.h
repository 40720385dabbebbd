// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_COMMAND_RECIPE_H
#define WEFT_APP_COMMAND_RECIPE_H

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"
#include "scene/moving_scene.h"
#include "view/view_recipe.h"

namespace weft {

/// The frames of a scene's animation, that of the longest of its clips, at so many a second; with
/// those that edits reach.
[[nodiscard]] ViewTimeline timeline_of(const Scene& scene, const EditTimeline& edits,
                                       double frame_rate);

/// Says how `weft render` renders what a view shows, with the options of the view.
class CommandRecipe : public ViewRecipe {
  public:
    /// `given`: the camera that the view begins with. `options` and `scene` must outlive it.
    CommandRecipe(const RenderOptions& options, const MovingScene& scene, Camera given,
                  const ViewTimeline& timeline)
        : options_(options), scene_(scene), given_(std::move(given)), timeline_(timeline) {}

    [[nodiscard]] std::vector<Algorithm> algorithms() const override;
    [[nodiscard]] ImageSettings settings(const ViewChoice& choice, FilmSize size,
                                         bool moving) const override;
    [[nodiscard]] std::optional<std::uint32_t> samples(const ViewChoice& choice) const override;
    [[nodiscard]] Camera camera(const ViewChoice& choice) const override;
    [[nodiscard]] FileOutputSettings output(const ViewChoice& choice,
                                            std::filesystem::path file) const override;
    [[nodiscard]] std::string command(const ViewChoice& choice,
                                      std::uint64_t samples) const override;
    [[nodiscard]] Preset preset(const ViewChoice& choice, std::uint64_t samples) const override;
    [[nodiscard]] std::vector<ViewCandidate> candidates(const ViewChoice& choice) const override;
    [[nodiscard]] ViewTimeline timeline() const override { return timeline_; }

  private:
    /// Whether some materials are more than diffuse.
    [[nodiscard]] bool has_materials() const { return scene_.flat().surfaces.present(); }
    /// Whether media are or were inside of surfaces (empty_surfaces).
    [[nodiscard]] bool has_filled_surfaces() const {
        return scene_.at_rest().emptied_surfaces ||
               std::ranges::any_of(
                   scene_.at_rest().medium_boundaries,
                   [](const MediumBoundary& boundary) { return boundary.surface >= 0; });
    }
    [[nodiscard]] RenderOptions options_of(const ViewChoice& choice) const;
    /// Whether samples lead such an image on to the truth for ever.
    [[nodiscard]] bool goes_on(RenderOptions options) const;
    /// Whether the image is one of a frame, rather than of the scene as it rests.
    [[nodiscard]] bool has_frame(const ViewChoice& choice) const {
        return timeline_.frames > 1 || !choice.edits.empty();
    }

    const RenderOptions& options_;
    const MovingScene& scene_;
    Camera given_;
    ViewTimeline timeline_;
};

}  // namespace weft

#endif
