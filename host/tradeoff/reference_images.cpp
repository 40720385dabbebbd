// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_images.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/stopwatch.h"
#include "image/exr.h"
#include "plan/algorithm.h"
#include "tradeoff/reference_files.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

constexpr const char* algorithm_key = "algorithm";

PathSettings path_settings_of(const ReferenceWish& wish) {
    PathSettings settings;
    settings.algorithm = wish.algorithm;
    settings.width = wish.size;
    settings.height = wish.rows();
    settings.through_centres = wish.through_centres;
    return settings;
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

/// The first of the files that can be used.
std::optional<Reference> first_usable(const std::vector<SampledFile>& files,
                                      const ReferenceWish& wish,
                                      const std::function<bool(const Reference&)>& accept) {
    for (const auto& [samples, file] : files) {
        try {
            Reference found{read_exr(file), file, samples};
            found.floor = stated_floor(found.image);
            if (usable(found.image, wish) && accept(found)) return found;
        } catch (const Error&) {
            continue;  // a damaged file counts as absent
        }
    }
    return std::nullopt;
}

std::string floor_words(const ReferenceFloor& floor) {
    return fmt::format("halves differ at {:.3g} % of the pixels (published), {:.3g} % (display)",
                       floor.published, floor.display);
}

std::string image_suffix(const std::string& identity) {
    return "-" + identity + ".exr";
}

/// The next number of samples of a half: of `first` and its doubles the smallest one that a half
/// with `done` samples does not have, or has but was not judged with.
std::uint32_t next_step(std::uint32_t first, std::uint32_t done, bool is_judged,
                        std::uint32_t most) {
    std::uint64_t step = first;
    while (step < done || (step == done && is_judged)) step *= 2;
    return static_cast<std::uint32_t>(std::min<std::uint64_t>(step, most));
}

}  // namespace

std::string Reference::algorithm() const {
    const auto found = image.metadata.find(algorithm_key);
    return found != image.metadata.end() ? found->second : std::string();
}

double Reference::seconds() const {
    return metadata_number(image, reference_seconds_key).value_or(0.0);
}

nlohmann::json Reference::json() const {
    nlohmann::json json{
        {"file", file.filename().string()}, {"samples", samples}, {"identified", identified}};
    if (!algorithm().empty()) json["algorithm"] = algorithm();
    return json;
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

std::optional<Reference> ReferenceImages::kept(const ReferenceWish& wish,
                                               const std::string& identity) const {
    const auto is_enough = [&](const Reference& found) {
        return found.samples >= wish.spp ||
               (wish.enough && found.floor && found.floor->within(*wish.enough));
    };
    auto found = first_usable(files_by_samples(folder_, image_suffix(identity)), wish, is_enough);
    if (found) found->identified = true;
    return found;
}

fs::path ReferenceImages::stem_of(const ReferenceWish& wish, const std::string& identity) const {
    // The scene may have had another name before.
    if (auto file = file_ending_with(folder_, "-" + identity + ".1.sums"))
        return file->replace_extension().replace_extension();
    return folder_ / fmt::format("{}-{}x{}-{}-{}", wish.scene, wish.size, wish.rows(),
                                 wish.filter(), identity);
}

Reference ReferenceImages::image_of(const ReferenceWish& wish, ReferenceSums& sums) const {
    const std::uint32_t samples = 2 * sums.samples();
    Reference made{sums.image(),
                   folder_ / fmt::format("{}-{}x{}-{}-{}{}", wish.scene, wish.size, wish.rows(),
                                         wish.filter(), samples, image_suffix(sums.identity())),
                   samples, true};
    made.image.metadata["picture"] = sums.identity();
    made.image.metadata["samples"] = std::to_string(samples);
    made.image.metadata["seed"] = fmt::format("{} and {}", reference_seeds[0], reference_seeds[1]);
    made.image.metadata[algorithm_key] = to_string(sums.algorithm());
    made.image.metadata[reference_seconds_key] = fmt::format("{:.3f}", sums.seconds());
    return made;
}

void ReferenceImages::keep(const Reference& made, const std::string& identity) const {
    write_exr(made.file, made.image);
    std::error_code error;
    for (const auto& [samples, file] : files_by_samples(folder_, image_suffix(identity)))
        if (samples < made.samples) fs::remove(file, error);
}

Reference ReferenceImages::find(const FlatScene& scene, const Camera& camera,
                                const ReferenceWish& wish) {
    ReferenceSums sums(executor_, scene, camera, path_settings_of(wish));
    if (auto found = kept(wish, sums.identity())) return std::move(*found);
    if (sums.algorithm() != Algorithm::path) {
        PathSettings by_path = path_settings_of(wish);
        by_path.algorithm = Algorithm::path;
        const ReferenceSums other(executor_, scene, camera, by_path);
        if (auto found = kept(wish, other.identity())) return std::move(*found);
    }
    if (!wish.with_halves) {
        const std::string plain = fmt::format("{}-{}-", wish.scene, wish.filter());
        const auto any = [](const Reference&) { return true; };
        if (auto found = first_usable(files_by_samples(folder_, plain, ".exr"), wish, any))
            return std::move(*found);
    }
    say_(fmt::format("reference {}-{}x{}-{}: {} samples per pixel", wish.scene, wish.size,
                     wish.rows(), wish.filter(), wish.spp));
    sums.keep_in(stem_of(wish, sums.identity()));
    (void)sums.grow((wish.spp + 1) / 2, {.keep_going = keep_going_});
    Reference made = image_of(wish, sums);
    keep(made, sums.identity());
    return made;
}

Reference ReferenceImages::reach(const FlatScene& scene, const Camera& camera,
                                 const ReferenceWish& wish, const FloorGoal& goal) {
    const Stopwatch watch;
    ReferenceSums sums(executor_, scene, camera, path_settings_of(wish));
    ReferenceWish any = wish;
    any.with_halves = true;
    any.spp = 0;
    std::optional<Reference> best = kept(any, sums.identity());
    const auto judge = [&](Reference& reference) {
        reference.floor = measured_floor(reference.image);
        state_floor(*reference.floor, reference.image);
        keep(reference, sums.identity());
        say_(fmt::format("reference {}-{}x{}-{}: {} samples, {:.0f} s, {}", wish.scene, wish.size,
                         wish.rows(), wish.filter(), reference.samples, reference.seconds(),
                         floor_words(*reference.floor)));
    };
    if (best && !best->floor) judge(*best);
    if (best && best->floor->within(goal.floor)) return std::move(*best);
    sums.keep_in(stem_of(wish, sums.identity()));
    const std::uint32_t first = std::max(1U, (wish.spp + 1) / 2);
    const std::uint32_t most = std::max(1U, goal.most_spp / 2);
    for (bool in_time = true; in_time;) {
        const bool is_judged = best && best->samples >= std::uint64_t{2} * sums.samples();
        const std::uint32_t step = next_step(first, sums.samples(), is_judged, most);
        if (step <= sums.samples() && is_judged) break;
        in_time = sums.grow(
            step, {.keep_going = keep_going_, .seconds = goal.most_seconds - 1e-3 * watch.total()});
        if (best && best->samples >= std::uint64_t{2} * sums.samples()) continue;
        best = image_of(wish, sums);
        judge(*best);
        if (best->floor->within(goal.floor)) break;
    }
    return std::move(*best);
}

}  // namespace weft
