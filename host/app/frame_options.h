// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_APP_FRAME_OPTIONS_H
#define WEFT_APP_FRAME_OPTIONS_H

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/scene_edits.h"

namespace CLI {
class App;
}

namespace weft {

struct RenderOptions;

/// Frames [first, end) of an animation, at least one.
struct FrameRange {
    std::uint32_t first = 0;
    std::uint32_t end = 1;
};

/// Adds the options of animations to `weft render`.
void add_frames(CLI::App& render);

/// The value of --frame-rate. Throws Error (exit code 1) where it is out of range.
[[nodiscard]] double parse_frame_rate(const std::string& text);

/// Reads these options, after all others have been read. Throws Error (exit code 1).
void read_frames(const CLI::App& command, RenderOptions& options);

/// Edits as --edits gives them, which nobody has checked yet, and what messages call them.
struct GivenEdits {
    nlohmann::json json;
    std::string place;
};

/// Reads the JSON that --edits gives: a file, or where the text begins with a brace, itself. Throws
/// Error (exit code 2) where it is not JSON.
[[nodiscard]] GivenEdits given_edits(const std::filesystem::path& given);

/// Reads these edits for a scene. Throws Error as read_scene_edits does.
[[nodiscard]] EditTimeline read_edits(const std::filesystem::path& given, Scene& scene);

/// The file of one frame: `out.png` becomes `out.0007.png`, with more digits from 10000 on.
[[nodiscard]] std::filesystem::path numbered_output(const std::filesystem::path& output,
                                                    std::uint32_t frame);

}  // namespace weft

#endif
