// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PEER_PICTURES_H
#define WEFT_TRADEOFF_PEER_PICTURES_H

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// What a file of pictures by other renderers holds.
struct PeerPictures {
    std::vector<PeerPoint> pictures;  ///< without errors, for want of a reference
    std::vector<std::string> notes;
};

/// Reads the file and all pictures that it names, which lie in its folder or below. Throws Error
/// (exit code 2) with file and place for anything unknown, damaged or out of range, for pictures of
/// another size or with values that are not finite, and for too many pixels together: whatever is
/// accepted can be compared with any reference of that size that is not black all over.
[[nodiscard]] PeerPictures read_peer_pictures(const std::filesystem::path& file,
                                              const FilmSize& size);

}  // namespace weft

#endif
