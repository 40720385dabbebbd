// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "metrics/hdr_vdp_cortex.h"
#include "metrics/hdr_vdp_csf.h"
#include "metrics/hdr_vdp_grid.h"
#include "metrics/hdr_vdp_masking.h"
#include "metrics/hdr_vdp_optics.h"
#include "metrics/hdr_vdp_response.h"

namespace weft::hdr_vdp_parts_test {
namespace {

TEST(HdrVdpPartsResponse, AgreesWithTheOriginalTable) {
    // luminance, response, luminance step of one just noticeable difference
    constexpr double original[][3] = {{1e-3, 4.1775, .33547},   {1e-2, 16.0568, .12658},
                                      {0.1, 45.9430, .04999},   {1, 114.7461, .02413},
                                      {10, 239.6560, .01488},   {100, 422.0549, .01107},
                                      {1e3, 642.3367, .01014},  {1e4, 871.4459, .01000},
                                      {1e5, 1101.9618, .00998}, {1e6, 1332.6279, .00998}};
    const RetinaResponse response;
    for (const auto& [luminance, value, step] : original) {
        EXPECT_NEAR(response(luminance), value, 0.001) << luminance;
        const double slope = (response(luminance * 1.001) - response(luminance / 1.001)) / 0.002;
        EXPECT_NEAR(slope * step, 1.0, 0.01) << luminance;
    }
}

TEST(HdrVdpPartsResponse, RisesBetweenItsEnds) {
    const RetinaResponse response;
    EXPECT_EQ(response(-1.0), 0.0);
    EXPECT_EQ(response(darkest_luminance), 0.0);
    EXPECT_DOUBLE_EQ(response(brightest_luminance), 1638.2);
    EXPECT_DOUBLE_EQ(response(INFINITY), 1638.2);
    double last = 0.0;
    for (double luminance = darkest_luminance * 1.003; luminance < brightest_luminance;
         luminance *= 1.003) {
        const double value = response(luminance);
        ASSERT_GT(value, last) << luminance;
        ASSERT_LT(value, last + 0.35) << luminance;
        last = value;
    }
    EXPECT_NEAR(last, 1638.2, 0.4);
}

TEST(HdrVdpPartsOptics, PupilShrinksInTheLight) {
    EXPECT_DOUBLE_EQ(pupil_diameter(0.1), 4.9);
    EXPECT_NEAR(pupil_diameter(1e-6), 7.9, 0.15);
    EXPECT_NEAR(pupil_diameter(1e6), 1.9, 0.05);
}

TEST(HdrVdpPartsOptics, FilterFollowsTheTransferFunction) {
    const FrequencyGrid grid{60, 40};
    const Filter correct = optics_filter(grid, 30.0, 4.9, false);
    const Filter legacy = optics_filter(grid, 30.0, 4.9, true);
    EXPECT_DOUBLE_EQ(correct(0, 0), 1.0);
    EXPECT_DOUBLE_EQ(correct(1, 0), 1.0);
    // 10 cycles of 60 pixels at 30 pixels per degree: 5 cycles per degree; 0.5 is the lowest
    const auto transfer = [](double frequency) {
        return std::exp(-std::pow(frequency / 10.61, 0.957));
    };
    EXPECT_NEAR(correct(10, 0), transfer(5.0) / transfer(0.5), 1e-12);
    EXPECT_NEAR(legacy(10, 0), transfer(5.0 * 30 / 31) / transfer(0.5 * 30 / 31), 1e-12);
    EXPECT_NEAR(correct(0, 40 - 4), transfer(3.0) / transfer(0.5), 1e-12);
    EXPECT_NEAR(legacy(0, 40 - 4), transfer(3.0 * 20 / 21) / transfer(0.5 * 30 / 31), 1e-12);
}

TEST(HdrVdpPartsCsf, PeaksLowerInTheDark) {
    const auto peak = [](double adaptation) {
        double best = 0.0;
        for (double frequency = 0.1; frequency < 30.0; frequency += 0.01)
            if (contrast_sensitivity(frequency, 0.0, adaptation, 0.5) >
                contrast_sensitivity(best, 0.0, adaptation, 0.5))
                best = frequency;
        return best;
    };
    EXPECT_NEAR(peak(100.0), 4.5, 1.5);
    EXPECT_LT(peak(1.0), peak(100.0) - 0.5);
    EXPECT_LT(peak(0.01), peak(1.0) - 0.5);
    EXPECT_EQ(contrast_sensitivity(0.0, 0.0, 100.0, 0.5), 0.0);
    EXPECT_EQ(contrast_sensitivity(1e4, 0.0, 100.0, 0.5), 0.0);
    // Oblique waves are seen less well, in all four diagonals alike.
    EXPECT_LT(contrast_sensitivity(15.0, 0.785, 100.0, 0.5),
              0.7 * contrast_sensitivity(15.0, 0.0, 100.0, 0.5));
}

TEST(HdrVdpPartsCsf, NeuralFilterLeavesTheOpticsOut) {
    const FrequencyGrid grid{64, 64};
    const Filter optics = optics_filter(grid, 30.0, 4.0, false);
    const Filter neural = neural_filter(grid, optics, 30.0, 100.0, 0.5);
    EXPECT_EQ(neural(0, 0), 0.0);
    EXPECT_EQ(neural.largest(), 1.0);
    // 64 pixels at 30 pixels per degree: bins of 0.46875 cycles per degree.
    EXPECT_NEAR(neural(2, 0) * optics(2, 0) / (neural(0, 1) * optics(0, 1)),
                contrast_sensitivity(2 * 0.46875, 0.0, 100.0, 0.5) /
                    contrast_sensitivity(0.46875, 0.0, 100.0, 0.5),
                1e-9);
    // Where the optics pass less than the eye sees, nothing is amplified.
    EXPECT_EQ(neural(25, 0), 1.0);
}

TEST(HdrVdpPartsCsf, AdaptationIsInterpolatedInLuminance) {
    for (const double luminance : {0.0, 0.001, 0.004, 0.1, 0.55, 7.0, 100.0, 1e6}) {
        double sum = 0.0;
        for (std::size_t level = 0; level < adaptation_levels.size(); ++level)
            sum += adaptation_weight(level, luminance);
        EXPECT_DOUBLE_EQ(sum, 1.0) << luminance;
    }
    EXPECT_DOUBLE_EQ(adaptation_weight(2, 0.55), 0.5);
    EXPECT_DOUBLE_EQ(adaptation_weight(3, 0.55), 0.5);
    EXPECT_DOUBLE_EQ(adaptation_weight(4, 32.5), 0.75);
    EXPECT_EQ(adaptation_weight(0, -1.0), 1.0);
    EXPECT_EQ(adaptation_weight(5, 1e6), 1.0);
    EXPECT_EQ(adaptation_weight(3, 1.0), 1.0);
}

TEST(HdrVdpPartsCortex, ChannelsAddUpToTheWholeSpectrum) {
    for (const FrequencyGrid grid : {FrequencyGrid{96, 80}, FrequencyGrid{45, 51}}) {
        const CortexTransform cortex(grid, false);
        std::vector<double> sum(std::size_t{grid.columns()} * grid.height);
        int channels = 0;
        for (unsigned band = 0; band < CortexTransform::band_count; ++band)
            for (unsigned o = 0; o < CortexTransform::orientations(band); ++o, ++channels) {
                const Filter channel = cortex.channel(band, o);
                for (std::uint32_t row = 0; row < grid.height; ++row)
                    for (std::uint32_t column = 0; column < grid.columns(); ++column)
                        sum[std::size_t{row} * grid.columns() + column] += channel(column, row);
            }
        EXPECT_EQ(channels, 31);
        for (std::uint32_t row = 0; row < grid.height; ++row)
            for (std::uint32_t column = 0; column < grid.columns(); ++column)
                if (std::hypot(grid.x(column), grid.y(row)) < 0.66) {
                    EXPECT_NEAR(sum[std::size_t{row} * grid.columns() + column], 1.0, 1e-12)
                        << column << ", " << row;
                }
    }
}

TEST(HdrVdpPartsCortex, OrientationsAreThirtyDegreesApart) {
    const FrequencyGrid grid{120, 120};
    const CortexTransform cortex(grid, false);
    constexpr double pi = 3.14159265358979;
    for (unsigned o = 0; o < CortexTransform::orientation_count; ++o) {
        const double centre = pi / 2.0 - o * pi / 6.0;
        // 36 of 120 cycles are 0.3 cycles per pixel, where three bands meet.
        const auto column = static_cast<std::uint32_t>(std::lround(36.0 * std::cos(centre)));
        const long row = std::lround(36.0 * std::sin(centre));
        const auto index = static_cast<std::uint32_t>(row < 0 ? row + 120 : row);
        for (unsigned other = 0; other < CortexTransform::orientation_count; ++other) {
            double share = 0.0;
            for (unsigned band = 0; band < 3; ++band)
                share += cortex.channel(band, other)(column, index);
            EXPECT_NEAR(share, other == o ? 1.0 : 0.0, 0.02) << o << " " << other;
        }
    }
}

TEST(HdrVdpPartsCortex, BandsAreOctaves) {
    const FrequencyGrid grid{192, 192};
    const CortexTransform cortex(grid, false);
    // Half of the weight at 2^-k cycles per pixel goes to each of two neighbouring bands.
    for (unsigned band = 1; band < 5; ++band) {
        const std::uint32_t column = 192u >> band;
        EXPECT_NEAR(cortex.phase_spread(band)(column, 0), 0.5, 1e-12);
        EXPECT_NEAR(cortex.channel(band, 3)(column, 0), 0.5, 1e-9);
        EXPECT_NEAR(cortex.channel(band - 1, 3)(column, 0), 0.5, 1e-9);
    }
    EXPECT_NEAR(cortex.phase_spread(5)(4, 0), std::exp(-1.125), 1e-12);
    EXPECT_EQ(cortex.phase_spread(5)(8, 0), 0.0);
    EXPECT_LT(cortex.channel(4, 3).reach(), 17u);
    EXPECT_GT(cortex.channel(4, 3).reach(), 12u);
}

TEST(HdrVdpPartsCortex, LegacyFanShiftsNegativeRowsOnly) {
    const FrequencyGrid grid{64, 64};
    const Filter correct = CortexTransform(grid, false).channel(1, 4);
    const Filter legacy = CortexTransform(grid, true).channel(1, 4);
    bool differs = false;
    for (std::uint32_t row = 0; row < 64; ++row)
        for (std::uint32_t column = 1; column < 32; ++column) {
            if (row <= 32) {
                EXPECT_EQ(legacy(column, row), correct(column, row));
            }
            differs |= legacy(column, row) != correct(column, row);
        }
    EXPECT_TRUE(differs);
}

TEST(HdrVdpPartsMasking, ElevationStartsAtOneAndGrowsSixfold) {
    EXPECT_DOUBLE_EQ(threshold_elevation(0.0), 1.0);
    EXPECT_NEAR(threshold_elevation(1.0), std::pow(1297.0, 0.25), 1e-12);
    EXPECT_DOUBLE_EQ(threshold_elevation(-1.0), threshold_elevation(1.0));
    EXPECT_NEAR(threshold_elevation(100.0), 600.0, 1e-3);
}

TEST(HdrVdpPartsMasking, DetectionTakesTheSmallerElevation) {
    EXPECT_DOUBLE_EQ(detection_exponent(1.0, 1.0, 5.0), 1.0);
    EXPECT_DOUBLE_EQ(detection_exponent(-4.0, 9.0, 2.0), std::pow(2.0, 3.5));
    EXPECT_DOUBLE_EQ(detection_exponent(1.0, 0.5, 0.2), 1.0);
    EXPECT_EQ(detection_exponent(0.0, 1.0, 1.0), 0.0);
}

// The weights of opposite frequencies are one and the same, whatever was asked for.
TEST(HdrVdpPartsGrid, FiltersRealMapsIntoRealMaps) {
    for (const FrequencyGrid grid : {FrequencyGrid{6, 4}, FrequencyGrid{5, 7}}) {
        const Filter filter(grid, [](std::uint32_t column, std::uint32_t row) {
            return 1.0 + column + 10.0 * row;
        });
        const std::size_t width = grid.width;
        std::vector<std::complex<double>> weights(width * grid.height, 1.0);
        filter.apply(weights, weights);
        for (std::size_t y = 0; y < grid.height; ++y)
            for (std::size_t x = 0; x < width; ++x) {
                const std::size_t opposite = (grid.height - y) % grid.height * width;
                EXPECT_EQ(weights[y * width + x], weights[opposite + (width - x) % width]);
            }
        EXPECT_EQ(weights[width + 2].real(), 13.0);
        EXPECT_EQ(weights[width].real(), 1.0 + 10.0 * grid.height / 2.0);
    }
}

TEST(HdrVdpPartsGrid, ReachIsTheLastColumnInUse) {
    const FrequencyGrid grid{12, 5};
    const auto only = [&](std::uint32_t used) {
        return Filter(grid,
                      [=](std::uint32_t column, std::uint32_t row) {
                          return column == used && row == 3 ? 1.0 : 0.0;
                      })
            .reach();
    };
    for (std::uint32_t column = 0; column < grid.columns(); ++column)
        EXPECT_EQ(only(column), column);
    EXPECT_EQ(only(100), 0u);
    EXPECT_EQ(Filter(grid).reach(), 6u);
}

}  // namespace
}  // namespace weft::hdr_vdp_parts_test
