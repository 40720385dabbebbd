// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "refine/surface_runs.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace weft {
namespace {

// Least cosine between the normals of one surface in two pixels beside each other.
constexpr float least_cosine = 0.8F;
// Depths of one surface differ by no more than this share from pixel to pixel, or go on so.
constexpr float least_leap = 0.02F;

// Least ratio of the albedos of one surface in two pixels beside each other: most of the light that
// a preview has wrong is reflected by it.
constexpr float least_albedo = 0.5F;

/// What tells surfaces apart.
struct Features {
    const Layer* depth;
    const Layer* normal;
    const Layer* albedo;
    std::size_t pixels;

    [[nodiscard]] float depth_of(std::size_t i) const {
        return depth == nullptr ? 0.0F : depth->values[i];
    }

    /// Whether the normals of two pixels are alike, as far as both have one.
    [[nodiscard]] bool are_parallel(std::size_t i, std::size_t j) const {
        if (normal == nullptr) return true;
        float product = 0.0F;
        float of_i = 0.0F;
        float of_j = 0.0F;
        for (std::size_t at = 0; at < 3 * pixels; at += pixels) {
            const float a = normal->values[at + i];
            const float b = normal->values[at + j];
            product += a * b;
            of_i += a * a;
            of_j += b * b;
        }
        return product >= least_cosine * std::sqrt(of_i * of_j);
    }

    /// Whether two pixels reflect about as much, over all channels.
    [[nodiscard]] bool are_as_bright(std::size_t i, std::size_t j) const {
        if (albedo == nullptr) return true;
        float of_i = 0.0F;
        float of_j = 0.0F;
        for (std::size_t at = 0; at < 3 * pixels; at += pixels) {
            of_i += albedo->values[at + i];
            of_j += albedo->values[at + j];
        }
        return std::min(of_i, of_j) >= least_albedo * std::max(of_i, of_j);
    }
};

/// A row or column of an image.
struct Line {
    std::size_t first;  ///< pixel
    std::size_t stride;
    std::uint32_t size;

    [[nodiscard]] std::size_t pixel(std::uint32_t place) const { return first + place * stride; }
};

/// The pixels of a line, told apart.
class LineEdges {
  public:
    LineEdges(const Features& features, const Line& line)
        : depth_(line.size), is_edge_(line.size + 1, 1) {
        for (std::uint32_t x = 0; x < line.size; ++x) depth_[x] = features.depth_of(line.pixel(x));
        for (std::uint32_t x = 1; x < line.size; ++x) is_edge_[x] = are_apart(features, line, x);
    }

    /// Whether there is an edge before a place.
    [[nodiscard]] bool at(std::uint32_t x) const { return is_edge_[x] != 0; }

  private:
    /// Whether the pixel of a place shows another surface than the one before.
    [[nodiscard]] bool are_apart(const Features& features, const Line& line,
                                 std::uint32_t x) const {
        const std::size_t before = line.pixel(x - 1);
        const std::size_t here = line.pixel(x);
        return !features.are_parallel(before, here) || !features.are_as_bright(before, here) ||
               leaps(x);
    }

    /// How far the depth goes from the place before to this one.
    [[nodiscard]] float step(std::size_t x) const { return depth_[x] - depth_[x - 1]; }

    [[nodiscard]] bool leaps(std::size_t x) const {
        const float here = step(x);
        if (!(std::abs(here) > least_leap * std::max(depth_[x - 1], depth_[x]))) return false;
        // Whether neither side goes on like this.
        float other = 0.0F;
        if (x > 1) other = std::max(other, std::abs(here - step(x - 1)));
        if (x + 1 < depth_.size()) other = std::max(other, std::abs(here - step(x + 1)));
        return other > 0.5F * std::abs(here);
    }

    std::vector<float> depth_;
    std::vector<char> is_edge_;  // between a place and the one before, and at both ends
};

void cut(const Features& features, const Line& line, std::vector<Run>& runs) {
    const LineEdges edges(features, line);
    for (std::uint32_t begin = 0; begin < line.size;) {
        std::uint32_t end = begin + 1;
        while (!edges.at(end)) ++end;
        for (std::uint32_t x = begin; x < end; ++x) runs[line.pixel(x)] = {begin, end};
        begin = end;
    }
}

}  // namespace

SurfaceRuns::SurfaceRuns(std::uint32_t wide, std::uint32_t high)
    : width(wide),
      height(high),
      rows(std::size_t{wide} * high, {0, wide}),
      columns(std::size_t{wide} * high, {0, high}) {}

SurfaceRuns find_surface_runs(const Image& image) {
    SurfaceRuns runs(image.width, image.height);
    const Features features{image.find("depth"), image.find("normal"), image.find("albedo"),
                            runs.rows.size()};
    if (features.depth == nullptr && features.normal == nullptr && features.albedo == nullptr)
        return runs;
    tbb::parallel_for(std::uint32_t{0}, image.height, [&](std::uint32_t y) {
        cut(features, {std::size_t{y} * image.width, 1, image.width}, runs.rows);
    });
    tbb::parallel_for(std::uint32_t{0}, image.width, [&](std::uint32_t x) {
        cut(features, {x, image.width, image.height}, runs.columns);
    });
    return runs;
}

}  // namespace weft
