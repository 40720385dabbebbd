// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/compared_image.h"
#include "app/print.h"
#include "app/split_reference.h"
#include "base/error.h"
#include "image/load_image.h"
#include "image/png.h"
#include "metrics/flip.h"
#include "metrics/hdr_vdp.h"
#include "metrics/heat_map.h"
#include "metrics/numeric.h"
#include "metrics/rgb_view.h"
#include "metrics/unbiased_mse.h"
#include "tradeoff/reference_images.h"

namespace weft {
namespace {

using nlohmann::json;

/// A map of one metric, and the value of its brightest colour.
struct Map {
    std::vector<float> values;
    double high = 1.0;
};

/// Collects the results in order: rows of the table, keys of the JSON object, and the first map.
struct Report {
    std::string table;
    json keys = json::object();
    Map map;

    void add_row(std::string_view name, const std::string& value, std::string_view note) {
        table += fmt::format("{:<15}{:>12}", name, value);
        table += note.empty() ? "\n" : fmt::format("  {}\n", note);
    }
    void keep_map(std::vector<float> values, double high) {
        if (map.values.empty()) map = {std::move(values), high};
    }
};

/// null where there is no value, as JSON has no infinity either.
json json_number(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? json(*value) : json();
}

std::string number_text(const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : "undefined";
}

std::string percent(const std::optional<HdrVdpResult>& result, double HdrVdpResult::*member) {
    return result ? fmt::format("{:.4f} %", (*result).*member) : "undefined";
}

json shares_json(const std::optional<HdrVdpResult>& result) {
    return {{"p75", result ? json(result->p75) : json()},
            {"p95", result ? json(result->p95) : json()},
            {"mean", result ? json(result->mean) : json()}};
}

/// Measures a pair of images, one metric after another.
class Comparison {
  public:
    Comparison(const SplitReference& reference, const ComparedImage& test,
               const CompareOptions& options)
        : split_(reference),
          reference_(reference.whole()),
          test_(test),
          options_(options),
          display_(reference_.display_referred && test.display_referred),
          luminance_scale_(options.luminance_scale.value_or(display_ ? 80.0 : 100.0)) {}

    /// The metrics that the options choose; FLIP in the variant that suits the images.
    [[nodiscard]] std::vector<Metric> chosen() const {
        std::vector<Metric> metrics = options_.metrics;
        if (metrics.empty())
            metrics = {Metric::hdrvdp,         Metric::flip,     Metric::relmse,
                       Metric::relmse_trimmed, Metric::mape,     Metric::bias,
                       Metric::mean_ratio,     Metric::psnr,     Metric::ssim,
                       Metric::pu21_psnr,      Metric::pu21_ssim};
        if (options_.metrics.empty() && split_.is_split())
            metrics.insert(metrics.end(), {Metric::unbiased_mse, Metric::unbiased_relmse});
        std::vector<Metric> result;
        for (Metric metric : metrics) {
            if (metric == Metric::flip && !display_) metric = Metric::hdrflip;
            if (std::find(result.begin(), result.end(), metric) == result.end())
                result.push_back(metric);
        }
        return result;
    }

    void measure(Metric metric, Report& report) {
        switch (metric) {
            case Metric::hdrvdp:
                return measure_hdr_vdp(report);
            case Metric::flip:
            case Metric::hdrflip:
                return measure_flip(metric, report);
            case Metric::psnr:
            case Metric::ssim:
                return measure_display(metric, report);
            case Metric::pu21_psnr:
            case Metric::pu21_ssim:
                return measure_pu21(metric, report);
            case Metric::unbiased_mse:
            case Metric::unbiased_relmse:
                return measure_unbiased(metric, report);
            default:
                return measure_relative(metric, report);
        }
    }

  private:
    /// What the floor of a metric is: its value for the two references, or halves, against each
    /// other.
    [[nodiscard]] const char* floor_note() const {
        return split_.has_halves() ? "one half of REF against the other; the whole has less noise"
                                   : "the second reference against REF";
    }

    /// A row for the floor of a metric, beside the value of the image.
    void add_floor(std::string_view name, const std::string& floor, bool within,
                   Report& report) const {
        report.add_row(name, floor,
                       std::string(floor_note()) +
                           (within ? "; TEST differs by no more, which says nothing of it" : ""));
    }

