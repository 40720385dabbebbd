// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FILM_FILM_SUMS_H
#define WEFT_FILM_FILM_SUMS_H

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "image/image.h"

namespace weft {

/// Samples [first, end) of every pixel.
struct SampleRange {
    std::uint32_t first = 0;
    std::uint32_t end = 0;

    bool operator==(const SampleRange&) const = default;
};

/// The exact sums of a path-traced image; see kernels/film/film_sums.h. Sums of disjoint samples
/// of one image add up to the sums of all of them, bit for bit.
struct FilmSums {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    /// Digest of the scene, camera, seed and everything else that changes samples. Only sums with
    /// equal identities may be added.
    std::string identity;
    /// Names of the backends that made the samples, which round differently; empty where not known.
    std::set<std::string> backends;
    int light_exponent = 0;            ///< light is in units of 2^light_exponent
    double depth_unit = 1.0;           ///< kernel units per scene unit
    std::vector<SampleRange> ranges;   ///< disjoint, ascending, not adjacent
    std::vector<std::uint32_t> words;  ///< FILM_PIXEL_WORDS for each pixel

    /// How many samples a pixel has.
    [[nodiscard]] std::uint64_t samples() const;
};

/// Adds `part` to `whole`. Throws Error (exit code 2) where they are not of one image or share
/// samples.
void add_sums(FilmSums& whole, const FilmSums& part);

/// The ranges together, ascending and joined where they touch. Throws Error (exit code 2) where
/// they share samples.
[[nodiscard]] std::vector<SampleRange> joined(std::vector<SampleRange> ranges);

/// Means as layers: beauty and its alpha, direct, indirect, emission, albedo, normal, depth, and
/// "variance", the estimated variance of each pixel's beauty (0 for a single sample).
[[nodiscard]] Image resolve_sums(const FilmSums& sums);

/// How the noise of the pixels of a sample hangs together.
enum class PixelNoise : std::uint8_t {
    independent,
    shared  ///< in an unknown way: pixels are taken to err all alike, which is the worst case
};

/// Estimated standard error of the image's mean luminance, relative to it; infinite where that
/// cannot be told yet: of fewer than 16 samples, or of fewer than 1024 that all agree. `keep_going`
/// is called now and then, if given; where it returns false, the result is infinite as well.
[[nodiscard]] double relative_error(const FilmSums& sums, PixelNoise noise,
                                    const std::function<bool()>& keep_going = {});

}  // namespace weft

#endif
