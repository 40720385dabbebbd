// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0

// The decoders that are switched off are the ones with the worst record on hostile files.
#include "scene/texture/stb_image_configuration.h"

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wdouble-promotion"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#endif

#include <cstdlib>
#include <cstring>

namespace weft {

thread_local std::size_t stbi_max_block = 0;

}  // namespace weft

namespace {

void* allocate(std::size_t size) {
    return size > weft::stbi_max_block ? nullptr : std::malloc(size);
}

void* reallocate(void* block, std::size_t size) {
    return size > weft::stbi_max_block ? nullptr : std::realloc(block, size);
}

/// stb_image copies zero bytes to a null pointer for an empty IDAT chunk, which is undefined.
void* copy_bytes(void* to, const void* from, std::size_t size) {
    return size == 0 ? to : std::memcpy(to, from, size);
}

}  // namespace

#undef memcpy
#define memcpy copy_bytes
#define STBI_MALLOC(size) allocate(size)
#define STBI_REALLOC(block, size) reallocate(block, size)
#define STBI_FREE(block) std::free(block)
#define STB_IMAGE_IMPLEMENTATION
#include <stb/stb_image.h>
