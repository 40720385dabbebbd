// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "app/split_reference.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string>
#include <utility>

#include "app/command_line.h"
#include "base/error.h"
#include "base/quote.h"
#include "film/film_sums_file.h"
#include "image/load_image.h"
#include "tradeoff/reference_images.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr const char* independent_image =
    "expected an independent image of the same view, such as one of another --seed";

std::string metadata_text(const Image& file, const char* key) {
    const auto found = file.metadata.find(key);
    return found != file.metadata.end() ? found->second : std::string();
}

/// Samples per pixel, as files by Weft state them; 0 where this one does not.
double stated_samples(const Image& file) {
    const std::string text = metadata_text(file, "samples");
    std::uint64_t samples = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), samples);
    const bool whole = error == std::errc() && end == text.data() + text.size();
    return whole ? static_cast<double>(samples) : 0.0;
}

bool overlap(const SampleRange& a, const SampleRange& b) {
    return a.first < b.end && b.first < a.end;
}

/// Whether two files by Weft say that they hold some samples in common: path-traced ones of one
/// seed do, unless both are parts of disjoint samples.
bool share_samples(const Image& a, const std::string& place_a, const Image& b,
                   const std::string& place_b) {
    for (const char* const key : {"algorithm", "seed"})
        if (metadata_text(a, key).empty() || metadata_text(a, key) != metadata_text(b, key))
            return false;
    constexpr const char* ranges = "weft.samples";
    if (metadata_text(a, ranges).empty() || metadata_text(b, ranges).empty()) return true;
    const std::vector<SampleRange> of_a = sums_of(a, place_a).ranges;
    const std::vector<SampleRange> of_b = sums_of(b, place_b).ranges;
    return std::any_of(of_a.begin(), of_a.end(), [&](const SampleRange& x) {
        return std::any_of(of_b.begin(), of_b.end(),
                           [&](const SampleRange& y) { return overlap(x, y); });
    });
}

/// Whether the names lead to one file.
bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    return a.lexically_normal() == b.lexically_normal() || fs::equivalent(a, b, error);
}

Error same_file_error(const char* other) {
    return usage_error(std::string("--second-reference: names the same file as ") + other + ", " +
                       independent_image);
}

}  // namespace

SplitReference::SplitReference(const CompareOptions& options) {
    if (options.second_reference) {
        if (same_file(*options.second_reference, options.reference)) throw same_file_error("REF");
        if (same_file(*options.second_reference, options.test)) throw same_file_error("TEST");
    }
    const Image file = load_image(options.reference);
    whole_ = compared_image(file, options.reference.string(), options.layer);
    if (options.second_reference)
        take_second(options, file);
    else if (!options.layer)
        take_halves(file);
}

ReferenceHalves SplitReference::halves() const {
    return {first().view(), second().view(), first_share_};
}

void SplitReference::check_independent(const ComparedImage& test) const {
    if (is_split() && !has_halves() && holds(test))
        throw input_error(test.place,
                          "has the same pixels as one of the references, expected another image");
}

bool SplitReference::holds(const ComparedImage& test) const {
    return test.rgb == whole_.rgb || test.rgb == first().rgb ||
           (second_ && test.rgb == second_->rgb);
}

void SplitReference::take_halves(const Image& file) {
    if (file.find(first_half_layer) == nullptr || file.find(second_half_layer) == nullptr) return;
    ComparedImage first = compared_image(file, whole_.place, first_half_layer);
    ComparedImage second = compared_image(file, whole_.place, second_half_layer);
    if (first.rgb == second.rgb) return;
    first_ = std::move(first);
    second_ = std::move(second);
}

void SplitReference::take_second(const CompareOptions& options, const Image& file) {
    const std::string place = options.second_reference->string();
    const Image other = load_image(*options.second_reference);
    ComparedImage second = compared_image(other, place, options.layer);
    check_same_size(second, whole_);
    if (second.rgb == whole_.rgb)
        throw input_error(place, fmt::format("has the same pixels as the reference {}, {}",
                                             quote(whole_.place), independent_image));
    if (share_samples(file, whole_.place, other, place))
        throw input_error(place,
                          fmt::format("has samples of the reference {}, of the same seed, {}",
                                      quote(whole_.place), independent_image));
    const double first_samples = stated_samples(file);
    const double second_samples = stated_samples(other);
    if (first_samples > 0.0 && second_samples > 0.0)
        first_share_ = first_samples / (first_samples + second_samples);
    second_ = std::move(second);
}

}  // namespace weft
