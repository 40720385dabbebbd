// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_media.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/limits.h"
#include "base/quote.h"
#include "scene/convex_media.h"
#include "scene/field_of_view.h"
#include "scene/flat_scene.h"

namespace weft {
namespace {

/// Largest extinction: with more, everything is opaque within the rounding of a position.
constexpr double largest_extinction = 1e30;
/// Largest emission: with more, differences in brightness are meaningless.
constexpr double largest_emission = 1e30;

glm::dvec3 vector_of(const shared::float4& p) {
    return {p.x, p.y, p.z};
}

std::uint32_t medium_or_none(int medium) {
    return medium >= 0 ? static_cast<std::uint32_t>(medium) : NO_MEDIUM;
}

/// The density to which a medium's extinction in kernels refers: the greatest of its grid.
float unit_density(const Scene& scene, const Medium& medium) {
    return medium.grid < 0 ? 1.0F
                           : greatest_density(scene.grids[static_cast<std::size_t>(medium.grid)]);
}

/// Whether the medium has no effect.
bool is_clear(const Scene& scene, const Medium& medium) {
    const glm::vec3 effect = medium.sigma_t * medium.scale + medium.emission;
    return !(std::max({effect.r, effect.g, effect.b}) > 0.0F) ||
           !(unit_density(scene, medium) > 0.0F);
}

/// Whether the medium's extinction has a colour that varies.
bool has_coloured_grid(const Scene& scene, const Medium& medium) {
    return medium.grid >= 0 && scene.grids[static_cast<std::size_t>(medium.grid)].channels == 3 &&
           unit_density(scene, medium) > 0.0F;
}

shared::MediumRecord record_of(const Scene& scene, const Medium& medium, const KernelUnits& units) {
    shared::MediumRecord record{};
    glm::vec3 sigma(0.0F);
    glm::vec3 emission(0.0F);
    const auto density = static_cast<double>(unit_density(scene, medium));
    const auto per_unit = [&](double value) { return value * density / units.scale; };
    for (int c = 0; c < 3; ++c) {
        const double extinction =
            static_cast<double>(medium.sigma_t[c]) * static_cast<double>(medium.scale);
        const auto emitted = static_cast<double>(medium.emission[c]);
        const double value = per_unit(extinction);
        sigma[c] = static_cast<float>(std::min(value, largest_extinction));
        // An opaque medium has the radiance emission / extinction, which limiting both must keep.
        emission[c] = static_cast<float>(std::min(value > largest_extinction
                                                      ? emitted / extinction * largest_extinction
                                                      : per_unit(emitted),
                                                  largest_emission));
    }
    record.sigma_t = {sigma.r, sigma.g, sigma.b, 0.0F};
    record.emission = {emission.r, emission.g, emission.b, 0.0F};
    record.albedo = {medium.albedo.r, medium.albedo.g, medium.albedo.b, 0.0F};
    record.anisotropy = medium.anisotropy;
    record.grid = INVALID_INDEX;
    record.albedo_grid = INVALID_INDEX;
    if (medium.albedo_grid >= 0) {
        const glm::vec3 mean(
            mean_density(scene.grids[static_cast<std::size_t>(medium.albedo_grid)]));
        record.albedo = {mean.r, mean.g, mean.b, 0.0F};
    }
    if (has_coloured_grid(scene, medium)) {
        const DensityGrid& grid = scene.grids[static_cast<std::size_t>(medium.grid)];
        const double whole = mean_density(greatest_channels(grid)).r;
        const glm::vec3 mean(mean_density(grid) / whole * static_cast<double>(sigma.r));
        record.sigma_t = {mean.r, mean.g, mean.b, sigma.r};
    }
    return record;
}

/// Radiance that a medium emits along a line of this length, in its brightest channel.
double emitted_along(const shared::MediumRecord& record, double length) {
    const auto of = [&](float emission, float sigma) {
        const auto e = static_cast<double>(emission);
        const auto s = static_cast<double>(sigma);
        if (!(e > 0.0)) return 0.0;
        return s > 0.0 ? e * -std::expm1(-s * length) / s : e * length;
    };
    return std::max({of(record.emission.x, record.sigma_t.x),
                     of(record.emission.y, record.sigma_t.y),
                     of(record.emission.z, record.sigma_t.z)});
}

/// Typical radiance of an image of a medium of this size.
double radiance_of(const shared::MediumRecord& record, double size) {
    // The medium behind surfaces may be brighter by the inverse of this than what is seen before.
    constexpr double beyond = 0x1p-20;
    constexpr double scene_size = 4.0;
    return std::max(emitted_along(record, std::min(size, scene_size)),
                    emitted_along(record, size) * beyond);
}

/// An upper bound of how long a line in a medium with an end can be, kernel units.
double size_of(const Medium& medium, double extent, const KernelUnits& units) {
    if (medium.grid < 0) return 4.0 * extent;
    double sum = 0.0;
    for (int axis = 0; axis < 3; ++axis) sum += glm::length(glm::dvec3(medium.grid_to_world[axis]));
    return sum * units.scale;
}

/// Refuses infinite media whose emission would add up without limit.
void check_endless(const Scene& scene, const Medium& medium, const shared::MediumRecord& record) {
    const auto dims = [](float emission, float sigma) {
        return !(emission > 0.0F) || sigma > 0.0F;
    };
    if (!(dims(record.emission.x, record.sigma_t.x) && dims(record.emission.y, record.sigma_t.y) &&
          dims(record.emission.z, record.sigma_t.z)))
        throw input_error(scene.source,
                          "medium " + quote(medium.name) +
                              " fills space without end and emits in a channel in which it has "
                              "no extinction, expected a boundary, a grid or absorption");
}

/// A boundary in kernel units, normals outwards.
struct Enclosure {
    std::vector<shared::float4> positions;
    std::vector<shared::Triangle> triangles;
    std::uint32_t inside = NO_MEDIUM;
    std::uint32_t outside = NO_MEDIUM;
    double volume = 0.0;  ///< not negative
    int surface = -1;     ///< see MediumBoundary
    bool inwards = false;
};

double signed_volume(const Enclosure& enclosure) {
    if (enclosure.positions.empty()) return 0.0;
    // Relative to a vertex, so that a mesh far from the centre loses no precision.
    const glm::dvec3 about = vector_of(enclosure.positions.front());
    const auto vertex = [&](std::uint32_t i) { return vector_of(enclosure.positions[i]) - about; };
    double six = 0.0;
    for (const shared::Triangle& t : enclosure.triangles)
        six += glm::dot(vertex(t.v0), glm::cross(vertex(t.v1), vertex(t.v2)));
    return six / 6.0;
}

Enclosure enclosure_of(const Scene& scene, const MediumBoundary& boundary,
                       const KernelUnits& units) {
    const Mesh& mesh = scene.meshes[boundary.mesh];
    Enclosure made;
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 p(
            units.point(glm::dvec3(boundary.to_world * glm::dvec4(glm::dvec3(position), 1.0))));
        made.positions.push_back({p.x, p.y, p.z, 0.0F});
    }
    const bool mirrored = glm::determinant(glm::dmat3(boundary.to_world)) < 0.0;
    for (const auto& t : mesh.triangles)
        made.triangles.push_back({t[0], t[mirrored ? 2 : 1], t[mirrored ? 1 : 2], 0});
    made.inside = medium_or_none(boundary.interior);
    made.outside = medium_or_none(boundary.exterior);
    made.volume = signed_volume(made);
    made.surface = boundary.surface;
    made.inwards = made.volume < 0.0;
    if (made.volume < 0.0) {
        made.volume = -made.volume;
        std::swap(made.inside, made.outside);
        for (shared::Triangle& t : made.triangles) std::swap(t.v1, t.v2);
    }
    return made;
}

void append(const Enclosure& enclosure, std::uint32_t number, FlatMedia& media) {
    const auto base = static_cast<std::uint32_t>(media.positions.size());
    media.positions.insert(media.positions.end(), enclosure.positions.begin(),
                           enclosure.positions.end());
    for (const shared::Triangle& t : enclosure.triangles) {
        media.triangles.push_back({base + t.v0, base + t.v1, base + t.v2, number});
        const glm::dvec3 a = vector_of(enclosure.positions[t.v0]);
        const glm::dvec3 normal = glm::cross(vector_of(enclosure.positions[t.v1]) - a,
                                             vector_of(enclosure.positions[t.v2]) - a);
        const double length = glm::length(normal);
        const glm::vec3 unit(length > 0.0 ? normal / length : glm::dvec3(0.0));
        media.normals.push_back({unit.x, unit.y, unit.z, std::bit_cast<float>(number)});
    }
    media.space.interior[number] = enclosure.inside;
}

std::vector<Enclosure> enclosures_of(const Scene& scene, const KernelUnits& units) {
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (const MediumBoundary& boundary : scene.medium_boundaries) {
        vertices += scene.meshes[boundary.mesh].positions.size();
        triangles += scene.meshes[boundary.mesh].triangles.size();
    }
    if (vertices > limits::max_vertices || triangles > limits::max_triangles)
        throw input_error(scene.source, "the boundaries of media have too many triangles");
    if (scene.medium_boundaries.size() > MAX_MEDIUM_BOUNDARIES)
        throw input_error(scene.source,
                          fmt::format("{} boundaries of media, expected at most {}",
                                      scene.medium_boundaries.size(), MAX_MEDIUM_BOUNDARIES));
    std::vector<Enclosure> all;
    for (const MediumBoundary& boundary : scene.medium_boundaries)
        all.push_back(enclosure_of(scene, boundary, units));
    std::stable_sort(all.begin(), all.end(),
                     [](const Enclosure& a, const Enclosure& b) { return a.volume < b.volume; });
    return all;
}

/// The medium outside of all boundaries: the one that the file names for it; else that of the
/// camera, where no boundary encloses the camera; else the exterior medium of the largest boundary.
std::uint32_t outermost(const Scene& scene, const KernelUnits& units, const FlatMedia& media,
                        std::uint32_t outside_largest) {
    if (scene.outer_medium >= 0) return medium_or_none(scene.outer_medium);
    const bool enclosed =
        !scene.cameras.empty() &&
        boundaries_around(media, units.point(ray_start(scene.cameras.front()))) != 0;
    if (scene.camera_medium >= 0 && !enclosed) return medium_or_none(scene.camera_medium);
    return outside_largest;
}

/// Solid angle of a triangle seen from the origin (van Oosterom and Strackee 1983), negative from
/// its front.
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    const double above = glm::dot(a, glm::cross(b, c));
    const double below =
        la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    return 2.0 * std::atan2(above, below);
}

