// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_TABLES_SHIPPED_SCENES_H
#define WEFT_BENCH_TABLES_SHIPPED_SCENES_H

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/common/bench_scenes.h"

namespace weft::bench {

/// A scene that stands for one of the published set.
struct NamedScene {
    std::string_view published;  ///< its name in the published tables; empty where it is in none
    /// Of a scene that comes with Weft its file, such as "desk.gltf"; else NAME of NAME/NAME.xml.
    std::string_view name;
};

/// Weft's own scenes in the spirit of the published set, in its order; those with media are last.
[[nodiscard]] std::span<const NamedScene> shipped_scenes();
/// Scenes that do not come with Weft; those with media are last.
[[nodiscard]] std::span<const NamedScene> real_scenes();

/// The former whose files `folder` holds, with these as names.
[[nodiscard]] std::vector<BenchScene> load_shipped_scenes(const std::filesystem::path& folder);
/// The latter whose files `folder` holds, each DIR/NAME/NAME.xml; DIR/NAME/NAME-fog.xml likewise.
[[nodiscard]] std::vector<BenchScene> load_real_scenes(const std::filesystem::path& folder);

/// What a scene of either list is called in the published tables; empty where it is in none.
[[nodiscard]] std::string published_scene(std::string_view name);

}  // namespace weft::bench

#endif
