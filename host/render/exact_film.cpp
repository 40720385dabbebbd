// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "render/exact_film.h"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "scene/light_exponent.h"

namespace weft {
ExactFilm::ExactFilm(Executor& executor, std::uint32_t width, std::uint32_t height,
                     SampleRange samples)
    : executor_(executor), range_(samples), next_(samples.first) {
    meta_.width = width;
    meta_.height = height;
}

std::size_t ExactFilm::words() const noexcept {
    return std::size_t{FILM_PIXEL_WORDS} * meta_.width * meta_.height;
}

void ExactFilm::begin(FilmSums sums, const std::string& identity) {
    const bool continues = !sums.words.empty();
    if (continues && (sums.identity != identity || sums.words.size() != words()))
        throw Error(ExitCode::bad_input,
                    "the samples so far are of another image, expected the same scene, size, "
                    "camera, seed and options");
    std::vector<SampleRange> all = sums.ranges;
    all.push_back(range_);
    (void)joined(std::move(all));
    if (!continues) sums.words.assign(words(), 0);
    meta_.ranges = continues ? std::move(sums.ranges) : std::vector<SampleRange>{};
    meta_.backends = continues ? std::move(sums.backends) : std::set<std::string>{};
    sums_ = upload<kinds::FilmSums>(executor_, sums.words, "film");
}

void ExactFilm::clear() {
    meta_.ranges.clear();
    next_ = range_.first;
    write_buffer(executor_, sums_, std::vector<std::uint32_t>(words(), 0));
}

void ExactFilm::fit(const FlatScene& scene) {
    meta_.light_exponent = light_exponent(scene);
    meta_.depth_unit = scene.units.scale;
}

void ExactFilm::add(std::uint32_t count) {
    meta_.backends.insert(executor_.device().backend);
    std::vector<SampleRange> ranges = meta_.ranges;
    ranges.push_back({next_, next_ + count});
    meta_.ranges = joined(std::move(ranges));
    next_ += count;
}

float ExactFilm::scale() const noexcept {
    return std::ldexp(1.0F, -meta_.light_exponent);
}

double ExactFilm::unit() const noexcept {
    return std::ldexp(1.0, meta_.light_exponent);
}

FilmSums ExactFilm::read(const std::string& identity) {
    FilmSums sums = meta_;
    sums.identity = identity;
    sums.words = read_buffer(executor_, sums_, words());
    return sums;
}

}  // namespace weft
