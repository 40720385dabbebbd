// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "metrics/flip.h"
#include "selftest/case_groups.h"
#include "selftest/hdr_vdp_stimuli.h"

// Metrics against results of the original programs, and against their definition.
namespace weft::selftest {
namespace {

double flip_of(const std::array<float, 3>& a, const std::array<float, 3>& b) {
    constexpr std::uint32_t edge = 12;
    const auto plain = [](const std::array<float, 3>& colour) {
        std::vector<float> values;
        for (const float value : colour)
            values.insert(values.end(), std::size_t{edge} * edge, value);
        return values;
    };
    const std::vector<float> first = plain(a);
    const std::vector<float> second = plain(b);
    return ldr_flip({first, edge, edge}, {second, edge, edge}).mean;
}

std::vector<Measured> measure_metrics() {
    constexpr GaborPatch dim{1, 4, .05, 0.997109, 0.008050, 0.3616, 0.1022};
    constexpr GaborPatch bright{100, 4, .01, 0.347521, 0.001079, 0, 0};
    const HdrVdpResult first = compare(dim, dim.background());
    const HdrVdpResult second = compare(bright, bright.background());
    const auto centre = [](const HdrVdpResult& result) {
        return static_cast<double>(result.probability[stimulus_centre]);
    };
    return {centre(first),
            first.mean,
            centre(second),
            second.mean,
            flip_of({0.0F, 1.0F, 0.0F}, {0.0F, 0.0F, 1.0F}),
            flip_of({0.2F, 0.2F, 0.2F}, {0.6F, 0.1F, 0.05F})};
}

}  // namespace

std::vector<SelftestCase> metric_cases() {
    const std::string knots =
        "the response has 92 knots, and more in the original program, which gave the value";
    const std::string mean = "the mean of a map with little in it; " + knots;
    const std::string decimals = "matrices of ten digits, and floats between stages";
    return {host_case(32, "HDR-VDP and FLIP",
                      {{"P of 4 cpd at 1 cd/m2, contrast .05", 0.997109, within(0.002), knots},
                       {"mean P of the image at 1 cd/m2", 0.008050, share(0.005), mean},
                       {"P of 4 cpd at 100 cd/m2, contrast .01", 0.347521, within(0.002), knots},
                       {"mean P of the image at 100 cd/m2", 0.001079, share(0.005), mean},
                       {"FLIP of green and blue, the largest", 1.0, within(1e-4), decimals},
                       {"FLIP of grey and red", 0.6247364, within(1e-4), decimals}},
                      measure_metrics)};
}

}  // namespace weft::selftest
