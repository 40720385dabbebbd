// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_FILM_FILM_SUMS_FILE_H
#define WEFT_FILM_FILM_SUMS_FILE_H

#include <set>
#include <string>

#include "film/film_sums.h"

namespace weft {

/// "0:64,128:256".
[[nodiscard]] std::string ranges_text(const std::vector<SampleRange>& ranges);

/// "embree,opencl".
[[nodiscard]] std::string backends_text(const std::set<std::string>& backends);

/// Adds the sums to the image resolved from them, as layers of words and metadata, so that its file
/// can be continued or merged.
void attach_sums(const FilmSums& sums, Image& image);

/// The sums in an image read from the file `place`. Throws Error (exit code 2) where it has none
/// or they are damaged.
[[nodiscard]] FilmSums sums_of(const Image& image, const std::string& place);

}  // namespace weft

#endif
