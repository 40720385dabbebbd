// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/hdr_vdp.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/limits.h"
#include "metrics/fourier.h"
#include "metrics/hdr_vdp_cortex.h"
#include "metrics/hdr_vdp_csf.h"
#include "metrics/hdr_vdp_grid.h"
#include "metrics/hdr_vdp_masking.h"
#include "metrics/hdr_vdp_optics.h"
#include "metrics/hdr_vdp_response.h"

namespace weft {

namespace {

constexpr double smallest_difference = 1e-4;  // cd/m^2; no eye sees less

/// The test image in the real parts, the reference in the imaginary parts.
using Pair = std::vector<Complex>;

void check_range(double value, double low, double high, const char* name) {
    if (!(value >= low && value <= high))
        throw Error(ExitCode::usage,
                    fmt::format("HDR-VDP: {} is {}, expected {} to {}", name, value, low, high));
}

void check_settings(const HdrVdpSettings& settings) {
    check_range(settings.pixels_per_degree, 0.01, 1e5, "pixels per degree");
    check_range(settings.viewing_distance, 1e-3, 1e3, "viewing distance");
    check_range(settings.luminance_scale, 1e-12, 1e12, "luminance scale");
    check_range(settings.peak_contrast, 1e-6, 1.0, "peak contrast");
}

void check_sizes(std::size_t test, std::size_t reference, std::uint32_t width,
                 std::uint32_t height) {
    const std::uint64_t pixels = std::uint64_t{width} * height;
    if (width < 2 || height < 2 || pixels > limits::max_hdr_vdp_pixels)
        throw input_error("HDR-VDP",
                          fmt::format("the images are {} x {} pixels, expected at least 2 x 2 and "
                                      "at most {} pixels",
                                      width, height, limits::max_hdr_vdp_pixels));
    if (test != pixels || reference != pixels)
        throw input_error("HDR-VDP", fmt::format("the maps hold {} and {} values, expected {}",
                                                 test, reference, pixels));
}

struct PositiveRange {
    double smallest = std::numeric_limits<double>::infinity();
    double largest = 0.0;

