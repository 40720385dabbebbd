// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/stopwatch.h"
#include "film/film_sums_file.h"
#include "image/exr.h"
#include "render/path_renderer.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr double checkpoint_ms = 60e3;

/// The number between `prefix` and `suffix`, where `name` consists of these three.
std::optional<std::uint32_t> number_in(std::string_view name, std::string_view prefix,
                                       std::string_view suffix) {
    if (name.size() <= prefix.size() + suffix.size() || !name.starts_with(prefix) ||
        !name.ends_with(suffix))
        return std::nullopt;
    const std::string_view digits =
        name.substr(prefix.size(), name.size() - prefix.size() - suffix.size());
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size()) return std::nullopt;
    return value;
}

/// The file of that pattern with the highest number for which `accept` is true.
std::optional<Reference> most_samples(const fs::path& folder, const std::string& prefix,
                                      const std::string& suffix, std::uint32_t least,
                                      const std::function<bool(const Image&)>& accept) {
    std::vector<std::pair<std::uint32_t, fs::path>> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const auto spp = number_in(entry.path().filename().string(), prefix, suffix);
        if (spp && *spp >= least) files.emplace_back(*spp, entry.path());
    }
    std::sort(files.rbegin(), files.rend());
    for (const auto& [spp, file] : files) {
        try {
            Image image = read_exr(file);
            if (accept(image)) return Reference{std::move(image), file, spp, false};
        } catch (const Error&) {
            continue;  // a damaged file counts as absent
        }
    }
    return std::nullopt;
}

bool usable(const Image& image, const ReferenceWish& wish) {
    if (image.width != wish.size || image.height != wish.rows()) return false;
    std::vector<const char*> layers{"", "direct", "indirect"};
    if (wish.with_halves) layers.insert(layers.end(), {first_half_layer, second_half_layer});
    return std::all_of(layers.begin(), layers.end(), [&](const char* name) {
        const Layer* const layer = image.find(name);
        return layer != nullptr && layer->channels == "RGB";
    });
}

void write_sums(const FilmSums& sums, const fs::path& file) {
    Image image = resolve_sums(sums);
    attach_sums(sums, image);
    write_exr(file, image);
}

/// The first samples of a part, which an earlier run has left in a checkpoint; none where it is
/// missing, damaged or of another image.
FilmSums sums_so_far(const fs::path& checkpoint, const std::string& identity, SampleRange part) {
    std::error_code error;
    if (!fs::is_regular_file(checkpoint, error)) return {};
    try {
        FilmSums sums = sums_of(read_exr(checkpoint), checkpoint.string());
        const bool begins_it = sums.ranges.size() == 1 && sums.ranges[0].first == part.first &&
                               sums.ranges[0].end <= part.end;
        if (sums.identity == identity && begins_it) return sums;
    } catch (const Error&) {
        return {};
    }
    return {};
}

Layer beauty_of(const FilmSums& sums, const char* name) {
    Layer layer = *resolve_sums(sums).find("");
    layer.name = name;
    return layer;
}

}  // namespace

nlohmann::json Reference::json() const {
    return {{"file", file.filename().string()}, {"samples", samples}, {"identified", identified}};
}

ReferenceImages::ReferenceImages(fs::path folder, Executor& executor,
                                 std::function<void(const std::string&)> say,
                                 std::function<bool(double)> keep_going)
    : folder_(std::move(folder)),
      executor_(executor),
      say_(std::move(say)),
      keep_going_(std::move(keep_going)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (!fs::is_directory(folder_, error))
        throw Error(ExitCode::output, folder_.string(), "is no folder, expected one to write to");
}

