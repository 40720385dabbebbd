// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_RENDER_EXACT_FILM_H
#define WEFT_RENDER_EXACT_FILM_H

#include <cstdint>
#include <string>

#include "film/film_sums.h"
#include "pipeline/frame_context.h"
#include "scene/flat_scene.h"

namespace weft {

/// A film of exact sums on a device, and which samples it holds: samples [first, end) are added
/// one after the other to those that it may have had before.
class ExactFilm {
  public:
    /// A black film. `samples` are those to be added.
    ExactFilm(Executor& executor, std::uint32_t width, std::uint32_t height, SampleRange samples);

    /// Begins with the words of `sums` where it has any, else with none. Throws Error (exit code 2)
    /// where they are of another size or identity, or have samples that are to be added.
    void begin(FilmSums sums, const std::string& identity);
    /// Makes the film black, without any samples.
    void clear();
    /// Chooses the unit of light, so that the brightest light of the scene fits.
    void fit(const FlatScene& scene);

    /// Marks the next `count` samples as added.
    void add(std::uint32_t count);

    /// Number of the next sample.
    [[nodiscard]] std::uint32_t next() const noexcept { return next_; }
    /// Samples still to be added.
    [[nodiscard]] std::uint32_t left() const noexcept { return range_.end - next_; }
    /// Samples of every pixel.
    [[nodiscard]] std::uint64_t samples() const { return meta_.samples(); }
    /// A power of two that brings the scene's light to about 1.
    [[nodiscard]] float scale() const noexcept;
    /// Radiance of a value of 1 in the film.
    [[nodiscard]] double unit() const noexcept;
    [[nodiscard]] BufferRef<kinds::FilmSums> buffer() const noexcept { return sums_; }
    /// The sums as they are now.
    [[nodiscard]] FilmSums read(const std::string& identity);

  private:
    [[nodiscard]] std::size_t words() const noexcept;

    Executor& executor_;
    SampleRange range_;
    std::uint32_t next_;
    FilmSums meta_;  ///< without words, which are on the device, and without identity
    DeviceBuffer<kinds::FilmSums> sums_;
};

}  // namespace weft

#endif
