// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_REFERENCE_PICTURES_H
#define WEFT_BENCH_COMMON_REFERENCE_PICTURES_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "device/executor.h"
#include "image/image.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft::bench {

/// Which reference a picture is compared with.
struct ReferenceWish {
    std::string scene;  ///< its name, for the file
    std::uint32_t size = 512;
    bool through_centres = false;  ///< all samples through the pixel's centre; else a box filter
    std::uint32_t spp = 2500;

    [[nodiscard]] const char* filter() const { return through_centres ? "centre" : "box"; }
};

/// A path-traced picture and where it came from.
struct Reference {
    Image image;
    std::filesystem::path file;
    std::uint64_t samples = 0;
    bool identified = false;  ///< known to be of exactly this scene

    [[nodiscard]] nlohmann::json json() const;
};

/// References on disk, made where they are missing.
class ReferencePictures {
  public:
    /// `executor` renders; `say` is told of every picture that takes time.
    ReferencePictures(std::filesystem::path folder, Executor& executor,
                      std::function<void(const std::string&)> say);

    /// In this order: the finished SCENE-SIZExSIZE-FILTER-SPP-DIGEST.exr with the most samples, at
    /// least as many as wished, its digest that of scene, camera, size and filter; else the
    /// SCENE-FILTER-SPP.exr of the right size with the most samples, whose scene nobody checks;
    /// else a new one, which goes on from where an earlier run ended. Throws Error (exit code 2 or
    /// 5).
    [[nodiscard]] Reference find(const FlatScene& scene, const Camera& camera,
                                 const ReferenceWish& wish);

  private:
    std::filesystem::path folder_;
    Executor& executor_;
    std::function<void(const std::string&)> say_;
};

}  // namespace weft::bench

#endif