/// Sets the box that holds all media: all boundaries, and the grid of the medium outside of them.
/// It is infinite where that medium has no grid.
void set_box(const Scene& scene, const KernelUnits& units, FlatMedia& media) {
    glm::dvec3 low(HUGE_VAL);
    glm::dvec3 high(-HUGE_VAL);
    const auto add = [&](const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    for (const shared::float4& p : media.positions) add(vector_of(p));
    const std::uint32_t outside = media.space.outside;
    const bool fills = outside != NO_MEDIUM && !is_clear(scene, scene.media[outside]);
    const bool everywhere = fills && scene.media[outside].grid < 0;
    if (fills && !everywhere)
        for (int corner = 0; corner < 8; ++corner)
            add(units.point(glm::dvec3(scene.media[outside].grid_to_world *
                                       glm::dvec4(corner & 1, corner >> 1 & 1, corner >> 2, 1))));
    glm::dvec3 centre(0.0);
    glm::dvec3 reach(MEDIA_EVERYWHERE);
    if (!everywhere && low.x <= high.x) {
        centre = 0.5 * (low + high);
        // Grown by the rounding of boundaries and by that of the box itself.
        reach = 0.5 * (high - low) + 4.0 * static_cast<double>(media.space.rounding);
    }
    const auto vector = [](const glm::dvec3& v) {
        const glm::vec3 f(v);
        return shared::float4{f.x, f.y, f.z, 0.0F};
    };
    media.space.box_centre = vector(centre);
    media.space.box_reach = vector(glm::min(reach, glm::dvec3(MEDIA_EVERYWHERE)));
}

}  // namespace

