// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/file_output.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/stopwatch.h"
#include "film/film_sums_file.h"
#include "image/exr.h"
#include "image/png.h"
#include "session/overlay_files.h"

namespace weft {
namespace {

bool is_png(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension == ".png";
}

/// How many lines every_line() keeps of so many.
std::uint32_t lines_of(std::uint32_t height, std::uint32_t step) {
    return (height - step / 2 - 1) / step + 1;
}

/// Each `step`-th line of planes of that size.
template <class T>
std::vector<T> every_line(const std::vector<T>& planes, std::uint32_t width, std::uint32_t height,
                          std::uint32_t step) {
    std::vector<T> lines;
    for (std::size_t begin = 0; begin < planes.size(); begin += std::size_t{width} * height)
        for (std::size_t y = step / 2; y < height; y += step) {
            const auto line = planes.begin() + static_cast<std::ptrdiff_t>(begin + y * width);
            lines.insert(lines.end(), line, line + width);
        }
    return lines;
}

/// An image of each `step`-th line, at most the height.
SessionImage every_line(const SessionImage& of, std::uint32_t step) {
    const std::uint32_t width = of.image.width;
    const std::uint32_t height = of.image.height;
    SessionImage lines;
    lines.algorithm = of.algorithm;
    lines.samples = of.samples;
    lines.seed = of.seed;
    lines.image.width = width;
    lines.image.height = lines_of(height, step);
    for (const Layer& layer : of.image.layers) {
        Layer kept{layer.name, layer.channels, {}, layer.words, layer.half};
        kept.values = every_line(layer.values, width, height, step);
        lines.image.layers.push_back(std::move(kept));
    }
    if (!of.sums) return lines;
    lines.sums.emplace();
    lines.sums->width = width;
    lines.sums->height = lines.image.height;
    lines.sums->identity = of.sums->identity;
    lines.sums->light_exponent = of.sums->light_exponent;
    lines.sums->depth_unit = of.sums->depth_unit;
    lines.sums->ranges = of.sums->ranges;
    lines.sums->words = every_line(of.sums->words, width, height, step);
    return lines;
}

}  // namespace

void describe(SessionImage& rendered, const FileOutputSettings& settings) {
    std::map<std::string, std::string>& metadata = rendered.image.metadata;
    metadata["software"] = "weft " WEFT_VERSION;
    metadata["scene"] = settings.scene;
    metadata["algorithm"] = to_string(rendered.algorithm);
    metadata["samples"] = std::to_string(rendered.samples);
    if (!rendered.light.empty()) metadata["light"] = light_text(rendered.light);
    metadata["seed"] = std::to_string(rendered.seed);
    if (settings.background) metadata["background"] = to_string(*settings.background);
}

PngSettings png_settings(const Image& image, const FileOutputSettings& settings) {
    return {settings.exposure_ev ? *settings.exposure_ev : auto_exposure(image), settings.tone,
            settings.background};
}

void FileOutput::write(SessionImage rendered) {
    write_files(rendered, WriteMode::flushed);
}

void FileOutput::write_files(SessionImage& rendered, WriteMode mode) {
    Image& image = rendered.image;
    if (settings_.with_sums && rendered.sums) attach_sums(*rendered.sums, image);
    describe(rendered, settings_);
    if (is_png(settings_.file)) {
        write_png(settings_.file, image, png_settings(image, settings_), mode);
    } else {
        if (settings_.background) put_behind(*settings_.background, image);
        write_exr(settings_.file, image, mode);
    }
    if (settings_.overlays)
        write_overlays(settings_.file, image, settings_.exposure_ev, diagnostics_, mode);
}

double FileOutput::lines_ms(const SessionImage& image, std::uint32_t step) {
    SessionImage lines = every_line(image, step);
    const Stopwatch watch;
    if (settings_.sums && lines.sums) save_sums(*lines.sums, lines.image, WriteMode::rehearsed);
    write_files(lines, WriteMode::rehearsed);
    return watch.total();
}

double FileOutput::write_ms(const SessionImage& image) {
    // A twentieth of the lines, from all over the image, and one alone: what a file takes whatever
    // it holds is not to be multiplied.
    constexpr std::uint32_t share = 20;
    const std::uint32_t height = image.image.height;
    try {
        if (height <= 2 * share) return lines_ms(image, 1);
        const double one = lines_ms(image, height);
        const double some = lines_ms(image, share);
        const double each = (some - one) / (lines_of(height, share) - 1);
        return std::max(some, one + each * (height - 1));
    } catch (const Error&) {
        return 0.0;  // the image's own write tells what is wrong
    }
}

std::optional<double> FileOutput::save_interval_ms() const {
    return settings_.sums ? std::optional(settings_.save_interval_ms) : std::nullopt;
}

void FileOutput::save(const FilmSums& sums, const Image& image) {
    if (settings_.sums) save_sums(sums, image, WriteMode::flushed);
}

void FileOutput::save_sums(const FilmSums& sums, const Image& image, WriteMode mode) {
    Image saved = image;
    attach_sums(sums, saved);
    write_exr(*settings_.sums, saved, mode);
}

}  // namespace weft
