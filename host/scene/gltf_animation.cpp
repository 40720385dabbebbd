// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_animation.h"

#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/limits.h"
#include "base/quote.h"

namespace weft {
namespace {

Interpolation read_interpolation(const GltfValue& sampler) {
    const std::optional<GltfValue> value = sampler.find("interpolation");
    if (!value || value->as_string() == "LINEAR") return Interpolation::linear;
    if (value->as_string() == "STEP") return Interpolation::step;
    if (value->as_string() == "CUBICSPLINE") return Interpolation::cubic;
    throw value->error("is " + quote(value->as_string()) +
                       ", expected LINEAR, STEP or CUBICSPLINE");
}

std::vector<float> read_times(const GltfValue& reference, const GltfAccessor& accessor) {
    if (accessor.width() != 1 || accessor.component() != GltfComponent::float32)
        throw reference.error("chooses an accessor that holds no times, expected SCALAR of 5126");
    std::vector<float> times(accessor.count());
    for (std::size_t i = 0; i < times.size(); ++i) {
        accessor.read(i, std::span(&times[i], 1));
        const auto fail = [&](const char* flaw) {
            return reference.error("time of key " + std::to_string(i) + flaw);
        };
        if (!std::isfinite(times[i]) || times[i] < 0.0F)
            throw fail(" is negative or not finite, expected seconds from 0 on");
        if (i > 0 && times[i] <= times[i - 1])
            throw fail(" does not increase, expected strictly increasing times");
    }
    return times;
}

bool is_fit_for_values(const GltfAccessor& accessor, std::uint32_t width) {
    if (accessor.width() != width) return false;
    if (accessor.component() == GltfComponent::float32) return true;
    return width == 4 && accessor.normalized() && accessor.component() != GltfComponent::uint32;
}

void check_quaternion(const GltfValue& reference, std::span<const float> value, std::size_t key) {
    double square = 0.0;
    for (const float x : value) square += static_cast<double>(x) * static_cast<double>(x);
    const double length = std::sqrt(square);
    if (!(std::abs(length - 1.0) < 0.1))
        throw reference.error("key " + std::to_string(key) + " is a quaternion of length " +
                              std::to_string(length) + ", expected 1");
}

std::vector<float> read_values(const GltfValue& reference, const GltfAccessor& accessor,
                               const KeyTrack& track) {
    const std::uint32_t width = track.width;
    if (!is_fit_for_values(accessor, width))
        throw reference.error(width == 4
                                  ? "chooses an accessor that holds no rotations, expected VEC4 of "
                                    "5126 or of normalized integers"
                                  : "chooses an accessor that holds no vectors, expected VEC3 of "
                                    "5126");
    const bool cubic = track.interpolation == Interpolation::cubic;
    const std::size_t parts = cubic ? 3 : 1;
    if (accessor.count() / parts != track.keys() || accessor.count() % parts != 0)
        throw reference.error("chooses " + std::to_string(accessor.count()) + " values, expected " +
                              std::to_string(parts) + " for each of " +
                              std::to_string(track.keys()) + " keys");
    std::vector<float> values(accessor.count() * width);
    for (std::size_t i = 0; i < accessor.count(); ++i) {
        const std::span<float> value(&values[i * width], width);
        accessor.read(i, value);
        for (const float x : value)
            if (!std::isfinite(x))
                throw reference.error("value " + std::to_string(i) + " is not finite");
        const bool is_tangent = cubic && i % parts != 1;
        if (width == 4 && !is_tangent) check_quaternion(reference, value, i / parts);
    }
    return values;
}

/// Reads the animations of one document, one after the other.
class AnimationReader {
  public:
    AnimationReader(const GltfDocument& document, GltfData& data, GltfReport& report,
                    std::vector<KeyTrack>& tracks)
        : root_(document.root()), data_(data), report_(report), tracks_(tracks) {}

    GltfAnimatedNodes read() {
        for (std::size_t i = 0; i < root_.size_of("animations"); ++i) {
            const GltfValue animation = root_.at("animations").element(i);
            const GltfValue channels = animation.at("channels");
            const GltfValue samplers = animation.at("samplers");
            std::map<std::size_t, int> known;
            for (std::size_t c = 0; c < channels.size(); ++c)
                read_channel(channels.element(c), samplers, known);
        }
        return std::move(nodes_);
    }

  private:
    /// Where the track of a channel belongs, or nothing where the channel is not played.
    int* find_target(const GltfValue& target, std::uint32_t& width) {
        const GltfValue path = target.at("path");
        const std::string& name = path.as_string();
        if (name == "weights" || name == "pointer") {
            report_.once(target.place(), "an animation of " + name +
                                             " is not played, the value at rest is rendered "
                                             "instead");
            return nullptr;
        }
        if (name != "translation" && name != "rotation" && name != "scale")
            throw path.error("is " + quote(name) +
                             ", expected translation, rotation, scale or weights");
        const std::optional<GltfValue> reference = target.find("node");
        if (!reference) {
            report_.once(target.place(), "a channel without a node is not played");
            return nullptr;
        }
        const std::size_t node = reference->as_index(root_.size_of("nodes"), "nodes");
        if (root_.at("nodes").element(node).find("matrix"))
            throw reference->error("node " + std::to_string(node) +
                                   " has a 'matrix', expected translation, rotation and scale "
                                   "of a node that is animated");
        GltfChannels& channels = nodes_[node];
        width = name == "rotation" ? 4 : 3;
        if (name == "translation") return &channels.translation;
        return name == "rotation" ? &channels.rotation : &channels.scale;
    }

    void read_channel(const GltfValue& channel, const GltfValue& samplers,
                      std::map<std::size_t, int>& known) {
        const GltfValue reference = channel.at("sampler");
        const std::size_t sampler = reference.as_index(samplers.size(), "samplers");
        const GltfValue target = channel.at("target");
        std::uint32_t width = 3;
        int* const slot = find_target(target, width);
        if (slot == nullptr) return;
        const auto [entry, is_new] = known.try_emplace(sampler, 0);
        if (is_new) entry->second = read_track(samplers.element(sampler), width);
        const KeyTrack& track = tracks_[static_cast<std::size_t>(entry->second)];
        if (track.width != width)
            throw reference.error("sampler " + std::to_string(sampler) +
                                  " has values for another kind of property as well");
        if (*slot < 0)
            *slot = entry->second;
        else
            report_.once(target.place(),
                         "a property of a node is animated twice, the later channel is ignored");
    }

    int read_track(const GltfValue& sampler, std::uint32_t width) {
        KeyTrack track;
        track.interpolation = read_interpolation(sampler);
        track.width = width;
        const GltfValue input = sampler.at("input");
        const GltfAccessor& times = data_.accessor(input);
        if (times.count() > limits::max_animation_keys - keys_)
            throw input.error("brings the file above the limit of " +
                              std::to_string(limits::max_animation_keys) + " animation keys");
        keys_ += times.count();
        track.times = read_times(input, times);
        const GltfValue output = sampler.at("output");
        track.values = read_values(output, data_.accessor(output), track);
        tracks_.push_back(std::move(track));
        return static_cast<int>(tracks_.size() - 1);
    }

    GltfValue root_;
    GltfData& data_;
    GltfReport& report_;
    std::vector<KeyTrack>& tracks_;
    GltfAnimatedNodes nodes_;
    std::size_t keys_ = 0;
};

}  // namespace

GltfAnimatedNodes read_gltf_animations(const GltfDocument& document, GltfData& data,
                                       GltfReport& report, std::vector<KeyTrack>& tracks) {
    return AnimationReader(document, data, report, tracks).read();
}

}  // namespace weft