    [[nodiscard]] bool empty() const { return largest == 0.0; }
};

PositiveRange positive_range(std::span<const float> map, double scale) {
    PositiveRange range;
    for (const float value : map) {
        if (!std::isfinite(value) || value <= 0.0f) continue;
        range.smallest = std::min(range.smallest, value * scale);
        range.largest = std::max(range.largest, value * scale);
    }
    return range;
}

/// Luminances of both images, with one lower limit so that pixels that are black in both are equal.
Pair luminances(std::span<const float> test, std::span<const float> reference, double scale) {
    const PositiveRange of_test = positive_range(test, scale);
    const PositiveRange of_reference = positive_range(reference, scale);
    const bool none = of_test.empty() && of_reference.empty();
    const double floor =
        none ? darkest_luminance : std::min(of_test.smallest, of_reference.smallest);
    const double ceiling =
        none ? brightest_luminance : std::max(of_test.largest, of_reference.largest);
    const auto luminance = [&](float value, const PositiveRange& range) {
        if (value > 0.0f) return std::isinf(value) ? ceiling : value * scale;
        return range.empty() ? darkest_luminance : floor;
    };
    Pair pair(test.size());
    for (std::size_t i = 0; i < pair.size(); ++i)
        pair[i] = {luminance(test[i], of_test), luminance(reference[i], of_reference)};
    return pair;
}

double mean_adaptation(const Pair& luminance) {
    double sum = 0.0;
    for (const Complex& pixel : luminance) sum += std::log(pixel.imag());
    return std::exp(sum / static_cast<double>(luminance.size()));
}

/// Filters a spectrum back into an image.
void filter_image(Fourier2d& fourier, const Filter& filter, const Pair& spectrum, Pair& image) {
    filter.apply(spectrum, image);
    fourier.inverse(image, filter.reach());
}

/// The perception of both luminance maps: the spectrum of the response in just noticeable
/// differences, weighted with the sensitivity at the local adaptation to the reference.
Pair perceived_spectrum(Fourier2d& fourier, const FrequencyGrid& grid, Pair image,
                        const HdrVdpSettings& settings) {
    const double pupil = pupil_diameter(mean_adaptation(image));
    const Filter optics =
        optics_filter(grid, settings.pixels_per_degree, pupil, settings.legacy_otf_grid);
    fourier.forward(image);
    filter_image(fourier, optics, image, image);

    const RetinaResponse response;
    const double noticeable = settings.peak_contrast / 0.01;
    std::vector<double> adaptation(image.size());
    for (std::size_t i = 0; i < image.size(); ++i) {
        adaptation[i] = image[i].imag();
        image[i] = {response(image[i].real()) / noticeable, response(image[i].imag()) / noticeable};
    }
    fourier.forward(image);

    Pair filtered(image.size());
    Pair perceived(image.size());
    for (std::size_t level = 0; level < adaptation_levels.size(); ++level) {
        const Filter neural = neural_filter(grid, optics, settings.pixels_per_degree,
                                            adaptation_levels[level], settings.viewing_distance);
        filter_image(fourier, neural, image, filtered);
        for (std::size_t i = 0; i < image.size(); ++i)
            perceived[i] += adaptation_weight(level, adaptation[i]) * filtered[i];
    }
    fourier.forward(perceived);
    return perceived;
}

/// Adds the detection exponents of all channels.
std::vector<double> detection_exponents(Fourier2d& fourier, const CortexTransform& cortex,
                                        const Pair& spectrum) {
    std::vector<double> exponents(spectrum.size());
    Pair channel(spectrum.size());
    Pair elevation(spectrum.size());
    for (unsigned band = 0; band < CortexTransform::band_count; ++band) {
        const Filter phase_spread = cortex.phase_spread(band);
        for (unsigned o = 0; o < CortexTransform::orientations(band); ++o) {
            filter_image(fourier, cortex.channel(band, o), spectrum, channel);
            for (std::size_t i = 0; i < channel.size(); ++i)
                elevation[i] = {threshold_elevation(channel[i].real()),
                                threshold_elevation(channel[i].imag())};
            fourier.forward(elevation, phase_spread.reach());
            filter_image(fourier, phase_spread, elevation, elevation);
            for (std::size_t i = 0; i < channel.size(); ++i)
                exponents[i] += detection_exponent(channel[i].real() - channel[i].imag(),
                                                   elevation[i].real(), elevation[i].imag());
        }
    }
    return exponents;
}

HdrVdpResult summarise(const std::vector<double>& exponents, const Pair& luminance) {
    HdrVdpResult result;
    result.probability.resize(exponents.size());
    std::size_t above_75 = 0;
    std::size_t above_95 = 0;
    double sum = 0.0;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
        const bool equal =
            std::abs(luminance[i].real() - luminance[i].imag()) < smallest_difference;
        const double probability = equal ? 0.0 : -std::expm1(-exponents[i]);
        result.probability[i] = static_cast<float>(probability);
        above_75 += probability >= 0.75;
        above_95 += probability >= 0.95;
        sum += probability;
    }
    const auto pixels = static_cast<double>(exponents.size());
    result.p75 = 100.0 * static_cast<double>(above_75) / pixels;
    result.p95 = 100.0 * static_cast<double>(above_95) / pixels;
    result.mean = sum / pixels;
    return result;
}

}  // namespace

HdrVdpResult hdr_vdp(std::span<const float> test, std::span<const float> reference,
                     std::uint32_t width, std::uint32_t height, const HdrVdpSettings& settings) {
    check_settings(settings);
    check_sizes(test.size(), reference.size(), width, height);
    const Pair luminance = luminances(test, reference, settings.luminance_scale);
    const FrequencyGrid grid{width, height};
    Fourier2d fourier(width, height);
    const Pair spectrum = perceived_spectrum(fourier, grid, luminance, settings);
    const CortexTransform cortex(grid, settings.legacy_fan);
    return summarise(detection_exponents(fourier, cortex, spectrum), luminance);
}

}  // namespace weft