FilmSums ReferenceImages::make_part(const FlatScene& scene, const Camera& camera,
                                    const PathSettings& settings, const std::string& identity,
                                    const fs::path& checkpoint, double begin) {
    constexpr double share = 0.5;
    const SampleRange part = settings.samples;
    PathSettings left = settings;
    FilmSums sums = sums_so_far(checkpoint, identity, part);
    left.samples.first = sums.ranges.empty() ? part.first : sums.ranges[0].end;
    if (left.samples.first == part.end) return sums;
    PathRenderer renderer(executor_, scene, camera, left, std::move(sums));
    Stopwatch watch;
    double saved = 0.0;
    while (renderer.samples_left() > 0) {
        const double done =
            1.0 - static_cast<double>(renderer.samples_left()) / (part.end - part.first);
        if (keep_going_ && !keep_going_(begin + share * done)) {
            if (renderer.samples() > 0) write_sums(renderer.sums(), checkpoint);
            throw Error(ExitCode::interrupted,
                        "interrupted, the samples of the reference so far are kept for next time");
        }
        (void)renderer.render_frame({});
        if (watch.total() - saved < checkpoint_ms) continue;
        write_sums(renderer.sums(), checkpoint);
        saved = watch.total();
    }
    return renderer.sums();
}

Reference ReferenceImages::make(const FlatScene& scene, const Camera& camera,
                                const ReferenceWish& wish, PathSettings settings,
                                const std::string& identity) {
    const std::string name = fmt::format("{}-{}x{}-{}-{}-{}", wish.scene, wish.size, wish.rows(),
                                         wish.filter(), wish.spp, identity);
    say_(fmt::format("reference {}: {} samples per pixel", name, wish.spp));
    const std::uint32_t middle = wish.spp / 2;
    const std::array<SampleRange, 2> parts{SampleRange{0, middle}, SampleRange{middle, wish.spp}};
    std::array<fs::path, 2> checkpoints;
    std::vector<Layer> halves;
    FilmSums whole;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        checkpoints[i] = folder_ / fmt::format("{}.{}.part", name, i + 1);
        if (parts[i].first == parts[i].end) continue;  // a half of a single sample is empty
        settings.samples = parts[i];
        FilmSums part =
            make_part(scene, camera, settings, identity, checkpoints[i], i == 0 ? 0.0 : 0.5);
        // Saved, so that an interruption of the second half does not lose the first.
        if (i == 0) write_sums(part, checkpoints[i]);
        halves.push_back(beauty_of(part, i == 0 ? first_half_layer : second_half_layer));
        if (whole.words.empty())
            whole = std::move(part);
        else
            add_sums(whole, part);
    }
    Reference made{resolve_sums(whole), folder_ / (name + ".exr"), whole.samples(), true};
    // References measure light: from a file, alpha would come back as a part of beauty.
    std::erase_if(made.image.layers,
                  [](const Layer& layer) { return layer.name == alpha_layer_name; });
    if (halves.size() == parts.size())
        made.image.layers.insert(made.image.layers.end(), halves.begin(), halves.end());
    made.image.metadata["picture"] = identity;
    made.image.metadata["samples"] = std::to_string(made.samples);
    write_exr(made.file, made.image);
    std::error_code error;
    for (const fs::path& checkpoint : checkpoints) fs::remove(checkpoint, error);
    return made;
}

Reference ReferenceImages::find(const FlatScene& scene, const Camera& camera,
                                const ReferenceWish& wish) {
    PathSettings settings;
    settings.width = wish.size;
    settings.height = wish.rows();
    settings.seed = reference_seed;
    settings.through_centres = wish.through_centres;
    settings.samples = {0, 1};
    const std::string identity =
        PathRenderer(executor_, scene, camera, settings, FilmSums{}).sums().identity;
    const std::string prefix =
        fmt::format("{}-{}x{}-{}-", wish.scene, wish.size, wish.rows(), wish.filter());
    const auto fits = [&](const Image& image) { return usable(image, wish); };
    if (auto found = most_samples(folder_, prefix, "-" + identity + ".exr", wish.spp, fits)) {
        found->identified = true;
        return std::move(*found);
    }
    const std::string plain = fmt::format("{}-{}-", wish.scene, wish.filter());
    if (!wish.with_halves)
        if (auto found = most_samples(folder_, plain, ".exr", 1, fits)) return std::move(*found);
    return make(scene, camera, wish, settings, identity);
}

}  // namespace weft
