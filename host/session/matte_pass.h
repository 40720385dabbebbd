// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SESSION_MATTE_PASS_H
#define WEFT_SESSION_MATTE_PASS_H

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "device/executor.h"
#include "image/image.h"
#include "pipeline/frame_context.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft {

/// What identifiers an image gets.
struct MatteSettings {
    bool objects = false;    ///< layers CryptoObject00 and so on
    bool materials = false;  ///< layers CryptoMaterial00 and so on

    [[nodiscard]] bool any() const { return objects || materials; }
};

/// What pixels are sampled with to find what they show.
struct MatteView {
    const Camera& camera;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t samples = 1;  ///< of every pixel; 1: through its centre
    std::uint32_t seed = 0;
};

/// Adds identifiers of the objects and materials that each pixel shows to an image, in the
/// Cryptomatte convention. They have primary rays of their own, so that the image costs nothing
/// more where none are wanted. Returns false, and adds nothing, where that was cancelled.
bool add_mattes(Executor& executor, const Scene& scene, const FlatScene& flat,
                const SceneBuffers& buffers, const MatteView& view, const MatteSettings& settings,
                Image& image);

/// The instance that the pixel in column `x` and row `y` shows at its centre; empty where it shows
/// none, lies outside, or that was cancelled.
[[nodiscard]] std::optional<std::uint32_t> instance_at(Executor& executor, const FlatScene& flat,
                                                       const SceneBuffers& buffers,
                                                       const MatteView& view, std::uint32_t x,
                                                       std::uint32_t y);

/// The name of the object that each instance of a scene belongs to: its own. The parts of one mesh
/// are one object; other instances of a name that was there before get a number.
[[nodiscard]] std::vector<std::string> object_names(const Scene& scene);

/// The name of each instance's material; materials of a name that was there before get a number.
[[nodiscard]] std::vector<std::string> material_names(const Scene& scene);

}  // namespace weft

#endif
