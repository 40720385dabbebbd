// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "view/view_frame.h"

#include <bit>
#include <cstring>

namespace weft {
namespace {

constexpr std::uint16_t moving_flag = 1;
constexpr std::uint16_t final_flag = 2;

}  // namespace

std::array<std::byte, view_frame_head_bytes> view_frame_head(const ViewFrame& frame,
                                                             std::uint32_t sequence,
                                                             std::uint32_t state) {
    static_assert(std::endian::native == std::endian::little);
    std::array<std::byte, view_frame_head_bytes> head{};
    std::size_t at = 0;
    const auto put = [&](auto value) {
        std::memcpy(head.data() + at, &value, sizeof(value));
        at += sizeof(value);
    };
    for (const char c : {'W', 'F', 'T', '1'}) put(c);
    put(static_cast<std::uint8_t>(frame.codec));
    put(static_cast<std::uint8_t>(frame.pane));
    put(static_cast<std::uint16_t>((frame.moving ? moving_flag : 0) |
                                   (frame.final ? final_flag : 0)));
    put(sequence);
    put(state);
    put(static_cast<std::uint16_t>(frame.width));
    put(static_cast<std::uint16_t>(frame.height));
    put(frame.samples);
    put(frame.milliseconds);
    return head;
}

}  // namespace weft
