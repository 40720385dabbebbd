// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "app/background_options.h"
#include "app/commands.h"
#include "app/print.h"
#include "base/file.h"
#include "base/quote.h"
#include "film/cryptomatte.h"
#include "film/film_sums_file.h"
#include "film/sample_parts.h"
#include "image/exr.h"

namespace weft {
namespace {

// Metadata of the parts that the merged image keeps.
constexpr const char* kept_metadata[] = {"software", "scene", "algorithm", "seed", "background"};

/// What the metadata of an image call its background; empty where they name none.
std::string background_of(const std::map<std::string, std::string>& metadata) {
    const auto found = metadata.find("background");
    return found != metadata.end() ? found->second : "";
}

/// The layers of identifiers, which are the same in all parts of an image but for their noise.
std::vector<Layer> mattes_of(const Image& image) {
    std::vector<Layer> layers;
    std::copy_if(image.layers.begin(), image.layers.end(), std::back_inserter(layers),
                 [](const Layer& layer) { return is_cryptomatte(layer.name); });
    return layers;
}

/// Fails where the parts do not have just the samples that are expected.
void check_expected(const std::vector<SampleRange>& ranges, SampleRange expected,
                    const std::string& output) {
    const std::vector<SampleRange> missing = missing_of(ranges, expected);
    if (!missing.empty())
        throw input_error(output, fmt::format("lacks the samples {}, expected parts that have all "
                                              "of {}:{}",
                                              ranges_text(missing), expected.first, expected.end));
    if (ranges.front().first < expected.first || ranges.back().end > expected.end)
        throw input_error(output,
                          fmt::format("would have the samples {}, expected no others than {}:{}",
                                      ranges_text(ranges), expected.first, expected.end));
}

/// Prints the numbers of the parts that are not there.
void print_missing(const MergeOptions& options) {
    std::vector<SampleRange> ranges;
    std::string identity;
    for (const std::filesystem::path& part : options.parts) {
        std::error_code unknown;
        // Where it cannot be looked for, reading it says why.
        if (!std::filesystem::exists(part, unknown) && !unknown) continue;
        const FilmSums sums = sums_of(read_exr(part), part.string());
        if (!identity.empty() && sums.identity != identity)
            throw input_error(part.string(), "is of another image than the parts before it");
        identity = sums.identity;
        ranges.insert(ranges.end(), sums.ranges.begin(), sums.ranges.end());
    }
    print_result(numbers_text(missing_parts(joined(ranges), *options.expect, *options.missing)) +
                 "\n");
}

/// Warns where parts come from backends that are not those of the parts before.
void warn_about_other_backends(const FilmSums& whole, const FilmSums& part,
                               const std::string& first, const std::string& file,
                               Diagnostics& diagnostics) {
    if (whole.backends.empty() || part.backends.empty() || whole.backends == part.backends) return;
    diagnostics.warn(
        file, fmt::format("is of {} and {} of {}: the image is as good, but its last bits may be "
                          "those of neither",
                          backends_text(part.backends), first, backends_text(whole.backends)));
}

}  // namespace

void merge_command(const MergeOptions& options, Diagnostics& diagnostics) {
    use_exr_threads(tbb::this_task_arena::max_concurrency());
    if (options.missing) {
        print_missing(options);
        return;
    }
    check_output(options.output);
    FilmSums whole;
    std::map<std::string, std::string> metadata;
    std::vector<Layer> mattes;
    for (std::size_t i = 0; i < options.parts.size(); ++i) {
        const std::filesystem::path& part = options.parts[i];
        const Image image = read_exr(part);
        FilmSums sums = sums_of(image, part.string());
        if (i == 0) {
            whole = std::move(sums);
            metadata = image.metadata;
            mattes = mattes_of(image);
            continue;
        }
        const std::string before =
            i == 1 ? quote(options.parts.front().string()) : "the parts before it";
        // Once is enough: from then on the whole is of several.
        if (whole.backends.size() == 1)
            warn_about_other_backends(whole, sums, before, part.string(), diagnostics);
        try {
            add_sums(whole, sums);
        } catch (const Error& error) {
            throw Error(error.code(), part.string(),
                        fmt::format("cannot be merged with {}: {}", before, error.what()));
        }
        if (background_of(image.metadata) != background_of(metadata))
            throw input_error(part.string(),
                              "has another --background than the first part, expected the same");
    }
    if (whole.ranges.empty())
        throw input_error(options.parts.front().string(),
                          "has no samples, as the other parts, expected parts with some");
    if (options.expect) check_expected(whole.ranges, *options.expect, options.output.string());
    const SampleRange all{whole.ranges.front().first, whole.ranges.back().end};
    for (const SampleRange& gap : missing_of(whole.ranges, all))
        diagnostics.warn(options.output.string(),
                         fmt::format("lacks the samples {0}:{1} between those of its parts, which "
                                     "--samples {0}:{1} with --resume adds",
                                     gap.first, gap.end));
    Image image = resolve_sums(whole);
    for (const char* const key : kept_metadata)
        if (const auto found = metadata.find(key); found != metadata.end())
            image.metadata.insert(*found);
    for (const auto& [key, value] : metadata)
        if (is_cryptomatte(key)) image.metadata[key] = value;
    if (const std::string text = background_of(metadata); !text.empty())
        put_behind(parse_background(options.parts.front().string(), text), image);
    for (Layer& layer : mattes) image.layers.push_back(std::move(layer));
    image.metadata["samples"] = std::to_string(whole.samples());
    attach_sums(whole, image);
    write_exr(options.output, image);
}

}  // namespace weft
