// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_REFERENCE_PICTURES_H
#define WEFT_TRADEOFF_REFERENCE_PICTURES_H

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

/// Of the random numbers of references: another one than pictures to be compared with them have.
inline constexpr std::uint32_t reference_seed = 77;

/// Layers of a reference beside those of its samples together: the beauty of its even halves.
inline constexpr const char* first_half_layer = "first_half";
inline constexpr const char* second_half_layer = "second_half";

/// Which reference a picture is compared with.
struct ReferenceWish {
    std::string scene;  ///< its name, for the file
    std::uint32_t size = 512;
    bool through_centres = false;  ///< all samples through the pixel's centre; else a box filter
    std::uint32_t spp = 2500;
    std::uint32_t height = 0;  ///< 0: as wide as high, else `size` is the width
    /// Only a picture that is known to be of exactly this scene, and has the layers of its halves.
    bool with_halves = false;

    [[nodiscard]] const char* filter() const { return through_centres ? "centre" : "box"; }
    [[nodiscard]] std::uint32_t rows() const { return height > 0 ? height : size; }
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
    /// `executor` renders; `say` is told of every picture that takes time. `go_on` is asked now and
    /// then with the share of that picture that is done; empty: always.
    ReferencePictures(std::filesystem::path folder, Executor& executor,
                      std::function<void(const std::string&)> say,
                      std::function<bool(double)> go_on = {});

    /// In this order: the finished SCENE-WIDTHxHEIGHT-FILTER-SPP-DIGEST.exr with the most samples,
    /// at least as many as wished, its digest that of scene, camera, size and filter; else the
    /// SCENE-FILTER-SPP.exr of the right size with the most samples, whose scene nobody checks;
    /// else a new one, which goes on from where an earlier run ended. Throws Error (exit code 2 or
    /// 5; 130 where it was not to go on, after what is done has been kept).
    [[nodiscard]] Reference find(const FlatScene& scene, const Camera& camera,
                                 const ReferenceWish& wish);

  private:
    /// One half of the samples; `begin` is the share of all that is done before.
    [[nodiscard]] FilmSums make_part(const FlatScene& scene, const Camera& camera,
                                     const PathSettings& settings, const std::string& picture,
                                     const std::filesystem::path& checkpoint, double begin);
    [[nodiscard]] Reference make(const FlatScene& scene, const Camera& camera,
                                 const ReferenceWish& wish, PathSettings settings,
                                 const std::string& picture);

    std::filesystem::path folder_;
    Executor& executor_;
    std::function<void(const std::string&)> say_;
    std::function<bool(double)> go_on_;
};

}  // namespace weft

#endif
