// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_OTHER_RENDERERS_H
#define WEFT_TRADEOFF_OTHER_RENDERERS_H

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// The contents of a file that lists images by other renderers.
struct OtherRenderers {
    std::vector<OtherRendererPoint> images;  ///< without errors, since there is no reference yet
    std::vector<std::string> notes;
};

/// Reads the file and all images that it names, which must lie in its folder or below. Throws Error
/// (exit code 2) with file and place for anything unknown, damaged or out of range, for images of
/// another size or with values that are not finite, and for too many pixels together: every image
/// that is accepted can be compared with any reference of that size that is not black all over.
[[nodiscard]] OtherRenderers read_other_renderers(const std::filesystem::path& file,
                                                  const FilmSize& size);

}  // namespace weft

#endif
