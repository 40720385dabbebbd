// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_PEER_PICTURES_H
#define WEFT_TRADEOFF_PEER_PICTURES_H

#include <filesystem>
#include <string>
#include <vector>

#include "image/image.h"
#include "tradeoff/tradeoff_result.h"

namespace weft {

/// What a file of pictures by other renderers holds.
struct PeerPictures {
    std::vector<PeerPoint> pictures;  ///< with their errors
    std::vector<std::string> notes;
};

/// Reads the file and all pictures that it names, which lie in its folder or below, and compares
/// them with the reference. Throws Error (exit code 2) with file and place for anything unknown,
/// damaged or out of range, and for pictures of another size or with values that are not finite.
[[nodiscard]] PeerPictures read_peer_pictures(const std::filesystem::path& file,
                                              const Image& reference);

}  // namespace weft

#endif
