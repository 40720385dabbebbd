// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf/gltf_animation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/limits.h"
#include "base/quote.h"
#include "scene/gltf/gltf_morph.h"

namespace weft {
namespace {

Interpolation read_interpolation(const JsonValue& sampler) {
    const std::optional<JsonValue> value = sampler.find("interpolation");
    if (!value || value->as_string() == "LINEAR") return Interpolation::linear;
    if (value->as_string() == "STEP") return Interpolation::step;
    if (value->as_string() == "CUBICSPLINE") return Interpolation::cubic;
    throw value->error("is " + quote(value->as_string()) +
                       ", expected LINEAR, STEP or CUBICSPLINE");
}

std::vector<float> read_times(const JsonValue& reference, const GltfAccessor& accessor) {
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

/// The kind of values that a track has.
enum class Kind : std::uint8_t { vector, rotation, weights };

/// The property that a channel animates.
struct Property {
    Kind kind = Kind::vector;
    std::uint32_t width = 3;  ///< numbers of a value
};

bool is_fit_for_values(const GltfAccessor& accessor, const Property& property) {
    if (accessor.width() != (property.kind == Kind::weights ? 1 : property.width)) return false;
    if (accessor.component() == GltfComponent::float32) return true;
    return property.kind != Kind::vector && accessor.normalized() &&
           accessor.component() != GltfComponent::uint32;
}

const char* misfit(Kind kind) {
    switch (kind) {
        case Kind::vector:
            break;
        case Kind::rotation:
            return "chooses an accessor that holds no rotations, expected VEC4 of 5126 or of "
                   "normalized integers";
        case Kind::weights:
            return "chooses an accessor that holds no weights, expected SCALAR of 5126 or of "
                   "normalized integers";
    }
    return "chooses an accessor that holds no vectors, expected VEC3 of 5126";
}

void check_quaternion(const JsonValue& reference, std::span<const float> value, std::size_t key) {
    double square = 0.0;
    for (const float x : value) square += static_cast<double>(x) * static_cast<double>(x);
    const double length = std::sqrt(square);
    if (!(std::abs(length - 1.0) < 0.1))
        throw reference.error("key " + std::to_string(key) + " is a quaternion of length " +
                              std::to_string(length) + ", expected 1");
}

std::vector<float> read_values(const JsonValue& reference, const GltfAccessor& accessor,
                               const KeyTrack& track, const Property& property) {
    if (!is_fit_for_values(accessor, property)) throw reference.error(misfit(property.kind));
    const bool cubic = track.interpolation == Interpolation::cubic;
    const std::size_t parts = cubic ? 3 : 1;
    const std::size_t elements = parts * property.width / accessor.width();
    if (accessor.count() / elements != track.keys() || accessor.count() % elements != 0)
        throw reference.error("chooses " + std::to_string(accessor.count()) + " values, expected " +
                              std::to_string(elements) + " for each of " +
                              std::to_string(track.keys()) + " keys");
    const std::size_t width = accessor.width();
    std::vector<float> values(accessor.count() * width);
    for (std::size_t i = 0; i < accessor.count(); ++i) {
        const std::span<float> value(&values[i * width], width);
        accessor.read(i, value);
        for (const float x : value)
            if (!std::isfinite(x))
                throw reference.error("value " + std::to_string(i) + " is not finite");
        const bool is_tangent = cubic && i % parts != 1;
        if (property.kind == Kind::rotation && !is_tangent)
            check_quaternion(reference, value, i / parts);
    }
    return values;
}

constexpr WarningUnit channel_unit{"animation channel", "animation channels"};

/// Reads the animations of one document, one after the other.
class AnimationReader {
  public:
    AnimationReader(const GltfDocument& document, GltfData& data, WarningCollector& report,
                    Animation& animation)
        : root_(document.root()),
          data_(data),
          report_(report),
          tracks_(animation.tracks),
          clips_(animation.clips) {}

    GltfAnimatedNodes read() {
        for (std::size_t i = 0; i < root_.size_of("animations"); ++i) {
            const JsonValue animation = root_.at("animations").element(i);
            const JsonValue channels = animation.at("channels");
            const JsonValue samplers = animation.at("samplers");
            std::map<std::size_t, Known> known;
            AnimationClip clip;
            clip.name = animation.name_or("animation " + std::to_string(i));
            clip.channels = channels.size();
            for (std::size_t c = 0; c < channels.size(); ++c)
                read_channel(channels.element(c), samplers, known, clip);
            clips_.push_back(std::move(clip));
        }
        return std::move(nodes_);
    }

  private:
    /// A track that has been read.
    struct Known {
        int track = -1;
        Property property;
    };

    /// Where the track of a channel belongs, or nothing where the channel is not played.
    int* find_target(const JsonValue& target, Property& property) {
        const JsonValue path = target.at("path");
        const std::string& name = path.as_string();
        if (name == "pointer") {
            report_.count(target.place(), channel_unit,
                          "a pointer is not animated, the value at rest is rendered instead");
            return nullptr;
        }
        if (name != "translation" && name != "rotation" && name != "scale" && name != "weights")
            throw path.error("is " + quote(name) +
                             ", expected translation, rotation, scale or weights");
        const std::optional<JsonValue> reference = target.find("node");
        if (!reference) {
            report_.count(target.place(), channel_unit, "no node is named, nothing is played");
            return nullptr;
        }
        const std::size_t index = reference->as_index(root_.size_of("nodes"), "nodes");
        const JsonValue node = root_.at("nodes").element(index);
        if (name == "weights") return find_weights(target, node, index, property);
        if (node.find("matrix"))
            throw reference->error("node " + std::to_string(index) +
                                   " has a 'matrix', expected translation, rotation and scale "
                                   "of a node that is animated");
        GltfChannels& channels = nodes_[index];
        if (name == "rotation") property = {Kind::rotation, 4};
        if (name == "translation") return &channels.translation;
        return name == "rotation" ? &channels.rotation : &channels.scale;
    }

    int* find_weights(const JsonValue& target, const JsonValue& node, std::size_t index,
                      Property& property) {
        const std::optional<JsonValue> mesh = node.find("mesh");
        const std::size_t meshes = root_.size_of("meshes");
        const std::size_t targets =
            mesh ? count_gltf_targets(root_.at("meshes").element(mesh->as_index(meshes, "meshes")))
                 : 0;
        if (targets == 0) {
            report_.count(target.place(), channel_unit,
                          "the node has no morph targets whose weights could be played");
            return nullptr;
        }
        property = {Kind::weights, static_cast<std::uint32_t>(targets)};
        return &nodes_[index].weights;
    }

    void read_channel(const JsonValue& channel, const JsonValue& samplers,
                      std::map<std::size_t, Known>& known, AnimationClip& clip) {
        const JsonValue reference = channel.at("sampler");
        const std::size_t sampler = reference.as_index(samplers.size(), "samplers");
        const JsonValue target = channel.at("target");
        Property property;
        int* const slot = find_target(target, property);
        if (slot == nullptr) return;
        const auto [entry, is_new] = known.try_emplace(sampler);
        Known& track = entry->second;
        if (is_new) track = {read_track(samplers.element(sampler), property), property};
        if (track.property.kind != property.kind || track.property.width != property.width)
            throw reference.error("sampler " + std::to_string(sampler) +
                                  " has values for another kind of property as well");
        const KeyTrack& keys = tracks_[static_cast<std::size_t>(track.track)];
        clip.duration = std::max(clip.duration, static_cast<double>(keys.times.back()));
        clip.channels_played += *slot < 0 ? 1 : 0;
        if (*slot < 0)
            *slot = track.track;
        else
            report_.count(target.place(), channel_unit,
                          "an earlier channel moves the same property, not played");
    }

    int read_track(const JsonValue& sampler, const Property& property) {
        KeyTrack track;
        track.interpolation = read_interpolation(sampler);
        track.width = property.width;
        const JsonValue input = sampler.at("input");
        const GltfAccessor& times = data_.accessor(input);
        // Every weight is counted, or one large accessor could be copied by many samplers.
        const std::size_t values = property.kind == Kind::weights ? property.width : 1;
        if (times.count() > (limits::max_animation_keys - keys_) / values)
            throw input.error("brings the file above the limit of " +
                              std::to_string(limits::max_animation_keys) + " animation keys");
        keys_ += times.count() * values;
        track.times = read_times(input, times);
        const JsonValue output = sampler.at("output");
        track.values = read_values(output, data_.accessor(output), track, property);
        tracks_.push_back(std::move(track));
        return static_cast<int>(tracks_.size() - 1);
    }

    JsonValue root_;
    GltfData& data_;
    WarningCollector& report_;
    std::vector<KeyTrack>& tracks_;
    std::vector<AnimationClip>& clips_;
    GltfAnimatedNodes nodes_;
    std::size_t keys_ = 0;
};

}  // namespace

GltfAnimatedNodes read_gltf_animations(const GltfDocument& document, GltfData& data,
                                       WarningCollector& report, Animation& animation) {
    return AnimationReader(document, data, report, animation).read();
}

}  // namespace weft
