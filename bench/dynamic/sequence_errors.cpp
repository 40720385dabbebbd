// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/dynamic/sequence_errors.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "metrics/flicker.h"
#include "metrics/hdr_vdp.h"
#include "metrics/rgb_view.h"

namespace weft::bench {
namespace {

constexpr double display_scale = 100.0;  // cd/m^2 of the value 1
constexpr float surely_seen = 0.75F;

std::vector<float> luminance_of(const Image& image) {
    return luminance(RgbView{image.find("")->values, image.width, image.height});
}

/// By pixel, the probability that its change is seen. What one image shows is brought to where
/// the other shows it, so that the camera's own movement is no change.
std::vector<float> visible_change(const Image& before, const Image& now,
                                  const std::vector<std::uint32_t>& matches) {
    const std::vector<float> then = luminance_of(before);
    const std::vector<float> test = luminance_of(now);
    std::vector<float> expected = test;
    for (std::size_t pixel = 0; pixel < matches.size(); ++pixel)
        if (matches[pixel] != no_pixel) expected[pixel] = then[matches[pixel]];
    HdrVdpSettings settings;
    settings.luminance_scale = display_scale;
    return hdr_vdp(test, expected, now.width, now.height, settings).probability;
}

}  // namespace

nlohmann::json FrameErrors::json() const {
    nlohmann::json json{{"converged", converged.json()}, {"same_vpls", same_vpls.json()}};
    if (!flicker) return json;
    json["flicker"] = {{"change", flicker->change}, {"unsteady", flicker->unsteady}};
    if (flicker->seen) json["flicker"]["seen"] = *flicker->seen;
    return json;
}

void SequenceJudge::next(ReferenceFrame reference, const Camera& camera, bool visible) {
    follows_ = !now_.converged.layers.empty();
    before_ = std::exchange(now_, std::move(reference));
    camera_before_ = std::exchange(camera_, camera);
    visible_ = visible;
    if (!follows_) return;
    matches_ = matching_pixels({before_.converged, camera_before_}, {now_.converged, camera_});
    if (visible_) reference_change_ = visible_change(before_.converged, now_.converged, matches_);
}

FrameErrors SequenceJudge::judge(const Image* before, const Image& now) const {
    FrameErrors errors;
    errors.converged = image_errors(now_.converged, now, "", {visible_, false});
    errors.same_vpls = image_errors(now_.same_vpls, now, "", {false, false});
    if (before != nullptr && follows_) errors.flicker = flicker(*before, now);
    return errors;
}

Flicker SequenceJudge::flicker(const Image& before, const Image& now) const {
    const std::vector<float> excess =
        excess_change(before, now, before_.converged, now_.converged, matches_, display_scale);
    std::vector<float> seen;
    if (visible_) seen = visible_change(before, now, matches_);
    double sum = 0.0;
    double unsteady = 0.0;
    double visible = 0.0;
    double count = 0.0;
    for (std::size_t pixel = 0; pixel < matches_.size(); ++pixel) {
        if (matches_[pixel] == no_pixel) continue;
        ++count;
        sum += static_cast<double>(excess[pixel]);
        unsteady += excess[pixel] > 1.0F ? 1.0 : 0.0;
        if (visible_ && seen[pixel] >= surely_seen && reference_change_[pixel] < surely_seen)
            ++visible;
    }
    Flicker flicker;
    if (!(count > 0.0)) return flicker;
    flicker.change = sum / count;
    flicker.unsteady = 100.0 * unsteady / count;
    if (visible_) flicker.seen = 100.0 * visible / count;
    return flicker;
}

}  // namespace weft::bench
