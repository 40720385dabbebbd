// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_ADAPTIVE_ADAPTIVE_REPORT_H
#define WEFT_BENCH_ADAPTIVE_ADAPTIVE_REPORT_H

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bench/adaptive/adaptive_frames.h"
#include "tradeoff/image_errors.h"

namespace weft::bench {

// Names of the methods that others are compared with, in tables and JSON.
inline constexpr const char* method_igi = "igi";
inline constexpr const char* method_amax = "amax";

/// Errors of a method's image, and of its layers, against one reference.
struct LayerErrors {
    ImageErrors beauty;
    ImageErrors indirect;
    ImageErrors direct;
};

/// Errors of one method against both references.
struct MethodErrors {
    LayerErrors box;
    LayerErrors centre;
};

/// Errors of one half of a reference's samples against the other, which its noise leaves between
/// images that show the same; none where no errors were measured.
struct ReferenceFloors {
    std::optional<ImageErrors> box;
    std::optional<ImageErrors> centre;
    /// What the noise of all samples adds to relMSE; see noise_relmse_of.
    std::optional<double> box_noise;
    std::optional<double> centre_noise;
};

/// All that is known of one scene.
struct AdaptiveScene {
    std::string name;
    bool shipped = false;  ///< with Weft: left out of means where there are others
    bool media = false;    ///< has participating media: in means of its own
    std::size_t triangles = 0;
    AdaptiveFrames frames;
    std::vector<MethodErrors> errors;  ///< by method; empty where errors were not wanted
    ReferenceFloors floors;
    nlohmann::json references;

    [[nodiscard]] const MethodErrors* errors_of(std::string_view method) const;
};

/// The lines that explain the columns.
[[nodiscard]] std::string adaptive_legend();
/// Times and errors of one scene, a line for every method.
[[nodiscard]] std::string adaptive_tables(const AdaptiveScene& scene);
[[nodiscard]] nlohmann::json adaptive_json(const AdaptiveScene& scene);

/// Shadow rays per second of a method's own gather stages over the packet rate, within each
/// repetition; the median. Null where either was not measured. `indirect` and `direct` choose the
/// stages.
[[nodiscard]] nlohmann::json ray_share(const AdaptiveScene& scene, std::string_view method,
                                       bool indirect = true, bool direct = true);

/// Means over the scenes for the method `ais`, one of those measured; null for what has no value.
[[nodiscard]] nlohmann::json adaptive_summary(const std::vector<AdaptiveScene>& scenes,
                                              const std::string& ais);

/// The figures of `summary` that were published too, beside each other: means over all published
/// scenes, and over those called as ours. `published` is null where there is none.
[[nodiscard]] std::string summary_table(const nlohmann::json& summary,
                                        const nlohmann::json& published);

}  // namespace weft::bench

#endif