    void measure_hdr_vdp(Report& report) {
        HdrVdpSettings settings;
        settings.luminance_scale = luminance_scale_;
        settings.pixels_per_degree = options_.ppd.value_or(settings.pixels_per_degree);
        settings.legacy_fan = options_.legacy_fan;
        settings.legacy_otf_grid = options_.legacy_otf_grid;
        const auto seen = [&](const ComparedImage& reference, const ComparedImage& test) {
            std::optional<HdrVdpResult> result;
            // A single row or column has no frequencies across it.
            if (std::min(reference.width, reference.height) >= 2)
                result = hdr_vdp(luminance(test.view()), luminance(reference.view()),
                                 reference.width, reference.height, settings);
            return result;
        };
        std::optional<HdrVdpResult> result = seen(reference_, test_);
        const std::string note = fmt::format("{:g} cd/m2 at value 1, {:g} pixels per degree{}{}",
                                             settings.luminance_scale, settings.pixels_per_degree,
                                             settings.legacy_fan ? ", legacy fan" : "",
                                             settings.legacy_otf_grid ? ", legacy OTF grid" : "");
        report.add_row("hdrvdp p75", percent(result, &HdrVdpResult::p75), note);
        report.add_row("hdrvdp p95", percent(result, &HdrVdpResult::p95), "");
        json keys = shares_json(result);
        keys.update({{"luminance_scale", settings.luminance_scale},
                     {"ppd", settings.pixels_per_degree},
                     {"legacy_fan", settings.legacy_fan},
                     {"legacy_otf_grid", settings.legacy_otf_grid}});
        if (split_.is_split()) {
            const std::optional<HdrVdpResult> floor = seen(split_.first(), split_.second());
            const auto within = [&](double HdrVdpResult::*member) {
                return result && floor && (*result).*member <= (*floor).*member;
            };
            add_floor("  floor p75", percent(floor, &HdrVdpResult::p75), within(&HdrVdpResult::p75),
                      report);
            add_floor("  floor p95", percent(floor, &HdrVdpResult::p95), within(&HdrVdpResult::p95),
                      report);
            keys["floor"] = shares_json(floor);
        }
        report.keys["hdrvdp"] = std::move(keys);
        if (result) report.keep_map(std::move(result->probability), 1.0);
    }

    void measure_flip(Metric metric, Report& report) {
        const double ppd = options_.ppd.value_or(flip_default_ppd);
        std::string note = fmt::format("{:.4g} pixels per degree", ppd);
        json keys = {{"ppd", ppd}};
        FlipExposures exposures;
        if (metric == Metric::hdrflip) {
            exposures = flip_exposures(reference_.view());
            note += fmt::format(", {} exposures from {:.4g} to {:.4g} EV", exposures.count,
                                exposures.start, exposures.stop);
            keys["start_exposure"] = exposures.start;
            keys["stop_exposure"] = exposures.stop;
            keys["exposures"] = exposures.count;
        }
        const auto flip = [&](const ComparedImage& reference, const ComparedImage& test) {
            return metric == Metric::flip ? ldr_flip(reference.view(), test.view(), ppd)
                                          : hdr_flip(reference.view(), test.view(), exposures, ppd);
        };
        FlipResult result = flip(reference_, test_);
        keys["mean"] = result.mean;
        report.add_row(to_string(metric), number_text(result.mean), note);
        if (split_.is_split()) {
            const double floor = flip(split_.first(), split_.second()).mean;
            add_floor("  floor", number_text(floor), result.mean <= floor, report);
            keys["floor"] = floor;
        }
        report.keys[std::string(to_string(metric))] = std::move(keys);
        report.keep_map(std::move(result.map), 1.0);
    }

    void add_number(Metric metric, const std::optional<double>& value, std::string_view note,
                    Report& report) const {
        report.add_row(to_string(metric), number_text(value), note);
        report.keys[std::string(to_string(metric))] = json_number(value);
    }

    void measure_relative(Metric metric, Report& report) {
        if (!relative_) relative_ = relative_errors(reference_.view(), test_.view());
        switch (metric) {
            case Metric::relmse: {
                add_number(metric, relative_->relmse, "", report);
                report.keep_map(relative_->relmse_map, relmse_end(relative_->relmse_map));
                return;
            }
            case Metric::relmse_trimmed:
                return add_number(metric, relative_->relmse_trimmed,
                                  "without the worst 0.1 % of the pixels", report);
            case Metric::mape:
                return add_number(metric, relative_->mape, "", report);
            case Metric::bias:
                return add_number(metric, relative_->bias, "mean_ratio - 1", report);
            default:
                return add_number(metric, relative_->mean_ratio, "", report);
        }
    }

