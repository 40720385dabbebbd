// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_MESSAGE_H
#define WEFT_VIEW_VIEW_MESSAGE_H

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

/// A page asks for other settings; what is empty stays.
struct ViewSettings {
    std::optional<Algorithm> algorithm{};
    std::optional<Quality> quality{};
    std::optional<FilmSize> size{};       ///< within the limits of a film
    std::optional<double> exposure_ev{};  ///< stops, -100 to 100
    std::optional<ToneCurve> tone{};
    std::optional<bool> paused{};
    std::optional<std::string> camera{};  ///< a name, maybe of no camera
    std::uint32_t state = 0;              ///< as ViewCamera::state
};

/// A page asks what a pixel shows.
struct ViewPick {
    std::uint32_t x = 0, y = 0;  ///< of the image in full size, maybe outside of it
};

/// A page asks for a file.
struct ViewSave {
    bool exr = false;  ///< else PNG
};

using ViewMessage = std::variant<ViewKey, ViewAck, ViewCamera, ViewSettings, ViewPick, ViewSave>;

/// Longest message of a page, bytes.
inline constexpr std::size_t max_view_message_bytes = std::size_t{64} << 10U;

/// Reads a message of a page, which may be anything. Throws Error (exit code 2) with one line that
/// says what is wrong.
[[nodiscard]] ViewMessage read_view_message(std::string_view text);

}  // namespace weft

#endif
