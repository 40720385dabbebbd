// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_RECIPE_H
#define WEFT_VIEW_VIEW_RECIPE_H

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "plan/algorithm.h"
#include "plan/preset.h"
#include "plan/quality.h"
#include "render/camera_placement.h"
#include "session/file_output.h"
#include "session/render_session.h"
#include "view/view_message.h"

namespace weft {

/// What a view shows.
struct ViewChoice {
    Algorithm algorithm = default_algorithm;
    Quality quality = Quality::preview;
    FilmSize size{};
    double exposure_ev = 0.0;
    ToneCurve tone = ToneCurve::none;
    std::string camera;                        ///< of the scene; empty: the one that it began with
    CameraPlacement placement;                 ///< what is different of it
    std::optional<std::uint32_t> samples;      ///< of a finished image; empty: see ViewRecipe
    std::uint32_t frame = 0;                   ///< of the animation
    std::string edits;                         ///< a file of edits in one line; empty: none
    std::string overlay;                       ///< what is shown over the image; empty: nothing
    std::optional<ViewComparison> comparison;  ///< by what means pane 1 shows the same
    bool trust = false;                        ///< the image is judged by a reference
};

/// Settings to be measured, with a name for people.
struct ViewCandidate {
    std::string name;
    ViewChoice choice;          ///< with a number of samples
    std::uint32_t samples = 1;  ///< of its image
};

/// The frames of a scene's animation.
struct ViewTimeline {
    std::uint32_t frames = 1;  ///< 1: nothing is animated
    double rate = 30.0;        ///< a second
};

/// Says how to render what a view shows, as `weft render` would.
class ViewRecipe {
  public:
    virtual ~ViewRecipe() = default;

    /// The algorithms that there are for this scene.
    [[nodiscard]] virtual std::vector<Algorithm> algorithms() const = 0;
    /// The settings of an image. While the camera is `moving`, those of frames that follow one
    /// another. Throws Error where there are none for this scene.
    [[nodiscard]] virtual ImageSettings settings(const ViewChoice& choice, FilmSize size,
                                                 bool moving) const = 0;
    /// The samples after which an image is finished: those that were chosen, or else as many as its
    /// algorithm can use; empty: it goes on.
    [[nodiscard]] virtual std::optional<std::uint32_t> samples(const ViewChoice& choice) const = 0;
    /// The camera. Throws Error where it cannot be placed so.
    [[nodiscard]] virtual Camera camera(const ViewChoice& choice) const = 0;
    /// How the file of an image is written.
    [[nodiscard]] virtual FileOutputSettings output(const ViewChoice& choice,
                                                    std::filesystem::path file) const = 0;
    /// The command that renders this image with so many samples, to the last bit.
    [[nodiscard]] virtual std::string command(const ViewChoice& choice,
                                              std::uint64_t samples) const = 0;
    /// The preset of such an image with so many samples.
    [[nodiscard]] virtual Preset preset(const ViewChoice& choice, std::uint64_t samples) const = 0;
    /// Three to five settings for a view, from quick to good.
    [[nodiscard]] virtual std::vector<ViewCandidate> candidates(const ViewChoice& choice) const = 0;
    [[nodiscard]] virtual ViewTimeline timeline() const = 0;
};

}  // namespace weft

#endif
