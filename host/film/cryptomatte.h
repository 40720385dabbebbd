// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FILM_CRYPTOMATTE_H
#define WEFT_FILM_CRYPTOMATTE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "image/image.h"

// Identifiers of what pixels show, in the Cryptomatte convention (Friedman and Jones 2015,
// specification 1.2).
namespace weft {

/// MurmurHash3_x86_32 (A. Appleby) of the bytes, with seed 0.
[[nodiscard]] std::uint32_t murmur_hash(std::string_view text);

/// The identifier of a name: the bits of its hash, with an exponent changed where they would be no
/// normal float.
[[nodiscard]] std::uint32_t cryptomatte_id(std::string_view name);

/// How many samples of each pixel show which instance; up to 8 instances a pixel, later ones are
/// not counted.
class InstanceCounts {
  public:
    explicit InstanceCounts(std::size_t pixels) : pixels_(pixels) {}

    /// Adds a sample of every pixel: the instance of each, or INVALID_INDEX, in every second word
    /// (gb_ids of kernels/film/gbuffer.h).
    void add(std::span<const std::uint32_t> ids);

    struct Count {
        std::uint32_t instance = 0;
        std::uint32_t samples = 0;  ///< 0: the entry is unused, as are those after it
    };
    static constexpr std::size_t most = 8;

    [[nodiscard]] const std::array<Count, most>& of(std::size_t pixel) const {
        return pixels_[pixel];
    }
    [[nodiscard]] std::size_t pixels() const noexcept { return pixels_.size(); }
    [[nodiscard]] std::uint32_t samples() const noexcept { return samples_; }

  private:
    std::vector<std::array<Count, most>> pixels_;
    std::uint32_t samples_ = 0;
};

/// Adds the layers LAYER00, LAYER01 and LAYER02 to an image: identifiers and coverage of the six
/// names that cover most of each pixel, in pairs; and metadata with the manifest. `names` has the
/// name of each instance.
void attach_cryptomatte(const std::string& layer, const InstanceCounts& counts,
                        std::span<const std::string> names, Image& image);

/// Whether a layer or an entry of metadata is one of these.
[[nodiscard]] bool is_cryptomatte(std::string_view name);

}  // namespace weft

#endif
