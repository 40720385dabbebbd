// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Directions of a sampler against a pdf by chi-square, on the whole sphere, for pdfs with narrow
// peaks.
#ifndef WEFT_TESTS_TESTING_SPHERE_CHI_SQUARE_H
#define WEFT_TESTS_TESTING_SPHERE_CHI_SQUARE_H

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <optional>
#include <vector>

#include "selftest/chi_square.h"

namespace weft::test {

struct SphereDirection {
    double x, y, z;
};

/// A direction about which a pdf rises to a peak of that angle, in radians.
struct PdfPeak {
    SphereDirection at;
    double width;
};

using SpherePdf = std::function<double(const SphereDirection&)>;
/// The direction of one sample, or none where the sampler rejects it.
using SphereSampler = std::function<std::optional<SphereDirection>()>;

/// Integrals of a pdf over cells of the sphere. Cells are divided until their parts are small
/// beside their distance from every peak, and four parts give the same as one.
class CellIntegral {
  public:
    CellIntegral(const SpherePdf& pdf, const std::vector<PdfPeak>& peaks)
        : pdf_(pdf), peaks_(peaks) {}

    [[nodiscard]] double over(double theta0, double theta1, double phi0, double phi1) const {
        return refined({theta0, theta1, phi0, phi1}, 0);
    }

  private:
    struct Cell {
        double theta0, theta1, phi0, phi1;
        [[nodiscard]] double height() const { return theta1 - theta0; }
        [[nodiscard]] double width() const {
            return (phi1 - phi0) * std::max(std::sin(theta0), std::sin(theta1));
        }
    };

    static SphereDirection direction(double theta, double phi) {
        return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
    }

    /// The rule of Gauss and Legendre with 4 x 4 points.
    [[nodiscard]] double estimate(const Cell& cell) const {
        constexpr std::array nodes = {-0.861136311594053, -0.339981043584856, 0.339981043584856,
                                      0.861136311594053};
        constexpr std::array weights = {0.347854845137454, 0.652145154862546, 0.652145154862546,
                                        0.347854845137454};
        double sum = 0.0;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
                const double theta =
                    0.5 * (cell.theta0 + cell.theta1 + nodes[i] * (cell.theta1 - cell.theta0));
                const double phi =
                    0.5 * (cell.phi0 + cell.phi1 + nodes[j] * (cell.phi1 - cell.phi0));
                sum += weights[i] * weights[j] * std::sin(theta) * pdf_(direction(theta, phi));
            }
        return 0.25 * sum * (cell.theta1 - cell.theta0) * (cell.phi1 - cell.phi0);
    }

    [[nodiscard]] bool is_near_peak(const Cell& cell) const {
        const SphereDirection middle =
            direction(0.5 * (cell.theta0 + cell.theta1), 0.5 * (cell.phi0 + cell.phi1));
        const double size = std::max(cell.height(), cell.width());
        return std::any_of(peaks_.begin(), peaks_.end(), [&](const PdfPeak& peak) {
            const double distance =
                std::hypot(middle.x - peak.at.x, middle.y - peak.at.y, middle.z - peak.at.z);
            return size > 0.5 * std::max(peak.width, distance - size);
        });
    }

    [[nodiscard]] static std::array<Cell, 2> halves(const Cell& cell, bool by_theta) {
        std::array<Cell, 2> parts = {cell, cell};
        if (by_theta)
            parts[0].theta1 = parts[1].theta0 = 0.5 * (cell.theta0 + cell.theta1);
        else
            parts[0].phi1 = parts[1].phi0 = 0.5 * (cell.phi0 + cell.phi1);
        return parts;
    }

    [[nodiscard]] double refined(const Cell& cell, int depth) const {
        bool by_theta = cell.height() > cell.width();
        if (!is_near_peak(cell)) {
            // A pdf may jump along either axis.
            const double whole = estimate(cell);
            double sums[2];
            for (const int axis : {0, 1}) {
                const std::array<Cell, 2> parts = halves(cell, axis == 0);
                sums[axis] = estimate(parts[0]) + estimate(parts[1]);
            }
            const double by_rows = std::abs(sums[0] - whole);
            const double by_columns = std::abs(sums[1] - whole);
            if (depth > 30 || std::max(by_rows, by_columns) <= 1e-7 + 1e-4 * whole)
                return by_rows > by_columns ? sums[0] : sums[1];
            by_theta = by_rows > by_columns;
        }
        const std::array<Cell, 2> parts = halves(cell, by_theta);
        return refined(parts[0], depth + 1) + refined(parts[1], depth + 1);
    }

    const SpherePdf& pdf_;
    const std::vector<PdfPeak>& peaks_;
};

struct SphereComparison {
    double normal;    ///< chi-square of all cells and of the rejected, as a normal variable
    double accepted;  ///< integral of the pdf
    double missing;   ///< found share of rejected samples
};

/// Compares `count` samples in rows of equal height with twice as many cells each. Those with fewer
/// than 5 expected samples are counted together.
inline SphereComparison compare_on_sphere(const SpherePdf& pdf, const std::vector<PdfPeak>& peaks,
                                          const SphereSampler& sample, std::size_t count,
                                          std::size_t rows = 70) {
    const std::size_t columns = 2 * rows;
    struct Bin {
        double expected = 0.0;
        double found = 0.0;
    };
    std::vector<Bin> bins(rows * columns + 1);
    const CellIntegral integral(pdf, peaks);
    SphereComparison result = {0.0, 0.0, 0.0};
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < columns; ++column) {
            const auto theta = [&](std::size_t i) {
                return std::acos(1.0 - 2.0 * static_cast<double>(i) / static_cast<double>(rows));
            };
            const auto phi = [&](std::size_t i) {
                return (2.0 * static_cast<double>(i) / static_cast<double>(columns) - 1.0) *
                       std::numbers::pi;
            };
            const double share =
                integral.over(theta(row), theta(row + 1), phi(column), phi(column + 1));
            result.accepted += share;
            bins[row * columns + column].expected = share * static_cast<double>(count);
        }
    bins.back().expected = std::max(0.0, 1.0 - result.accepted) * static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::optional<SphereDirection> in = sample();
        if (!in) {
            bins.back().found += 1.0;
            continue;
        }
        const auto row = static_cast<std::size_t>(
            std::max(0.0, (1.0 - in->z) / 2.0 * static_cast<double>(rows)));
        const auto column =
            static_cast<std::size_t>(selftest::turn(in->x, in->y) * static_cast<double>(columns));
        bins[std::min(row, rows - 1) * columns + std::min(column, columns - 1)].found += 1.0;
    }
    result.missing = bins.back().found / static_cast<double>(count);
    std::sort(bins.begin(), bins.end(),
              [](const Bin& a, const Bin& b) { return a.expected < b.expected; });
    double chi_square = 0.0;
    double freedom = -1.0;
    Bin pool;
    for (std::size_t i = 0; i < bins.size(); ++i) {
        pool.expected += bins[i].expected;
        pool.found += bins[i].found;
        if (pool.expected < 5.0 && i + 1 < bins.size()) continue;
        if (pool.expected < 1e-3 && pool.found == 0.0) continue;
        chi_square += (pool.found - pool.expected) * (pool.found - pool.expected) /
                      std::max(pool.expected, 1e-3);
        freedom += 1.0;
        pool = {};
    }
    result.normal = freedom > 0.0 ? selftest::normal_of(chi_square, freedom) : 0.0;
    return result;
}

}  // namespace weft::test

#endif
