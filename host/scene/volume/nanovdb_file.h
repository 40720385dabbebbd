// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_VOLUME_NANOVDB_FILE_H
#define WEFT_SCENE_VOLUME_NANOVDB_FILE_H

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace weft {

/// A grid as NanoVDB holds it in memory, where all of its parts are aligned to 32 bytes.
class NanovdbBuffer {
  public:
    explicit NanovdbBuffer(std::size_t size) : blocks_((size + 31) / 32), size_(size) {}

    [[nodiscard]] std::span<std::byte> bytes() {
        return std::as_writable_bytes(std::span(blocks_)).first(size_);
    }
    [[nodiscard]] std::span<const std::byte> bytes() const {
        return std::as_bytes(std::span(blocks_)).first(size_);
    }

  private:
    struct alignas(32) Block {
        std::byte bytes[32];
    };
    std::vector<Block> blocks_;
    std::size_t size_;
};

/// Whether the bytes of a file begin as those of a NanoVDB file do.
[[nodiscard]] bool is_nanovdb(std::span<const std::byte> bytes);

/// Unpacks one grid of a NanoVDB file (`.nvdb`, major version 32, uncompressed, ZIP or BLOSC): the
/// one called `name`, or, where that is empty, the one called density, else the first. The contents
/// of the grid are not checked. `file` names the file in errors (exit code 2).
[[nodiscard]] NanovdbBuffer unpack_nanovdb(std::span<const std::byte> bytes,
                                           const std::string& name, const std::string& file);

}  // namespace weft

#endif
