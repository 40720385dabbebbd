// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "app/commands.h"
#include "base/file.h"
#include "film/film_sums_file.h"
#include "image/exr.h"

namespace weft {
namespace {

// Metadata of the parts that the merged image keeps.
constexpr const char* kept_metadata[] = {"software", "scene", "algorithm", "seed"};

}  // namespace

void merge_command(const MergeOptions& options) {
    FilmSums whole;
    std::map<std::string, std::string> metadata;
    for (const std::filesystem::path& part : options.parts) {
        const Image image = read_exr(part);
        FilmSums sums = sums_of(image, part.string());
        if (whole.words.empty()) {
            whole = std::move(sums);
            metadata = image.metadata;
            continue;
        }
        try {
            add_sums(whole, sums);
        } catch (const Error& error) {
            throw Error(error.code(), part.string(),
                        std::string("cannot be merged: ") + error.what());
        }
    }
    Image image = resolve_sums(whole);
    for (const char* const key : kept_metadata)
        if (const auto found = metadata.find(key); found != metadata.end())
            image.metadata.insert(*found);
    image.metadata["samples"] = std::to_string(whole.samples());
    attach_sums(whole, image);
    write_exr(options.output, image);
}

}  // namespace weft
