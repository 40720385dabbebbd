// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_REFERENCE_IMAGES_H
#define WEFT_TRADEOFF_REFERENCE_IMAGES_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "device/executor.h"
#include "image/image.h"
#include "render/path_renderer.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"

namespace weft {

/// Seed of references, which images that are compared with them must not have.
inline constexpr std::uint32_t reference_seed = 77;

/// Layers of a reference with the beauty of each half of its samples, beside those of all samples.
inline constexpr const char* first_half_layer = "first_half";
inline constexpr const char* second_half_layer = "second_half";

/// Which reference an image is compared with.
struct ReferenceWish {
    std::string scene;  ///< its name, for the file
    std::uint32_t size = 512;
    bool through_centres = false;  ///< all samples at the pixel's centre; false: a box filter
    std::uint32_t spp = 2500;
    std::uint32_t height = 0;  ///< 0: a square image; otherwise `size` is the width
    /// Accepts only an image that is known to be of exactly this scene, with layers of its halves.
    bool with_halves = false;

    [[nodiscard]] const char* filter() const { return through_centres ? "centre" : "box"; }
    [[nodiscard]] std::uint32_t rows() const { return height > 0 ? height : size; }
};

/// A path-traced image and where it came from.
struct Reference {
    Image image;
    std::filesystem::path file;
    std::uint64_t samples = 0;
    bool identified = false;  ///< known to be of exactly this scene

    [[nodiscard]] nlohmann::json json() const;
};

/// Finds references on disk, and renders those that are missing.
class ReferenceImages {
  public:
    /// `executor` renders; `say` gets a message on every image that is rendered. `keep_going` is
    /// called now and then with the share of that image that is done; empty: go on always.
    ReferenceImages(std::filesystem::path folder, Executor& executor,
                    std::function<void(const std::string&)> say,
                    std::function<bool(double)> keep_going = {});

    /// Finds a reference, in this order: the finished SCENE-WIDTHxHEIGHT-FILTER-SPP-DIGEST.exr with
    /// the most samples, at least as many as wished, its digest that of scene, camera, size and
    /// filter; else the SCENE-FILTER-SPP.exr of the right size with the most samples, whose scene
    /// is not checked; else a new one, which continues the samples of an earlier run. Throws Error
    /// (exit code 2 or 5; 130 where keep_going ended it, after the samples so far were saved).
    [[nodiscard]] Reference find(const FlatScene& scene, const Camera& camera,
                                 const ReferenceWish& wish);

  private:
    /// Renders one half of the samples; `begin` is the share of all samples done before.
    [[nodiscard]] FilmSums make_part(const FlatScene& scene, const Camera& camera,
                                     const PathSettings& settings, const std::string& identity,
                                     const std::filesystem::path& checkpoint, double begin);
    [[nodiscard]] Reference make(const FlatScene& scene, const Camera& camera,
                                 const ReferenceWish& wish, PathSettings settings,
                                 const std::string& identity);

    std::filesystem::path folder_;
    Executor& executor_;
    std::function<void(const std::string&)> say_;
    std::function<bool(double)> keep_going_;
};

}  // namespace weft

#endif
