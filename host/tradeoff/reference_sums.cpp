// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/reference_sums.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "base/error.h"
#include "base/stopwatch.h"
#include "film/film_sums_file.h"
#include "image/exr.h"
#include "render/reference_renderer.h"
#include "tradeoff/reference_files.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Sums are saved after so many milliseconds, but take no more than this share of the time.
constexpr double save_ms = 60e3;
constexpr double most_saving = 0.05;

Layer beauty_layer(const FilmSums& sums, const char* name) {
    Layer layer = *resolve_sums(sums).find("");
    layer.name = name;
    return layer;
}

}  // namespace

/// The renderers of both halves, which take turns, so that neither gets far ahead of the other.
class ReferenceSums::Growth {
  public:
    Growth(ReferenceSums& sums, std::uint32_t count) : sums_(sums), count_(count) {
        for (std::size_t half = 0; half < 2; ++half) {
            const std::uint32_t done = sums.samples_of(half);
            if (done < count)
                renderers_[half] =
                    sums.make_renderer(half, {done, count}, std::move(sums.sums_[half]));
        }
    }

    [[nodiscard]] std::uint32_t done(std::size_t half) const {
        return renderers_[half] ? count_ - renderers_[half]->samples_left() : count_;
    }
    [[nodiscard]] std::size_t behind() const { return done(0) <= done(1) ? 0 : 1; }
    [[nodiscard]] bool is_balanced() const { return done(0) > 0 && done(0) == done(1); }
    [[nodiscard]] bool is_done() const { return done(0) == count_ && done(1) == count_; }
    [[nodiscard]] double share() const {
        return (static_cast<double>(done(0)) + done(1)) / (2.0 * count_);
    }

    /// Adds a frame to the half that has fewer samples; a single sample where `short_frames`, so
    /// that it does not overtake the other.
    void render(bool short_frames) {
        const std::size_t half = behind();
        ExactRenderer& renderer = *renderers_[half];
        if (short_frames) renderer.limit_frames(0.0);
        const Stopwatch watch;
        (void)renderer.render_frame({});
        sums_.seconds_[half] += 1e-3 * watch.total();
    }

    void save() {
        for (std::size_t half = 0; half < 2; ++half)
            if (renderers_[half]) sums_.save(half, renderers_[half]->sums());
    }

    /// Gives the sums back.
    void finish() {
        for (std::size_t half = 0; half < 2; ++half) {
            if (!renderers_[half]) continue;
            sums_.sums_[half] = renderers_[half]->sums();
            renderers_[half].reset();
            sums_.save(half, sums_.sums_[half]);
        }
    }

  private:
    ReferenceSums& sums_;
    std::uint32_t count_;
    std::array<std::unique_ptr<ExactRenderer>, 2> renderers_;
};

ReferenceSums::ReferenceSums(Executor& executor, const FlatScene& scene, const Camera& camera,
                             const PathSettings& settings)
    : executor_(executor),
      scene_(scene),
      camera_(camera),
      settings_(settings),
      uploaded_(std::make_shared<SceneBuffers>(upload_scene(executor, scene))) {
    for (std::size_t half = 0; half < 2; ++half) {
        const auto renderer = make_renderer(half, {0, 1}, {});
        identities_[half] = renderer->sums().identity;
        // Both halves should be made in the same way.
        if (half == 0)
            settings_.algorithm = renderer->plan().exact ? Algorithm::reference : Algorithm::path;
    }
}

void ReferenceSums::keep_in(const fs::path& stem) {
    for (std::size_t half = 0; half < 2; ++half) {
        files_[half] = stem;
        files_[half] += fmt::format(".{}.sums", half + 1);
        load(half);
    }
}

void ReferenceSums::load(std::size_t half) {
    std::error_code error;
    if (!fs::is_regular_file(files_[half], error)) return;
    try {
        const Image image = read_exr(files_[half]);
        FilmSums sums = sums_of(image, files_[half].string());
        const bool begins = sums.ranges.size() == 1 && sums.ranges[0].first == 0;
        if (sums.identity != identities_[half] || !begins || sums.width != settings_.width ||
            sums.height != settings_.height)
            return;
        sums_[half] = std::move(sums);
        seconds_[half] = metadata_number(image, reference_seconds_key).value_or(0.0);
    } catch (const Error&) {
        return;  // a damaged file counts as absent
    }
}

void ReferenceSums::save(std::size_t half, const FilmSums& sums) const {
    if (files_[half].empty() || sums.ranges.empty()) return;
    Image image{.width = sums.width, .height = sums.height, .layers = {}, .metadata = {}};
    attach_sums(sums, image);
    image.metadata[reference_seconds_key] = fmt::format("{:.3f}", seconds_[half]);
    write_exr(files_[half], image);
}

std::uint32_t ReferenceSums::samples_of(std::size_t half) const {
    return static_cast<std::uint32_t>(sums_[half].samples());
}

std::uint32_t ReferenceSums::samples() const {
    return std::min(samples_of(0), samples_of(1));
}

std::unique_ptr<ExactRenderer> ReferenceSums::make_renderer(std::size_t half, SampleRange range,
                                                            FilmSums sums) {
    PathSettings settings = settings_;
    settings.seed = reference_seeds[half];
    settings.samples = range;
    return make_exact_renderer(executor_, scene_, uploaded_, camera_, settings, std::move(sums));
}

bool ReferenceSums::grow(std::uint32_t count, const GrowthLimits& limits) {
    Growth growth(*this, std::max({count, samples_of(0), samples_of(1)}));
    const Stopwatch watch;
    double next_save = save_ms;
    while (!growth.is_done()) {
        const bool late = watch.total() >= 1e3 * limits.seconds;
        if (late && growth.is_balanced()) break;
        if (limits.keep_going && !limits.keep_going(growth.share())) {
            growth.finish();
            throw Error(ExitCode::interrupted,
                        "interrupted, the samples of the reference so far are kept for next time");
        }
        growth.render(late);
        const double begin = watch.total();
        if (begin < next_save) continue;
        growth.save();
        const double end = watch.total();
        next_save = end + std::max(save_ms, (end - begin) / most_saving);
    }
    growth.finish();
    return samples() >= count;
}

Image ReferenceSums::image() {
    const std::array<Layer, 2> halves{beauty_layer(sums_[0], first_half_layer),
                                      beauty_layer(sums_[1], second_half_layer)};
    // As if the samples of the second half followed those of the first, in the same image.
    const std::uint32_t count = samples_of(0);
    FilmSums whole = sums_[0];
    FilmSums& second = sums_[1];
    std::string identity = std::exchange(second.identity, whole.identity);
    std::vector<SampleRange> ranges = std::exchange(second.ranges, {SampleRange{count, 2 * count}});
    add_sums(whole, second);
    second.identity = std::move(identity);
    second.ranges = std::move(ranges);
    Image image = resolve_sums(whole);
    std::erase_if(image.layers, [](const Layer& layer) { return layer.name == alpha_layer_name; });
    image.layers.insert(image.layers.end(), halves.begin(), halves.end());
    return image;
}

}  // namespace weft