    /// End of the map's scale: the 99.9th percentile, since a single bright pixel would darken all
    /// others.
    static double relmse_end(std::vector<float> values) {
        const std::size_t place = values.size() - 1 - values.size() / 1000;
        const auto end = values.begin() + static_cast<std::ptrdiff_t>(place);
        std::nth_element(values.begin(), end, values.end());
        return std::isfinite(*end) && *end > 0.0F ? double{*end} : 1.0;
    }

    void measure_display(Metric metric, Report& report) const {
        ComparedImage reference = reference_;
        ComparedImage test = test_;
        if (display_) {
            reference.rgb = srgb_encode(reference.rgb);
            test.rgb = srgb_encode(test.rgb);
        }
        const char* note = display_ ? "of sRGB values, peak 1" : "of linear values, peak 1";
        if (metric == Metric::psnr)
            add_number(metric, psnr(reference.rgb, test.rgb, 1.0), std::string("dB, ") + note,
                       report);
        else
            add_number(metric,
                       ssim(luminance(reference.view()), luminance(test.view()), test.width,
                            test.height, 1.0),
                       note, report);
    }

    void measure_pu21(Metric metric, Report& report) const {
        constexpr double peak = 256.0;  // white of a display of 100 cd/m^2
        const std::vector<float> reference =
            pu21_encode(luminance(reference_.view()), luminance_scale_);
        const std::vector<float> test = pu21_encode(luminance(test_.view()), luminance_scale_);
        const std::string note = fmt::format("{:g} cd/m2 at value 1", luminance_scale_);
        if (metric == Metric::pu21_psnr)
            add_number(metric, psnr(reference, test, peak), "dB, " + note, report);
        else
            add_number(metric, ssim(reference, test, test_.width, test_.height, peak), note,
                       report);
    }

    void measure_unbiased(Metric metric, Report& report) {
        if (!split_.is_split())
            throw input_error(reference_.place,
                              fmt::format("holds no halves, without which there is no {}, expected "
                                          "--second-reference or a file with the layers '{}' and "
                                          "'{}'",
                                          to_string(metric), first_half_layer, second_half_layer));
        if (split_.holds(test_)) {
            report.add_row(to_string(metric), number_text({}), "TEST has the pixels of REF");
            report.keys[std::string(to_string(metric))] = nullptr;
            return;
        }
        if (!unbiased_) unbiased_ = unbiased_errors(split_.halves(), test_.view());
        const bool relative = metric == Metric::unbiased_relmse;
        const std::optional<ErrorEstimate> found =
            relative ? unbiased_->relmse : std::optional(unbiased_->mse);
        const std::optional<double> noise =
            relative ? unbiased_->noise_relmse : std::optional(unbiased_->noise_mse);
        std::string note;
        if (found)
            note =
                fmt::format("{:.6g} to {:.6g} with a confidence of 95 %{}", found->low, found->high,
                            found->low <= 0.0 && found->high >= 0.0 ? "; 0 is among these" : "");
        if (relative && noise && *noise > most_noise_relmse)
            note += "; REF has too much noise for this interval";
        report.add_row(to_string(metric),
                       number_text(found ? std::optional(found->value) : std::nullopt), note);
        json& keys = report.keys[std::string(to_string(metric))];
        if (found)
            keys = {{"value", json_number(found->value)},
                    {"low", json_number(found->low)},
                    {"high", json_number(found->high)},
                    {"noise", json_number(noise)}};
    }

    const SplitReference& split_;
    const ComparedImage& reference_;
    const ComparedImage& test_;
    const CompareOptions& options_;
    bool display_;
    double luminance_scale_;
    std::optional<UnbiasedErrors> unbiased_;
    std::optional<RelativeErrors> relative_;
};

}  // namespace

void compare_command(const CompareOptions& options) {
    const SplitReference reference(options);
    const ComparedImage test =
        compared_image(load_image(options.test), options.test.string(), options.layer);
    check_same_size(test, reference.whole());
    reference.check_independent(test);
    Comparison comparison(reference, test, options);
    Report report;
    for (const Metric metric : comparison.chosen()) comparison.measure(metric, report);
    if (options.map) {
        if (report.map.values.empty())
            throw input_error(options.test.string(),
                              "is too small for a map, expected 2 pixels or more along each edge");
        write_png(*options.map,
                  heat_map(report.map.values, test.width, test.height, report.map.high), 0.0);
    }
    print_result(options.json ? json_document(report.keys) : report.table);
}

}  // namespace weft
