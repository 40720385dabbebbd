// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/least_squares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "bench/scaling/scaling_laws.h"

namespace weft::bench::least_squares_test {
namespace {

/// Sum of squared relative errors, which a line is to make as small as can be.
double cost(const LineFit& line, const std::vector<double>& x, const std::vector<double>& y) {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double error = line.at(x[i]) / y[i] - 1.0;
        sum += error * error;
    }
    return sum;
}

TEST(LeastSquares, FindLawsThatHold) {
    const std::vector<double> x{1.0, 2.0, 5.0, 100.0};
    std::vector<double> line, power, amdahl;
    for (const double value : x) {
        line.push_back(3.0 + 0.5 * value);
        power.push_back(7.0 * std::pow(value, -1.5));
        amdahl.push_back(40.0 * (0.1 + 0.9 / value));
    }
    const auto found_line = fit_line(x, line);
    ASSERT_TRUE(found_line);
    EXPECT_NEAR(found_line->offset, 3.0, 1e-12);
    EXPECT_NEAR(found_line->slope, 0.5, 1e-12);
    const auto found_power = fit_power(x, power);
    ASSERT_TRUE(found_power);
    EXPECT_NEAR(found_power->factor, 7.0, 1e-12);
    EXPECT_NEAR(found_power->exponent, -1.5, 1e-12);
    EXPECT_NEAR(found_power->at(4.0), 7.0 / 8.0, 1e-12);
    const auto found_amdahl = fit_amdahl(x, amdahl);
    ASSERT_TRUE(found_amdahl);
    EXPECT_NEAR(found_amdahl->single, 40.0, 1e-11);
    EXPECT_NEAR(found_amdahl->serial, 0.1, 1e-13);
    EXPECT_NEAR(found_amdahl->at(9.0), 8.0, 1e-11);
}

// Three points on no line: y = {1, 2, 2} at {0, 1, 2} with weights 1 / y^2 = {1, 1/4, 1/4}. The
// normal equations are 3/2 a + 3/4 b = 2 and 3/4 a + 5/4 b = 3/2.
TEST(LeastSquares, WeighErrorsByWhatIsMeasured) {
    const std::vector<double> x{0.0, 1.0, 2.0};
    const std::vector<double> y{1.0, 2.0, 2.0};
    const auto line = fit_line(x, y);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->offset, 22.0 / 21.0, 1e-14);
    EXPECT_NEAR(line->slope, 4.0 / 7.0, 1e-14);
    for (const double step : {-1e-3, 1e-3}) {
        EXPECT_GT(cost({line->offset + step, line->slope}, x, y), cost(*line, x, y));
        EXPECT_GT(cost({line->offset, line->slope + step}, x, y), cost(*line, x, y));
    }
}

TEST(LeastSquares, SumOverLargeAndSmallFigures) {
    // Far from 0, sums of squares about 0 would leave nothing of the slope.
    const std::vector<double> x{1e9, 1e9 + 1.0, 1e9 + 2.0};
    const std::vector<double> y{5.0, 6.0, 7.0};
    const auto line = fit_line(x, y);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->slope, 1.0, 1e-6);
    EXPECT_NEAR(relative_rms(std::vector<double>{11.0, 9.0}, std::vector<double>{10.0, 10.0}), 0.1,
                1e-15);
}

TEST(LeastSquares, RefuseWhatSaysNothing) {
    const std::vector<double> one{1.0}, twice{2.0, 2.0}, two{1.0, 2.0}, zero{0.0, 1.0};
    EXPECT_FALSE(fit_line({}, {}));
    EXPECT_FALSE(fit_line(one, one));
    EXPECT_FALSE(fit_line(twice, two));
    EXPECT_FALSE(fit_line(two, zero));
    EXPECT_FALSE(fit_power(zero, two));
    EXPECT_FALSE(fit_amdahl(zero, two));
    EXPECT_TRUE(fit_line(zero, two));
    EXPECT_THROW((void)fit_line(one, two), Error);
    EXPECT_THROW((void)relative_rms(one, two), Error);
}

TEST(LeastSquares, LawsExpectWhatTheySay) {
    const std::vector<double> x{1.0, 10.0, 64.0, 1000.0};
    std::vector<double> logarithmic, saturating;
    for (const double value : x) {
        logarithmic.push_back(2.0 + 3.0 * std::log10(value));
        saturating.push_back(10.0 + 2.0 * std::min(value, 64.0));
    }
    const auto check = [&](const Law& law, const std::vector<double>& y, double offset,
                           double slope) {
        const nlohmann::json found = law_json(law, x, y);
        ASSERT_TRUE(found.is_object());
        EXPECT_NEAR(found["parameters"]["offset"].get<double>(), offset, 1e-9);
        EXPECT_NEAR(found["parameters"]["slope"].get<double>(), slope, 1e-9);
        EXPECT_NEAR(found["relative_rms"].get<double>(), 0.0, 1e-9);
        for (std::size_t i = 0; i < x.size(); ++i)
            EXPECT_NEAR(found["expected"][i].get<double>(), y[i], 1e-9 * y[i]);
    };
    check({LawKind::logarithmic}, logarithmic, 2.0, 3.0);
    check({LawKind::line, 64.0}, saturating, 10.0, 2.0);
    // A line without the bend is off.
    EXPECT_GT(law_json({LawKind::line}, x, saturating)["relative_rms"].get<double>(), 0.1);
    // 1 and 2 about c: least for c = (1 + 1/2) / (1 + 1/4).
    const std::vector<double> one_two{1.0, 2.0};
    EXPECT_NEAR(
        law_json({LawKind::constant}, one_two, one_two)["parameters"]["constant"].get<double>(),
        1.2, 1e-15);
    EXPECT_TRUE(law_json({LawKind::line}, one_two, std::vector<double>{0.0, 1.0}).is_null());
}

}  // namespace
}  // namespace weft::bench::least_squares_test
