// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_MESSAGE_H
#define WEFT_VIEW_VIEW_MESSAGE_H

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "image/tone.h"
#include "plan/algorithm.h"
#include "plan/quality.h"
#include "render/camera_placement.h"
#include "scene/scene.h"

namespace weft {

/// The key that a page shows first.
struct ViewKey {
    std::string token;
};

/// A page has drawn a frame.
struct ViewAck {
    std::uint32_t sequence = 0;
};

/// A page looks from elsewhere.
struct ViewCamera {
    CameraView view;
    double fov = 0.0;         ///< degrees
    bool moving = false;      ///< more of these follow at once
    std::uint32_t state = 0;  ///< the page's number of what it shows from then on
};

/// What a view is compared with: the same by other means, in the same time.
struct ViewComparison {
    Algorithm algorithm = default_algorithm;
    Quality quality = Quality::preview;
    double seconds = 1.0;  ///< that each of both gets, 0.01 to 3600

    bool operator==(const ViewComparison&) const = default;
};

/// A page asks for other settings; what is empty stays.
struct ViewSettings {
    std::optional<Algorithm> algorithm{};
    std::optional<Quality> quality{};
    std::optional<FilmSize> size{};       ///< within the limits of a film
    std::optional<double> exposure_ev{};  ///< stops, -100 to 100
    std::optional<ToneCurve> tone{};
    std::optional<bool> paused{};
    std::optional<std::string> camera{};     ///< a name, maybe of no camera
    std::optional<std::uint32_t> frame{};    ///< of the animation
    std::optional<std::uint32_t> samples{};  ///< that the image gets; 0: as many as there is time
    std::optional<std::string> overlay{};    ///< a name, maybe of none; empty text: no overlay
    std::optional<std::optional<ViewComparison>> compare{};
    std::optional<bool> trust{};  ///< the image is judged by a reference
    bool moving = false;          ///< more frames follow at once
    std::uint32_t state = 0;      ///< as ViewCamera::state
};

/// A page changes the scene.
struct ViewEdit {
    std::string change;       ///< JSON: an edit as in a file of edits, without its frame
    bool continues = false;   ///< it replaces the edit before
    bool moving = false;      ///< more of these follow at once
    std::uint32_t state = 0;  ///< as ViewCamera::state
};

/// A page takes edits back.
struct ViewUndo {
    bool all = false;         ///< else the last
    std::uint32_t state = 0;  ///< as ViewCamera::state
};

/// A page asks what settings cost in this view, or for an end of that.
struct ViewMeasure {
    bool begin = true;
};

/// A page takes the settings of a point that was measured.
struct ViewAdopt {
    std::uint32_t point = 0;  ///< maybe of none
};

/// A page asks what a pixel shows.
struct ViewPick {
    std::uint32_t x = 0, y = 0;  ///< of the image in full size, maybe outside of it
};

/// The files that a page can ask for: the image, its settings, or the edits of the scene.
enum class SavedFile : std::uint8_t { png, exr, preset, edits };
inline constexpr std::array<std::string_view, 4> saved_file_names = {"png", "exr", "preset",
                                                                     "edits"};

/// A page asks for a file.
struct ViewSave {
    SavedFile file{};
};

using ViewMessage = std::variant<ViewKey, ViewAck, ViewCamera, ViewSettings, ViewEdit, ViewUndo,
                                 ViewMeasure, ViewAdopt, ViewPick, ViewSave>;

/// The page's number of what a message asks for; 0 where that changes nothing that is shown.
[[nodiscard]] std::uint32_t state_of(const ViewMessage& message);

/// Longest message of a page, bytes.
inline constexpr std::size_t max_view_message_bytes = std::size_t{64} << 10U;

/// Reads a message of a page, which may be anything. Throws Error (exit code 2) with one line that
/// says what is wrong.
[[nodiscard]] ViewMessage read_view_message(std::string_view text);

}  // namespace weft

#endif
