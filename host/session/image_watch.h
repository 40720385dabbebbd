// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_IMAGE_WATCH_H
#define WEFT_SESSION_IMAGE_WATCH_H

#include "session/output_driver.h"

namespace weft {

/// Receives the image of a session with all its layers now and then while it is rendered, and at
/// last as the output gets it: another program that shows it, a test.
class ImageWatch {
  public:
    virtual ~ImageWatch() = default;

    /// Takes the image so far. Called by the thread that renders, which waits for it.
    virtual void update(const SessionImage& image) = 0;
};

}  // namespace weft

#endif
