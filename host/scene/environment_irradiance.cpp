// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/environment_irradiance.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

namespace weft {
namespace {

constexpr std::uint32_t beam_columns = 128;
constexpr std::uint32_t beam_rows = 64;
constexpr std::size_t beam_count = std::size_t{beam_columns} * beam_rows;
// Look-ups along the equator, at least: several in each texel of small images.
constexpr std::uint32_t least_columns = 512;

/// Flux of light by direction: the integral of radiance times direction over each beam, as its
/// coordinates, in one channel.
struct Beams {
    std::array<std::vector<float>, 3> along;
};

/// A row of look-ups between two angles from the axis y.
struct LookUpRow {
    double top, bottom;       ///< cosines
    double v;                 ///< of its middle, in [0, 1]
    std::uint32_t count = 0;  ///< of look-ups
};

/// Radiance at a place (u, v) of the image, as kernels/light/environment_image.h has it.
glm::dvec3 radiance_at(const FlatEnvironment& environment, double u, double v) {
    const shared::EnvironmentRecord& record = environment.records.front();
    const double x = u * static_cast<double>(record.column_scale) + 0.5;
    const double y =
        v * static_cast<double>(record.row_scale) + static_cast<double>(record.row_offset);
    const auto column = std::min(static_cast<std::uint32_t>(x), record.width - 2);
    const auto row = std::min(static_cast<std::uint32_t>(y), record.height - 2);
    const auto texel = [&](std::uint32_t down, std::uint32_t right) {
        const float* const t =
            &environment.texels[3 * (std::size_t{row + down} * record.width + column + right)];
        return glm::dvec3(t[0], t[1], t[2]);
    };
    const double s = x - column;
    const double t = y - row;
    return glm::mix(glm::mix(texel(0, 0), texel(0, 1), s), glm::mix(texel(1, 0), texel(1, 1), s),
                    t);
}

/// Fluxes of the light of a row by column of beams.
std::vector<glm::dmat3> fluxes_of(const FlatEnvironment& environment, const LookUpRow& row) {
    std::vector<glm::dmat3> fluxes(beam_columns, glm::dmat3(0.0));
    const double solid_angle = 2.0 * std::numbers::pi * (row.top - row.bottom) / row.count;
    const double height = 0.5 * (row.top + row.bottom);
    const double across = std::sqrt((1.0 - height) * (1.0 + height));
    for (std::uint32_t i = 0; i < row.count; ++i) {
        const double u = (i + 0.5) / row.count;
        const double turn = 2.0 * std::numbers::pi * (u - 0.5);
        const glm::dvec3 direction(across * std::cos(turn), height, across * std::sin(turn));
        const glm::dvec3 light = solid_angle * radiance_at(environment, u, row.v);
        // Column c of the matrix is the flux of channel c.
        fluxes[static_cast<std::size_t>(u * beam_columns)] += glm::outerProduct(direction, light);
    }
    return fluxes;
}

std::array<Beams, 3> beams_of(const FlatEnvironment& environment) {
    const shared::EnvironmentRecord& record = environment.records.front();
    const std::uint32_t columns = record.width - 2;
    const std::uint32_t times = (least_columns + columns - 1) / columns;
    const auto rows = times * std::max(1U, static_cast<std::uint32_t>(std::ceil(record.row_scale)));
    std::vector<std::vector<glm::dmat3>> of_rows(rows);
    const auto cosine_at = [&](std::uint32_t row) {
        return std::cos(std::numbers::pi * row / rows);
    };
    tbb::parallel_for(std::uint32_t{0}, rows, [&](std::uint32_t row) {
        of_rows[row] = fluxes_of(
            environment, {cosine_at(row), cosine_at(row + 1), (row + 0.5) / rows, times * columns});
    });
    std::vector<glm::dmat3> sums(beam_count, glm::dmat3(0.0));
    for (std::uint32_t row = 0; row < rows; ++row) {
        const double height = 0.5 * (cosine_at(row) + cosine_at(row + 1));
        const auto beam_row =
            std::min(beam_rows - 1, static_cast<std::uint32_t>((0.5 - 0.5 * height) * beam_rows));
        for (std::size_t column = 0; column < beam_columns; ++column)
            sums[beam_row * beam_columns + column] += of_rows[row][column];
    }
    std::array<Beams, 3> beams;
    for (glm::length_t c = 0; c < 3; ++c)
        for (glm::length_t axis = 0; axis < 3; ++axis)
            for (const glm::dmat3& flux : sums)
                beams[static_cast<std::size_t>(c)].along[static_cast<std::size_t>(axis)].push_back(
                    static_cast<float>(flux[c][axis]));
    return beams;
}

/// The unit vector at a node of the octahedron that is unfolded about the axis y.
glm::vec3 node_normal(std::uint32_t column, std::uint32_t row) {
    constexpr double edge = IRRADIANCE_NODES - 1;
    double x = 2.0 * column / edge - 1.0;
    double z = 2.0 * row / edge - 1.0;
    const double y = 1.0 - std::abs(x) - std::abs(z);
    if (y < 0.0) {
        const double folded = std::copysign(1.0 - std::abs(z), x);
        z = std::copysign(1.0 - std::abs(x), z);
        x = folded;
    }
    return glm::normalize(glm::dvec3(x, y, z));
}

float irradiance_by(const Beams& beams, const glm::vec3& normal) {
    const float* const x = beams.along[0].data();
    const float* const y = beams.along[1].data();
    const float* const z = beams.along[2].data();
    // Sums of their own for rows of the image, so that rounding stays small.
    double sum = 0.0;
    for (std::size_t row = 0; row < beam_count; row += beam_columns) {
        float part = 0.0F;
        for (std::size_t i = row; i < row + beam_columns; ++i)
            part += std::max(0.0F, normal.x * x[i] + normal.y * y[i] + normal.z * z[i]);
        sum += static_cast<double>(part);
    }
    return static_cast<float>(sum);
}

}  // namespace

std::vector<float> environment_irradiance(const FlatEnvironment& environment) {
    const std::array<Beams, 3> beams = beams_of(environment);
    std::vector<float> map(std::size_t{3} * IRRADIANCE_NODES * IRRADIANCE_NODES);
    tbb::parallel_for(std::uint32_t{0}, IRRADIANCE_NODES, [&](std::uint32_t row) {
        for (std::uint32_t column = 0; column < IRRADIANCE_NODES; ++column) {
            const glm::vec3 normal = node_normal(column, row);
            for (std::size_t c = 0; c < 3; ++c)
                map[3 * (std::size_t{row} * IRRADIANCE_NODES + column) + c] =
                    irradiance_by(beams[c], normal);
        }
    });
    return map;
}

}  // namespace weft
