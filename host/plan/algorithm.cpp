// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "plan/algorithm.h"

#include <algorithm>
#include <cstddef>

namespace weft {

std::string_view to_string(Algorithm algorithm) {
    return algorithm_names.at(static_cast<std::size_t>(algorithm));
}

std::string_view short_algorithm_name(std::string_view name) {
    const auto found = std::find(long_algorithm_names.begin(), long_algorithm_names.end(), name);
    if (found == long_algorithm_names.end()) return name;
    return algorithm_names.at(static_cast<std::size_t>(found - long_algorithm_names.begin()));
}

std::string short_algorithm_names(std::string_view list) {
    std::string result;
    for (std::size_t begin = 0; begin <= list.size();) {
        const std::size_t end = std::min(list.find(',', begin), list.size());
        if (begin > 0) result += ',';
        result += short_algorithm_name(list.substr(begin, end - begin));
        begin = end + 1;
    }
    return result;
}

std::string_view to_string(IndirectSource source) {
    return source_names.at(static_cast<std::size_t>(source));
}

IndirectSource source_of(const SamplingSettings& sampling) {
    if (!sampling.cached) return sampling.bounce_rays ? IndirectSource::rays : IndirectSource::vpl;
    return sampling.temporal ? IndirectSource::tic : IndirectSource::ic;
}

}  // namespace weft
