// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/unbiased_mse.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>

namespace weft {
namespace {

/// What a value, or a pixel, adds to the sums.
struct ErrorTerms {
    double error = 0.0;  ///< (x - a)(x - b)
    double slope = 0.0;  ///< (x - m)(a - b), whose square estimates the variance of `error`
    double noise = 0.0;  ///< estimates the variance of m

    void add(const ErrorTerms& value) {
        error += value.error;
        slope += value.slope;
        noise += value.noise;
    }
};

/// The terms of a value divided by m^2 + eps = 1 / w, for the difference u = x - m. With w' and w''
/// by m, f = w u^2 has f'' = 2 w - 4 u w' + u^2 w''; `error` holds the first part of it already.
ErrorTerms divided(const ErrorTerms& value, double m, double u, double w) {
    const double v = value.noise;
    return {w * value.error - 4.0 * v * m * u * w * w + v * u * u * w * w * (1.0 - 4.0 * m * m * w),
            w * value.slope * (1.0 + m * u * w), w * v};
}

/// The end of the interval that holds 95 % of Student's distribution, by its expansion about that
/// of the normal distribution (Abramowitz and Stegun 26.7.5); 11 % too small for one degree of
/// freedom, 1 % for two and 0.1 % for three.
double student_reach(double degrees) {
    constexpr double normal = 1.959963984540054;
    constexpr double terms[] = {2.3722712, 2.8224986, 2.5558497, 1.5895341};
    double reach = normal;
    double power = 1.0;
    for (const double term : terms) {
        power /= degrees;
        reach += term * power;
    }
    return reach;
}

/// Sums over the pixels of an image.
class ErrorSums {
  public:
    void add(const ErrorTerms& pixel) {
        const double variance = pixel.slope * pixel.slope;
        error_ += pixel.error;
        noise_ += pixel.noise;
        variance_ += variance;
        squares_ += variance * variance;
    }
    [[nodiscard]] ErrorEstimate estimate(std::size_t values) const {
        const auto count = static_cast<double>(values);
        if (!(squares_ > 0.0)) return {error_ / count, error_ / count, error_ / count};
        // By Satterthwaite they are (sum s^2)^2 / sum s^4 for pixels of the variances s^2. Of
        // normal slopes, whose squares are summed here, the sum of fourth powers has the mean 3 sum
        // s^4, and the square of the sum (sum s^2)^2 + 2 sum s^4. There is at least one.
        const double degrees = 3.0 * variance_ * (variance_ / squares_) - 2.0;
        const double reach = student_reach(degrees) * std::sqrt(variance_);
        return {error_ / count, (error_ - reach) / count, (error_ + reach) / count};
    }
    [[nodiscard]] double noise(std::size_t values) const {
        return noise_ / static_cast<double>(values);
    }

  private:
    double error_ = 0.0;
    double noise_ = 0.0;
    double variance_ = 0.0;
    double squares_ = 0.0;
};

double mean_of_both(const ReferenceHalves& reference) {
    double first = 0.0;
    double second = 0.0;
    for (const float value : reference.first.values) first += value;
    for (const float value : reference.second.values) second += value;
    return (reference.first_share * first + (1.0 - reference.first_share) * second) /
           static_cast<double>(reference.first.values.size());
}

}  // namespace

UnbiasedErrors unbiased_errors(const ReferenceHalves& reference, const RgbView& test) {
    check_pair(reference.first, reference.second);
    check_pair(reference.first, test);
    const double share = reference.first_share;
    if (!(share > 0.0 && share < 1.0))
        throw std::invalid_argument("a share of samples is not between 0 and 1");
    const double mean = mean_of_both(reference);
    const double eps = 1e-2 * mean * mean;
    ErrorSums sums;
    ErrorSums relative_sums;
    bool defined = true;
    for (std::size_t i = 0; i < test.pixels(); ++i) {
        ErrorTerms pixel;
        ErrorTerms relative;
        for (std::size_t c = 0; c < 3; ++c) {
            const double x = test.plane(c)[i];
            const double a = reference.first.plane(c)[i];
            const double b = reference.second.plane(c)[i];
            const double m = share * a + (1.0 - share) * b;
            const ErrorTerms value{(x - a) * (x - b), (x - m) * (a - b),
                                   share * (1.0 - share) * (a - b) * (a - b)};
            pixel.add(value);
            const double size = m * m + eps;
            if (size > 0.0)
                relative.add(divided(value, m, x - m, 1.0 / size));
            else if (x != 0.0 || a != b)
                defined = false;
        }
        sums.add(pixel);
        relative_sums.add(relative);
    }
    const std::size_t values = test.values.size();
    UnbiasedErrors errors;
    errors.mse = sums.estimate(values);
    errors.noise_mse = sums.noise(values);
    if (defined) {
        errors.relmse = relative_sums.estimate(values);
        errors.noise_relmse = relative_sums.noise(values);
    }
    return errors;
}

ErrorEstimate mean_estimate(std::span<const ErrorEstimate> estimates) {
    ErrorEstimate mean;
    for (const ErrorEstimate& estimate : estimates) {
        const auto count = static_cast<double>(estimates.size());
        mean.value += estimate.value / count;
        mean.low += estimate.low / count;
        mean.high += estimate.high / count;
    }
    return mean;
}

}  // namespace weft
