// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/dynamic_methods.h"

#include <stdexcept>

#include "app/algorithm_options.h"

namespace weft::bench {
namespace {

/// Edge pixels have one sample, as those of all other methods and of references.
DynamicMethod adaptive(const char* name, bool temporal) {
    DynamicMethod method{name, Algorithm::ais};
    method.sampling.cached = temporal;
    method.sampling.temporal = temporal;
    method.sampling.edge_samples = 0;
    method.sampling.candidates = 1;  // as the images of any sequence
    method.full = true;
    return method;
}

}  // namespace

std::optional<Algorithm> algorithm_named(std::string_view name) {
    try {
        // The table of names ends this: it throws beyond its last one.
        for (std::uint8_t number = 0; number < 255; ++number)
            if (to_string(static_cast<Algorithm>(number)) == name)
                return static_cast<Algorithm>(number);
    } catch (const std::out_of_range&) {
        return std::nullopt;
    }
    return std::nullopt;
}

std::vector<DynamicMethod> dynamic_methods(const std::function<void(const std::string&)>& say) {
    constexpr const char* ward = "irradiance-cache";
    std::vector<DynamicMethod> methods;
    methods.push_back({"igi", Algorithm::igi, {}, true});
    if (const auto algorithm = algorithm_named(ward))
        methods.push_back({ward, *algorithm});
    else
        say(std::string("the program has no algorithm ") + ward + ": left out");
    methods.push_back({"ic", Algorithm::ic});
    methods.push_back({"tic", Algorithm::tic});
    methods.push_back({"tic, no masks", Algorithm::tic});
    methods.back().sampling.cache_masks = false;
    methods.push_back(adaptive("ais", false));
    methods.push_back(adaptive("ais, tic", true));
    return methods;
}

RenderSettings dynamic_settings(const DynamicMethod& method, std::uint32_t edge,
                                std::uint32_t seed) {
    RenderSettings settings;
    settings.algorithm = method.algorithm;
    settings.sampling = method.sampling;
    settings.width = settings.height = edge;
    settings.seed = seed;
    settings.direct = method.full;
    return settings;
}

}  // namespace weft::bench
