// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_PACE_H
#define WEFT_VIEW_VIEW_PACE_H

#include <cstdint>

#include "scene/scene.h"

namespace weft {

/// Decides how large the images of a view are while its camera moves, so that they follow it: the
/// full size divided by a small number, by the times of those before.
class ViewPace {
  public:
    /// Milliseconds that an image may take, and its largest size. Both directions have some room
    /// between them, so that sizes do not alternate.
    static constexpr double most_ms = 90.0;
    static constexpr double aim_ms = 65.0;

    /// Takes the size of the image at rest.
    void set_full(FilmSize full);
    /// The size of the next image: never less than 128 pixels along its longer edge, unless the
    /// full one is.
    [[nodiscard]] FilmSize size() const { return divided(divisor_); }
    /// Takes what an image of that size took, from the request for it until it was ready.
    void took(double ms);
    /// Takes what an image of the full size took, by which a first size is guessed. It is ignored
    /// once an image of a divided size was timed.
    void took_full(double ms);

  private:
    /// Sets the divisor, or the largest that leaves images their least size.
    void divide_by(std::uint32_t divisor);
    [[nodiscard]] FilmSize divided(std::uint32_t divisor) const;

    FilmSize full_{1, 1};
    std::uint32_t divisor_ = 2;
    bool timed_ = false;
    std::uint32_t quick_ = 0;  ///< images in a row that a larger size would have had time for
};

}  // namespace weft

#endif
