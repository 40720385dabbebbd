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
#include "app/print.h"
#include "base/quote.h"
#include "image/load_image.h"
#include "image/png.h"
#include "metrics/flip.h"
#include "metrics/hdr_vdp.h"
#include "metrics/heat_map.h"
#include "metrics/numeric.h"
#include "metrics/rgb_view.h"

namespace weft {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// The layer of an image that is compared.
struct ComparedImage {
    std::vector<float> rgb;
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    bool display_referred = false;

    [[nodiscard]] RgbView view() const { return {rgb, width, height}; }
};

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

std::string layer_names(const Image& image) {
    std::string names;
    for (const Layer& layer : image.layers)
        names += (names.empty() ? "" : ", ") + (layer.name.empty() ? "beauty" : quote(layer.name));
    return names;
}

void check_finite(const ComparedImage& compared, const std::string& place) {
    const std::size_t pixels = compared.view().pixels();
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
        const bool finite = std::isfinite(compared.rgb[i]) &&
                            std::isfinite(compared.rgb[pixels + i]) &&
                            std::isfinite(compared.rgb[2 * pixels + i]);
        if (finite) continue;
        if (count++ == 0) first = i;
    }
    if (count > 0)
        throw input_error(place, fmt::format("{} of {} pixels {} NaN or infinite, the first at "
                                             "column {}, row {}; expected finite values",
                                             count, pixels, count == 1 ? "is" : "are",
                                             first % compared.width, first / compared.width));
}

/// Reads the colours of one layer; grey ones from a layer of one channel.
ComparedImage load_compared(const fs::path& path, const std::optional<std::string>& layer_name) {
    const std::string place = path.string();
    Image image = load_image(path);
    const Layer* layer = image.find(layer_name.value_or(""));
    if (layer == nullptr)
        throw input_error(place, (layer_name ? "has no layer " + quote(*layer_name)
                                             : std::string("has no beauty layer")) +
                                     ", its layers are: " + layer_names(image));
    ComparedImage compared{{}, image.width, image.height, is_display_referred(image)};
    const std::size_t pixels = compared.view().pixels();
    const bool grey = layer->channels.size() == 1;
    if (layer->words || (!grey && !layer->channels.starts_with("RGB")))
        throw input_error(place, "has the channels " + quote(layer->channels) +
                                     " in the layer to compare, expected RGB or a single one");
    const auto begin = layer->values.begin();
    const auto end = begin + static_cast<std::ptrdiff_t>(grey ? pixels : 3 * pixels);
    compared.rgb.reserve(3 * pixels);
    for (int copy = 0; copy < (grey ? 3 : 1); ++copy)
        compared.rgb.insert(compared.rgb.end(), begin, end);
    check_finite(compared, place);
    return compared;
}

/// null where there is no value, as JSON has no infinity either.
json json_number(const std::optional<double>& value) {
    return value && std::isfinite(*value) ? json(*value) : json();
}

std::string number_text(const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : "undefined";
}

/// Measures a pair of images, one metric after another.
class Comparison {
  public:
    Comparison(const ComparedImage& reference, const ComparedImage& test,
               const CompareOptions& options)
        : reference_(reference),
          test_(test),
          options_(options),
          display_(reference.display_referred && test.display_referred),
          luminance_scale_(options.luminance_scale.value_or(display_ ? 80.0 : 100.0)) {}

    /// The metrics that the options choose; FLIP in the variant that suits the images.
    [[nodiscard]] std::vector<Metric> chosen() const {
        std::vector<Metric> metrics = options_.metrics;
        if (metrics.empty())
            metrics = {Metric::hdrvdp,         Metric::flip,     Metric::relmse,
                       Metric::relmse_trimmed, Metric::mape,     Metric::bias,
                       Metric::mean_ratio,     Metric::psnr,     Metric::ssim,
                       Metric::pu21_psnr,      Metric::pu21_ssim};
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
            default:
                return measure_relative(metric, report);
        }
    }

  private:
    void measure_hdr_vdp(Report& report) {
        HdrVdpSettings settings;
        settings.luminance_scale = luminance_scale_;
        settings.pixels_per_degree = options_.ppd.value_or(settings.pixels_per_degree);
        settings.legacy_fan = options_.legacy_fan;
        settings.legacy_otf_grid = options_.legacy_otf_grid;
        std::optional<HdrVdpResult> result;
        // A single row or column has no frequencies across it.
        if (std::min(reference_.width, reference_.height) >= 2)
            result = hdr_vdp(luminance(test_.view()), luminance(reference_.view()),
                             reference_.width, reference_.height, settings);
        const std::string note = fmt::format("{:g} cd/m2 at value 1, {:g} pixels per degree{}{}",
                                             settings.luminance_scale, settings.pixels_per_degree,
                                             settings.legacy_fan ? ", legacy fan" : "",
                                             settings.legacy_otf_grid ? ", legacy OTF grid" : "");
        const auto percent = [&](double HdrVdpResult::*member) {
            return result ? fmt::format("{:.4f} %", (*result).*member) : "undefined";
        };
        report.add_row("hdrvdp p75", percent(&HdrVdpResult::p75), note);
        report.add_row("hdrvdp p95", percent(&HdrVdpResult::p95), "");
        report.keys["hdrvdp"] = {{"p75", result ? json(result->p75) : json()},
                                 {"p95", result ? json(result->p95) : json()},
                                 {"mean", result ? json(result->mean) : json()},
                                 {"luminance_scale", settings.luminance_scale},
                                 {"ppd", settings.pixels_per_degree},
                                 {"legacy_fan", settings.legacy_fan},
                                 {"legacy_otf_grid", settings.legacy_otf_grid}};
        if (result) report.keep_map(std::move(result->probability), 1.0);
    }

    void measure_flip(Metric metric, Report& report) {
        const double ppd = options_.ppd.value_or(flip_default_ppd);
        std::string note = fmt::format("{:.4g} pixels per degree", ppd);
        json keys = {{"ppd", ppd}};
        FlipResult result;
        if (metric == Metric::flip) {
            result = ldr_flip(reference_.view(), test_.view(), ppd);
        } else {
            const FlipExposures exposures = flip_exposures(reference_.view());
            result = hdr_flip(reference_.view(), test_.view(), exposures, ppd);
            note += fmt::format(", {} exposures from {:.4g} to {:.4g} EV", exposures.count,
                                exposures.start, exposures.stop);
            keys["start_exposure"] = exposures.start;
            keys["stop_exposure"] = exposures.stop;
            keys["exposures"] = exposures.count;
        }
        keys["mean"] = result.mean;
        report.add_row(to_string(metric), number_text(result.mean), note);
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

    const ComparedImage& reference_;
    const ComparedImage& test_;
    const CompareOptions& options_;
    bool display_;
    double luminance_scale_;
    std::optional<RelativeErrors> relative_;
};

}  // namespace

void compare_command(const CompareOptions& options) {
    const ComparedImage reference = load_compared(options.reference, options.layer);
    const ComparedImage test = load_compared(options.test, options.layer);
    if (test.width != reference.width || test.height != reference.height)
        throw input_error(options.test.string(),
                          fmt::format("has {} x {} pixels, expected {} x {} as the reference {}",
                                      test.width, test.height, reference.width, reference.height,
                                      quote(options.reference.string())));
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
