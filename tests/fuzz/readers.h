// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_FUZZ_READERS_H
#define WEFT_TESTS_FUZZ_READERS_H

#include <cstddef>
#include <span>

#include "scene/scene.h"
#include "tests/testing/temporary_folder.h"

namespace weft::fuzz {

using Bytes = std::span<const std::byte>;

// Each of these gives any bytes to one reader, as a file or whatever it reads. It returns when the
// reader took them and what it made of them is sound, or when it refused them as it should: with
// an Error of the right exit code and one line of text. Everything else is thrown, std::logic_error
// for what is unsound.

void read_gltf_bytes(Bytes bytes);  ///< binary glTF where the bytes begin with `glTF`
void read_mitsuba_bytes(Bytes bytes);
void read_ply_bytes(Bytes bytes);
void read_vol_bytes(Bytes bytes);
void read_nanovdb_bytes(Bytes bytes);
void read_obj_bytes(Bytes bytes);  ///< what follows a line `#mtl` is material.mtl
void read_image_bytes(Bytes bytes);
void read_exr_bytes(Bytes bytes);
void read_hdr_bytes(Bytes bytes);
void read_png_bytes(Bytes bytes);      ///< as an image to compare; `image` reads textures
void read_options_bytes(Bytes bytes);  ///< one argument a line
void read_preset_bytes(Bytes bytes);
void read_view_bytes(Bytes bytes);   ///< as a message of the page of `weft view`
void read_peers_bytes(Bytes bytes);  ///< for images of the size of pair.hdr

/// That of pair.hdr, which images by others are to have.
inline constexpr FilmSize pair_size{2, 1};

/// A reader and the folder of its inputs, tests/fuzz/corpus/`name`.
struct Reader {
    const char* name;
    void (*read)(Bytes);
};

/// Writes what inputs may refer to: triangle.ply, square.obj, material.mtl, pixel.tga, data.bin,
/// part.xml, smoke.vol, and pair.hdr of pair_size.
void write_companions(const TemporaryFolder& folder);

/// Every reader of this build.
[[nodiscard]] std::span<const Reader> readers();

}  // namespace weft::fuzz

#endif
