// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/flicker.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>

#include "metrics/numeric.h"
#include "metrics/rgb_view.h"
#include "scene/field_of_view.h"

namespace weft {
namespace {

constexpr double least_cosine = 0.9;
constexpr double most_footprints = 2.0;
constexpr double albedo_tolerance = 0.01;

/// A camera's pixels in scene units.
class PixelView {
  public:
    explicit PixelView(const SequenceImage& image)
        : image_(image.image), depth_(image_.find("depth")->values) {
        const glm::dmat3 axes(image.camera.to_world);
        const double aspect = static_cast<double>(image_.width) / image_.height;
        origin_ = glm::dvec3(image.camera.to_world[3]);
        forward_ = glm::normalize(-axes[2]);
        tangent_ = vertical_tangent(image.camera, aspect);
        right_ = glm::normalize(axes[0]) * (image.camera.mirror_x ? -1.0 : 1.0);
        up_ = glm::normalize(axes[1]);
        aspect_ = aspect;
    }

    [[nodiscard]] double depth(std::size_t pixel) const {
        return static_cast<double>(depth_[pixel]);
    }
    [[nodiscard]] double footprint(std::size_t pixel) const {
        return depth(pixel) * 2.0 * tangent_ / image_.height;
    }
    [[nodiscard]] glm::dvec3 point(std::size_t pixel) const {
        const double x = (static_cast<double>(pixel % image_.width) + 0.5) / image_.width;
        const double y = (static_cast<double>(pixel / image_.width) + 0.5) / image_.height;
        return origin_ + depth(pixel) * (forward_ + (2.0 * x - 1.0) * tangent_ * aspect_ * right_ +
                                         (1.0 - 2.0 * y) * tangent_ * up_);
    }
    /// The pixel in which a point lies.
    [[nodiscard]] std::uint32_t pixel_of(const glm::dvec3& point) const {
        const glm::dvec3 way = point - origin_;
        const double along = glm::dot(way, forward_);
        if (!(along > 0.0)) return no_pixel;
        const double x = 0.5 + 0.5 * glm::dot(way, right_) / (along * tangent_ * aspect_);
        const double y = 0.5 - 0.5 * glm::dot(way, up_) / (along * tangent_);
        if (!(x >= 0.0 && x < 1.0 && y >= 0.0 && y < 1.0)) return no_pixel;
        const auto column = static_cast<std::uint32_t>(x * image_.width);
        const auto row = static_cast<std::uint32_t>(y * image_.height);
        return std::min(row, image_.height - 1) * image_.width + std::min(column, image_.width - 1);
    }
    [[nodiscard]] glm::dvec3 value(const char* layer, std::size_t pixel) const {
        const std::vector<float>& values = image_.find(layer)->values;
        const std::size_t pixels = std::size_t{image_.width} * image_.height;
        return {values[pixel], values[pixels + pixel], values[2 * pixels + pixel]};
    }

  private:
    const Image& image_;
    const std::vector<float>& depth_;
    glm::dvec3 origin_{}, forward_{}, right_{}, up_{};
    double tangent_ = 0.0;
    double aspect_ = 1.0;
};

bool same_surface(const PixelView& before, std::size_t then, const PixelView& now,
                  std::size_t pixel) {
    const glm::dvec3 normal = now.value("normal", pixel);
    if (!(before.depth(then) > 0.0) ||
        glm::dot(normal, before.value("normal", then)) < least_cosine)
        return false;
    const double off = glm::dot(normal, before.point(then) - now.point(pixel));
    if (std::abs(off) > most_footprints * now.footprint(pixel)) return false;
    const glm::dvec3 a = before.value("albedo", then);
    const glm::dvec3 b = now.value("albedo", pixel);
    for (int c = 0; c < 3; ++c)
        if (std::abs(a[c] - b[c]) > albedo_tolerance * std::max(a[c], b[c])) return false;
    return true;
}

std::vector<float> units(const Image& image, double luminance_scale) {
    return pu21_encode(luminance(RgbView{image.find("")->values, image.width, image.height}),
                       luminance_scale);
}

}  // namespace

std::vector<std::uint32_t> matching_pixels(const SequenceImage& before, const SequenceImage& now) {
    const PixelView then(before);
    const PixelView view(now);
    std::vector<std::uint32_t> matches(std::size_t{now.image.width} * now.image.height, no_pixel);
    for (std::size_t pixel = 0; pixel < matches.size(); ++pixel) {
        if (!(view.depth(pixel) > 0.0) || view.value("emission", pixel) != glm::dvec3(0.0))
            continue;
        const std::uint32_t found = then.pixel_of(view.point(pixel));
        if (found != no_pixel && same_surface(then, found, view, pixel)) matches[pixel] = found;
    }
    return matches;
}

std::vector<float> excess_change(const Image& before, const Image& now,
                                 const Image& reference_before, const Image& reference_now,
                                 std::span<const std::uint32_t> matches, double luminance_scale) {
    for (const Image* image : {&before, &now, &reference_before, &reference_now})
        if (std::size_t{image->width} * image->height != matches.size())
            throw std::invalid_argument("flicker needs images of one size");
    const std::vector<float> a = units(before, luminance_scale);
    const std::vector<float> b = units(now, luminance_scale);
    const std::vector<float> c = units(reference_before, luminance_scale);
    const std::vector<float> d = units(reference_now, luminance_scale);
    std::vector<float> excess(matches.size(), 0.0F);
    for (std::size_t pixel = 0; pixel < matches.size(); ++pixel) {
        const std::uint32_t then = matches[pixel];
        if (then == no_pixel) continue;
        excess[pixel] = std::abs(b[pixel] - a[then]) - std::abs(d[pixel] - c[then]);
    }
    return excess;
}

}  // namespace weft
