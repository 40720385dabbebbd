// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TRADEOFF_REFERENCE_IMAGES_H
#define WEFT_TRADEOFF_REFERENCE_IMAGES_H

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "base/limits.h"
#include "device/executor.h"
#include "image/image.h"
#include "scene/flat_scene.h"
#include "scene/scene.h"
#include "tradeoff/reference_floor.h"
#include "tradeoff/reference_sums.h"

namespace weft {

/// Which reference an image is compared with.
struct ReferenceWish {
    std::string scene;  ///< its name, for the file
    std::uint32_t size = 512;
    bool through_centres = false;  ///< all samples at the pixel's centre; false: a box filter
    std::uint32_t spp = 2500;      ///< at least so many samples, half of them in each half
    std::uint32_t height = 0;      ///< 0: a square image; otherwise `size` is the width
    /// Accepts only an image that is known to be of exactly this scene, with layers of its halves.
    bool with_halves = false;
    /// What renders a new one; with `reference`, one by `path` that is there is good enough.
    Algorithm algorithm = Algorithm::reference;
    /// An image that is known to have no larger floor will do, whatever its number of samples.
    std::optional<ReferenceFloor> enough{};

    [[nodiscard]] const char* filter() const { return through_centres ? "centre" : "box"; }
    [[nodiscard]] std::uint32_t rows() const { return height > 0 ? height : size; }
};

/// How good a reference is to become, and what that may cost.
struct FloorGoal {
    ReferenceFloor floor = good_floor;
    /// Most samples of both halves together.
    std::uint32_t most_spp = limits::max_samples_per_pixel;
    /// Most seconds of rendering in this run; both halves get a sample in any case.
    double most_seconds = std::numeric_limits<double>::infinity();
};

/// An image that others are compared with, and where it came from.
struct Reference {
    Image image;
    std::filesystem::path file;
    std::uint64_t samples = 0;
    bool identified = false;                ///< known to be of exactly this scene
    std::optional<ReferenceFloor> floor{};  ///< where it was measured

    /// Name of the algorithm that made it, and the seconds that its samples took in all runs; empty
    /// and 0 where the file does not say.
    [[nodiscard]] std::string algorithm() const;
    [[nodiscard]] double seconds() const;
    [[nodiscard]] nlohmann::json json() const;
};

/// Finds references on disk, and renders those that are missing. Beside an image
/// NAME-SPP-DIGEST.exr lie NAME-DIGEST.1.sums and .2.sums, the exact sums of its halves, to which a
/// later wish for more samples adds further ones; without them, more samples begin with the first.
class ReferenceImages {
  public:
    /// `executor` renders; `say` gets a message on every image that is rendered. `keep_going` is
    /// called now and then with the share of that image that is done; empty: go on always.
    ReferenceImages(std::filesystem::path folder, Executor& executor,
                    std::function<void(const std::string&)> say,
                    std::function<bool(double)> keep_going = {});

    /// Finds a reference, in this order: the finished NAME-SPP-DIGEST.exr with the most samples, at
    /// least as many as wished, or whose floor is enough, its digest that of scene, camera, size,
    /// filter and algorithm; else the SCENE-FILTER-SPP.exr of the right size with the most samples,
    /// whose scene is not checked; else a new one. Throws Error (exit code 2 or 5; 130 where
    /// keep_going ended it, after the samples so far were saved).
    [[nodiscard]] Reference find(const FlatScene& scene, const Camera& camera,
                                 const ReferenceWish& wish);

    /// Makes a reference whose halves differ by no more than the goal: begins with wish.spp samples
    /// or those that are there, and doubles them until the goal or a limit is reached. Each step is
    /// kept. `floor` of the result says how far it got. Throws as `find`; also exit code 2 where an
    /// edge is too short for HDR-VDP.
    [[nodiscard]] Reference reach(const FlatScene& scene, const Camera& camera,
                                  const ReferenceWish& wish, const FloorGoal& goal);

  private:
    /// The finished image of that identity with the most samples that is good enough.
    [[nodiscard]] std::optional<Reference> kept(const ReferenceWish& wish,
                                                const std::string& identity) const;
    [[nodiscard]] std::filesystem::path stem_of(const ReferenceWish& wish,
                                                const std::string& identity) const;
    [[nodiscard]] Reference image_of(const ReferenceWish& wish, ReferenceSums& sums) const;
    /// Writes the image, and removes those of the same identity that have fewer samples.
    void keep(const Reference& made, const std::string& identity) const;

    std::filesystem::path folder_;
    Executor& executor_;
    std::function<void(const std::string&)> say_;
    std::function<bool(double)> keep_going_;
};

}  // namespace weft

#endif
