// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TEV_TEV_WATCH_H
#define WEFT_TEV_TEV_WATCH_H

#include <string>
#include <utility>

#include "base/diagnostics.h"
#include "session/image_watch.h"
#include "tev/tev_connection.h"

namespace weft {

/// Shows images in tev while they are rendered. Where no viewer answers, or one goes away, that is
/// a warning, and each update tries anew: the image is worth more than being watched.
class TevWatch : public ImageWatch {
  public:
    /// `image`: the name under which the viewer lists it.
    TevWatch(TevAddress address, std::string image, Diagnostics& diagnostics)
        : address_(std::move(address)), image_(std::move(image)), diagnostics_(diagnostics) {}

    /// Shows later images under another name, beside those before.
    void set_image(std::string image) {
        image_ = std::move(image);
        created_.clear();
    }
    void update(const SessionImage& image) override;

  private:
    /// Sends the image; returns what is wrong, or nothing.
    [[nodiscard]] std::string send(const Image& image);

    TevAddress address_;
    std::string image_;
    Diagnostics& diagnostics_;
    TevConnection connection_;
    std::string created_;  ///< what the viewer has been told of the image: its size and channels
};

}  // namespace weft

#endif
