// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PLAN_DENOISER_H
#define WEFT_PLAN_DENOISER_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace weft {

/// What removes noise from a rendered image.
enum class Denoiser : std::uint8_t {
    none,
    statistical,  ///< means over pixels whose difference is no more than noise
    oidn          ///< the library Open Image Denoise
};

// Names on the command line and in files, in the order of the enumeration.
inline constexpr std::array<std::string_view, 3> denoiser_names = {"none", "statistical", "oidn"};

[[nodiscard]] constexpr std::string_view to_string(Denoiser denoiser) {
    return denoiser_names[static_cast<std::size_t>(denoiser)];
}

}  // namespace weft

#endif
