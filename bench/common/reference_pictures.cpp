// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/reference_pictures.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/stopwatch.h"
#include "frame/film_sums_file.h"
#include "frame/path_renderer.h"
#include "image/exr.h"

namespace weft::bench {
namespace {

namespace fs = std::filesystem;

constexpr double checkpoint_ms = 60e3;
constexpr std::uint32_t reference_seed = 77;  // another one than the pictures have

/// The number between `prefix` and `suffix`, where `name` is these three.
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

/// The file of that pattern with the highest number that `accept` takes.
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
        Image image = read_exr(file);
        if (accept(image)) return Reference{std::move(image), file, spp, false};
    }
    return std::nullopt;
}

bool usable(const Image& image, std::uint32_t size) {
    if (image.width != size || image.height != size) return false;
    for (const char* const layer : {"", "direct", "indirect"})
        if (image.find(layer) == nullptr || image.find(layer)->channels != "RGB") return false;
    return true;
}

/// Renders what `renderer` has left, writing a checkpoint now and then.
void render_all(PathRenderer& renderer, const fs::path& checkpoint) {
    Stopwatch watch;
    double saved = 0.0;
    while (renderer.samples_left() > 0) {
        (void)renderer.render_frame({});
        if (renderer.samples_left() == 0 || watch.total() - saved < checkpoint_ms) continue;
        const FilmSums sums = renderer.sums();
        Image image = resolve_sums(sums);
        attach_sums(sums, image);
        write_exr(checkpoint, image);
        saved = watch.total();
    }
}

}  // namespace

nlohmann::json Reference::json() const {
    return {{"file", file.filename().string()}, {"samples", samples}, {"identified", identified}};
}

ReferencePictures::ReferencePictures(fs::path folder, Executor& executor,
                                     std::function<void(const std::string&)> say)
    : folder_(std::move(folder)), executor_(executor), say_(std::move(say)) {
    std::error_code error;
    fs::create_directories(folder_, error);
    if (!fs::is_directory(folder_, error))
        throw Error(ExitCode::output, folder_.string(), "is no folder, expected one to write to");
}

Reference ReferencePictures::find(const FlatScene& scene, const Camera& camera,
                                  const ReferenceWish& wish) {
    PathSettings settings;
    settings.width = settings.height = wish.size;
    settings.seed = reference_seed;
    settings.through_centres = wish.through_centres;
    settings.samples.end = wish.spp;
    auto renderer = std::make_unique<PathRenderer>(executor_, scene, camera, settings, FilmSums{});
    const std::string picture = renderer->sums().picture;
    const std::string prefix =
        fmt::format("{}-{}x{}-{}-", wish.scene, wish.size, wish.size, wish.filter());
    const auto fits = [&](const Image& image) { return usable(image, wish.size); };
    if (auto found = most_samples(folder_, prefix, "-" + picture + ".exr", wish.spp, fits)) {
        found->identified = true;
        return std::move(*found);
    }
    const std::string plain = fmt::format("{}-{}-", wish.scene, wish.filter());
    if (auto found = most_samples(folder_, plain, ".exr", 1, fits)) return std::move(*found);

    const fs::path checkpoint = folder_ / fmt::format("{}{}-{}.part", prefix, wish.spp, picture);
    if (fs::exists(checkpoint)) {
        FilmSums sums = sums_of(read_exr(checkpoint), checkpoint.string());
        settings.samples.first = static_cast<std::uint32_t>(sums.samples());
        renderer =
            std::make_unique<PathRenderer>(executor_, scene, camera, settings, std::move(sums));
    }
    say_(fmt::format("reference {}{}: samples {} to {}", prefix, picture, settings.samples.first,
                     wish.spp));
    render_all(*renderer, checkpoint);
    const fs::path file =
        folder_ / fmt::format("{}{}-{}.exr", prefix, renderer->samples(), picture);
    Reference made{renderer->image(), file, renderer->samples(), true};
    made.image.metadata["picture"] = picture;
    made.image.metadata["samples"] = std::to_string(made.samples);
    write_exr(file, made.image);
    std::error_code error;
    fs::remove(checkpoint, error);
    return made;
}

}  // namespace weft::bench