bool FlatMedia::scatters() const {
    return std::any_of(records.begin(), records.end(), [](const shared::MediumRecord& m) {
        return m.sigma_t.x * m.albedo.x > 0.0F || m.sigma_t.y * m.albedo.y > 0.0F ||
               m.sigma_t.z * m.albedo.z > 0.0F;
    });
}

std::uint32_t FlatMedia::features() const {
    return (grids.records.empty() ? 0U : FEATURE_DENSITY_GRIDS) |
           (radiance > 0.0 ? FEATURE_EMISSIVE_MEDIA : 0U) |
           (present() && space.convex != 0 ? FEATURE_CONVEX_MEDIA : 0U);
}

FlatMedia flatten_media(const Scene& scene, const KernelUnits& units) {
    std::vector<bool> clear;
    for (const Medium& medium : scene.media) clear.push_back(is_clear(scene, medium));
    if (std::find(clear.begin(), clear.end(), false) == clear.end()) return {};
    FlatMedia media;
    std::fill(std::begin(media.space.interior), std::end(media.space.interior), NO_MEDIUM);
    std::uint32_t outside_largest = NO_MEDIUM;
    for (const Enclosure& enclosure : enclosures_of(scene, units)) {
        if (enclosure.surface >= 0)
            media.surfaces.push_back({static_cast<std::uint32_t>(enclosure.surface),
                                      media.space.boundaries, enclosure.inwards});
        append(enclosure, media.space.boundaries++, media);
        outside_largest = enclosure.outside;
    }
    // Bounds the rounding of positions and of distances along rays, as for surfaces.
    float extent = 1.0F;
    for (const shared::float4& p : media.positions)
        extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    media.space.rounding = extent * 0x1p-22F;
    media.space.outside = outermost(scene, units, media, outside_largest);
    const auto counts = [&](std::uint32_t medium) { return medium != NO_MEDIUM && !clear[medium]; };
    if (!counts(media.space.outside) &&
        std::none_of(std::begin(media.space.interior), std::end(media.space.interior), counts))
        return {};
    for (std::size_t i = 0; i < scene.media.size(); ++i) {
        const Medium& medium = scene.media[i];
        shared::MediumRecord record = record_of(scene, medium, units);
        const bool endless = i == media.space.outside && medium.grid < 0;
        if (endless) check_endless(scene, medium, record);
        media.radiance = std::max(
            media.radiance,
            radiance_of(record, endless ? std::numeric_limits<double>::infinity()
                                        : size_of(medium, static_cast<double>(extent), units)));
        if (medium.grid >= 0 && !clear[i]) record.grid = media.grids.add(scene, medium, units);
        if (medium.albedo_grid >= 0 && !clear[i])
            record.albedo_grid = media.grids.add_albedo(scene, medium, units);
        media.coloured =
            media.coloured || record.sigma_t.w > 0.0F || record.albedo_grid != INVALID_INDEX;
        media.records.push_back(record);
    }
    set_box(scene, units, media);
    find_convex_boundaries(media);
    return media;
}

void empty_surfaces(Scene& scene) {
    const auto erased = std::erase_if(scene.medium_boundaries, [](const MediumBoundary& boundary) {
        return boundary.surface >= 0;
    });
    scene.emptied_surfaces = scene.emptied_surfaces || erased > 0;
}

std::uint32_t boundaries_around(const FlatMedia& media, const glm::dvec3& point) {
    std::array<double, MAX_MEDIUM_BOUNDARIES> angles{};
    for (const shared::Triangle& t : media.triangles) {
        const auto seen = [&](std::uint32_t i) { return vector_of(media.positions[i]) - point; };
        angles.at(t.instance) += solid_angle(seen(t.v0), seen(t.v1), seen(t.v2));
    }
    std::uint32_t around = 0;
    for (std::uint32_t k = 0; k < angles.size(); ++k)
        if (angles.at(k) > 2.0 * std::numbers::pi) around |= 1U << k;
    return around;
}

}  // namespace weft
