// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_FRAME_H
#define WEFT_VIEW_VIEW_FRAME_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace weft {

/// Images that a page can show beside each other.
inline constexpr std::size_t view_panes = 2;

/// How the image of a frame is coded.
enum class ViewCodec : std::uint8_t { jpeg, png };

/// An image of a view, as its pages get it.
struct ViewFrame {
    ViewCodec codec{};
    std::uint32_t pane = 0;               ///< below view_panes; 1: what is compared
    bool moving = false;                  ///< the camera does
    bool final = false;                   ///< the file that `weft render` would write
    std::uint64_t version = 0;            ///< of what pages have asked for: the last that it shows
    std::uint32_t width = 0, height = 0;  ///< pixels, below 65536
    std::uint32_t samples = 0;            ///< of every pixel
    float milliseconds = 0.0F;            ///< that its last sample took
    std::shared_ptr<const std::vector<std::byte>> file;
    std::uint64_t number = 0;  ///< given by the server, in the order in which they are shown
};

/// Bytes before the file of a frame.
inline constexpr std::size_t view_frame_head_bytes = 28;

/// What is sent before the file: `WFT1`, codec, pane, flags, sequence number, the page's number of
/// what is shown, size, samples and milliseconds, little-endian.
[[nodiscard]] std::array<std::byte, view_frame_head_bytes> view_frame_head(const ViewFrame& frame,
                                                                           std::uint32_t sequence,
                                                                           std::uint32_t state);

}  // namespace weft

#endif
