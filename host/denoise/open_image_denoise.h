// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_DENOISE_OPEN_IMAGE_DENOISE_H
#define WEFT_DENOISE_OPEN_IMAGE_DENOISE_H

#include <memory>
#include <string>
#include <vector>

#include "image/image.h"

namespace weft {

/// The library Open Image Denoise, versions 1 and 2, found when the program runs: the file that the
/// environment variable WEFT_OIDN_LIBRARY names, else libOpenImageDenoise.so.2, .so.1 or .so where
/// the dynamic linker looks for libraries.
class OpenImageDenoise {
  public:
    /// Loads the library and opens the processor as its device. Throws Error (exit code 3) where
    /// there is no such library, or it fails.
    OpenImageDenoise();
    ~OpenImageDenoise();
    OpenImageDenoise(const OpenImageDenoise&) = delete;
    OpenImageDenoise& operator=(const OpenImageDenoise&) = delete;

    /// The beauty of an image, three planes, without its noise. Reads the layers albedo and normal
    /// as well. Throws std::invalid_argument where one is missing, and Error (exit code 3) where
    /// the library fails.
    [[nodiscard]] std::vector<float> denoised(const Image& image) const;

    /// "2.3.3".
    [[nodiscard]] const std::string& version() const { return version_; }

  private:
    struct Library;
    std::unique_ptr<Library> library_;
    std::string version_;
};

}  // namespace weft

#endif
