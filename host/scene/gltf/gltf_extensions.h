// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_GLTF_GLTF_EXTENSIONS_H
#define WEFT_SCENE_GLTF_GLTF_EXTENSIONS_H

#include "base/warning_collector.h"
#include "scene/gltf/gltf_document.h"

namespace weft {

/// Refuses a file that requires an extension Weft does not understand with an Error (exit code
/// 2), and warns of those that it uses and that are ignored.
void check_gltf_extensions(const GltfDocument& document, WarningCollector& report);

}  // namespace weft

#endif
