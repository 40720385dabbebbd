// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "scene/area_light_bounds.h"
#include "scene/flat_scene.h"
#include "scene/light_tree.h"

namespace weft {
namespace {

constexpr double pi = std::numbers::pi;

/// Turns weights into probabilities and inclusive sums whose float differences are consistent. An
/// entry too faint for a float keeps the probability 0 and is never chosen.
template <class Entry>
void normalise(std::span<Entry> entries, std::span<const double> weights, float Entry::*cumulative,
               float Entry::*probability) {
    double total = 0.0;
    for (const double weight : weights) total += weight;
    double sum = 0.0;
    float before = 0.0F;
    for (std::size_t i = 0; i < entries.size(); ++i) {
        sum += weights[i];
        entries[i].*cumulative =
            i + 1 == entries.size() ? 1.0F : static_cast<float>(std::min(1.0, sum / total));
        entries[i].*probability = entries[i].*cumulative - before;
        before = entries[i].*cumulative;
    }
}

shared::float4 rgb(const glm::vec3& c, double scale) {
    const glm::vec3 s(glm::dvec3(c) * scale);
    return {s.r, s.g, s.b, 0.0F};
}

/// The triangles of an area light, and what they come to.
struct Emitter {
    std::vector<shared::EmissiveTriangle> entries{};  ///< none where nothing shines
    AreaLightBounds bounds{};
    double area = 0.0;   ///< kernel units squared
    double light = 0.0;  ///< luminance times area
    bool textured = false;
};

void set_probabilities(Emitter& emitter, std::span<const double> weights) {
    normalise<shared::EmissiveTriangle>(emitter.entries, weights,
                                        &shared::EmissiveTriangle::cumulative,
                                        &shared::EmissiveTriangle::probability);
}

/// Triangles of the same radiance, by area.
Emitter plain_emitter(const FlatScene& flat, const InstanceRange& range,
                      const glm::vec3& radiance) {
    Emitter emitter;
    std::vector<double> areas;
    for (std::uint32_t i = 0; i < range.triangles; ++i) {
        const std::uint32_t t = range.first_triangle + i;
        const double area = triangle_area(flat, flat.triangles[t]);
        if (!(area > 0.0)) continue;
        emitter.entries.push_back({t, 0.0F, 0.0F, 0.0F});
        areas.push_back(area);
        emitter.area += area;
    }
    if (emitter.entries.empty()) return emitter;
    set_probabilities(emitter, areas);
    for (shared::EmissiveTriangle& entry : emitter.entries)
        entry.density = static_cast<float>(1.0 / emitter.area);
    emitter.bounds = area_light_bounds(flat, emitter.entries);
    emitter.light = luminance(radiance) * emitter.area;
    return emitter;
}

/// Triangles whose mean radiance is `radiance` times their means, by area times that. The area that
/// stands for them is the one that would send as much light, were it spread as evenly as the square
/// of the radiance tells: all of the area where the radiance is the same, and what shines where
/// some of it is dark.
Emitter textured_emitter(const FlatScene& flat, const InstanceRange& range,
                         const std::vector<glm::vec3>& means, const glm::vec3& radiance) {
    Emitter emitter;
    emitter.textured = true;
    // A light that is switched off keeps its samples.
    const glm::vec3 tint = luminance(radiance) > 0.0 ? radiance : glm::vec3(1.0F);
    std::vector<double> weights;
    std::vector<shared::EmissiveTriangle> shining;
    double sum = 0.0;
    double squares = 0.0;
    for (std::uint32_t i = 0; i < range.triangles; ++i) {
        const std::uint32_t t = range.first_triangle + i;
        const double area = triangle_area(flat, flat.triangles[t]);
        const double mean = luminance(tint * means[i]);
        emitter.entries.push_back({t, 0.0F, 0.0F, 0.0F});
        weights.push_back(area * mean);
        sum += area * mean;
        squares += area * mean * mean;
        if (area * mean > 0.0) shining.push_back(emitter.entries.back());
        emitter.light += area * luminance(radiance * means[i]);
    }
    if (!(sum > 0.0) || !std::isfinite(sum)) return {};
    set_probabilities(emitter, weights);
    for (std::size_t i = 0; i < emitter.entries.size(); ++i) {
        shared::EmissiveTriangle& entry = emitter.entries[i];
        const double area = triangle_area(flat, flat.triangles[entry.triangle]);
        if (area > 0.0)
            entry.density = static_cast<float>(static_cast<double>(entry.probability) / area);
    }
    emitter.area = sum * (sum / squares);
    // Its light is not the same all over, so that no closed form holds.
    emitter.bounds.ball = area_light_bounds(flat, shining).ball;
    return emitter;
}

Emitter emitter_of(const FlatScene& flat, std::uint32_t instance, const glm::vec3& radiance) {
    const InstanceRange& range = flat.ranges[instance];
    const bool textured = !flat.emission_means.empty() && !flat.emission_means[instance].empty();
    return textured ? textured_emitter(flat, range, flat.emission_means[instance], radiance)
                    : plain_emitter(flat, range, radiance);
}

/// Collects lights and their powers (luminance of the flux in kernel units).
struct Collector {
    const Scene& scene;
    FlatScene& flat;
    std::vector<shared::LightRecord> lights{};
    std::vector<double> powers{};

    /// Adds light number `source` of all that may emit. Returns its index, or INVALID_INDEX where
    /// it is too dark or bright to be chosen.
    std::uint32_t add(const shared::LightRecord& light, double power, std::size_t source) {
        double& at_first = flat.first_powers[source];
        if (!(at_first > 0.0) && power > 0.0 && std::isfinite(power)) at_first = power;
        if (!(at_first > 0.0)) return INVALID_INDEX;
        lights.push_back(light);
        powers.push_back(at_first);
        return static_cast<std::uint32_t>(lights.size() - 1);
    }

    /// Whether a light has ever emitted: it keeps its place in the table when it is switched off.
    [[nodiscard]] bool has_shone(std::size_t source) const {
        return flat.first_powers[source] > 0.0;
    }

    void add_area_light(std::uint32_t instance) {
        const Material& material = scene.materials[flat.instances[instance].material];
        if (!(luminance(material.emission.radiance) > 0.0) && !has_shone(instance)) return;
        const Emitter emitter = emitter_of(flat, instance, material.emission.radiance);
        if (emitter.entries.empty()) return;
        shared::LightRecord light{};
        light.kind = EMITTER_AREA;
        light.position = emitter.bounds.ball;
        light.axis = emitter.bounds.normal;
        light.power = rgb(material.emission.radiance, 1.0);
        light.first = static_cast<std::uint32_t>(flat.emissive.size());
        light.count = static_cast<std::uint32_t>(emitter.entries.size());
        light.area = static_cast<float>(emitter.area);
        light.both_sides = material.emission.both_sides ? 1 : 0;
        light.textured = emitter.textured ? 1 : 0;
        flat.emissive.insert(flat.emissive.end(), emitter.entries.begin(), emitter.entries.end());
        if (flat.area_lights == 0 || emitter.area < flat.smallest_light_area)
            flat.smallest_light_area = emitter.area;
        ++flat.area_lights;
        flat.instances[instance].light =
            add(light, pi * emitter.light * (light.both_sides != 0 ? 2.0 : 1.0), instance);
    }

    void add_environment(const Environment& source, std::size_t number) {
        const FlatEnvironment& image = flat.environment_image;
        const glm::dvec3 mean =
            glm::dvec3(source.radiance) * (image.present() ? image.mean : glm::dvec3(1.0));
        const double radiance = luminance(glm::vec3(mean));
        if (!(radiance > 0.0)) return;
        shared::LightRecord light{};
        light.kind = EMITTER_ENVIRONMENT;
        light.axis = {0.0F, 0.0F, 1.0F, 0.0F};
        if (image.present()) light.axis = rgb(glm::vec3(image.trend), 1.0);
        light.power = rgb(source.radiance, 1.0);
        if (add(light,
                radiance * 4.0 * pi * pi * static_cast<double>(flat.radius) *
                    static_cast<double>(flat.radius),
                number) == INVALID_INDEX &&
            image.present())
            return;
        flat.environment = source.radiance;
        flat.features |= FEATURE_ENVIRONMENT | (image.present() ? FEATURE_IMAGE_ENVIRONMENT : 0U);
    }

    void add_punctual(const PunctualLight& source, std::size_t number) {
        shared::LightRecord light{};
        const glm::vec3 p(flat.units.point(source.position));
        const glm::vec3 axis(source.direction);
        light.position = {p.x, p.y, p.z, 0.0F};
        light.axis = {axis.x, axis.y, axis.z, 0.0F};
        light.cos_inner = source.cos_inner;
        light.cos_outer = source.cos_outer;
        if (source.type == LightType::directional) {
            light.kind = EMITTER_DIRECTIONAL;
            light.power = rgb(source.intensity, 1.0);
            ++flat.directional_lights;
            add(light,
                luminance(source.intensity) * pi * static_cast<double>(flat.radius) *
                    static_cast<double>(flat.radius),
                number);
            return;
        }
        const double square = flat.units.scale * flat.units.scale;
        const bool spot = source.type == LightType::spot;
        light.kind = spot ? EMITTER_SPOT : EMITTER_POINT;
        if (!spot) light.axis = {0.0F, 0.0F, 1.0F, 0.0F};
        if (spot && source.linear_edge) {
            const double outer = std::acos(static_cast<double>(source.cos_outer));
            const double width = outer - std::acos(static_cast<double>(source.cos_inner));
            light.axis.w = static_cast<float>(outer);
            // At least what rounding leaves of an angle: an edge without width is sharp.
            light.position.w = std::max(static_cast<float>(width), 0x1p-20F);
        }
        light.power = rgb(source.intensity, square);
        flat.extent = std::max({flat.extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
        ++flat.punctual_lights;
        const double angle =
            spot ? 2.0 * pi * (1.0 - static_cast<double>(source.cos_outer)) : 4 * pi;
        add(light, luminance(source.intensity) * square * angle, number);
    }
};

/// Weights with which path tracing chooses one light for a place in a medium, half by power and
/// half uniformly: a light that is faint beside a sun may be the only one in a room.
std::vector<double> choice_weights(std::span<const double> powers) {
    double total = 0.0;
    for (const double power : powers) total += power;
    std::vector<double> weights;
    for (const double power : powers)
        weights.push_back(0.5 * power / total + 0.5 / static_cast<double>(powers.size()));
    return weights;
}

/// How bright the lights are that paths choose from, by their powers; see build_light_tree.
std::vector<double> intensities(const FlatScene& flat, std::span<const double> powers) {
    const std::span<const shared::LightRecord> lights = flat.lights;
    std::vector<double> result;
    for (std::size_t i = 0; i < powers.size(); ++i) {
        double angle = pi;
        switch (lights[i].kind) {
            case EMITTER_AREA:
                angle *= lights[i].both_sides != 0 ? 2.0 : 1.0;
                break;
            case EMITTER_POINT:
                angle *= 4.0;
                break;
            case EMITTER_SPOT:
                angle *= 2.0 * (1.0 - static_cast<double>(lights[i].cos_outer));
                break;
            case EMITTER_ENVIRONMENT:  // the mean over all normals
                angle *= 4.0 * static_cast<double>(flat.radius) * static_cast<double>(flat.radius);
                break;
            default:
                angle *= static_cast<double>(flat.radius) * static_cast<double>(flat.radius);
                break;
        }
        result.push_back(powers[i] / angle);
    }
    return result;
}

/// Adds the lights without area, either those at infinity (`directional`) or the others.
void add_punctual_lights(Collector& collector, bool directional) {
    const Scene& scene = collector.scene;
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const PunctualLight& light = scene.lights[i];
        const std::size_t source = scene.instances.size() + i;
        if ((light.type == LightType::directional) == directional &&
            (luminance(light.intensity) > 0.0 || collector.has_shone(source)))
            collector.add_punctual(light, source);
    }
}

}  // namespace

std::uint32_t choice_lights(const FlatScene& flat) {
    return flat.area_lights + flat.punctual_lights + flat.directional_lights +
           ((flat.features & FEATURE_IMAGE_ENVIRONMENT) != 0 ? 1U : 0U);
}

void build_light_table(const Scene& scene, FlatScene& flat) {
    const std::size_t environment = scene.instances.size() + scene.lights.size();
    flat.first_powers.resize(environment + 1, 0.0);
    Collector collector{scene, flat};
    for (std::uint32_t i = 0; i < flat.instances.size(); ++i) collector.add_area_light(i);
    add_punctual_lights(collector, false);
    add_punctual_lights(collector, true);
    if (scene.environment) collector.add_environment(*scene.environment, environment);
    flat.lights = std::move(collector.lights);
    using Light = shared::LightRecord;
    normalise<Light>(flat.lights, collector.powers, &Light::cumulative, &Light::probability);
    const auto count = [&](auto... kinds) {
        return static_cast<std::uint32_t>(std::count_if(
            flat.lights.begin(), flat.lights.end(),
            [&](const shared::LightRecord& l) { return ((l.kind == kinds) || ...); }));
    };
    flat.area_lights = count(EMITTER_AREA);
    // Area lights have probabilities of their own, since beside a sun those of a room would be too
    // faint in the table of all lights.
    normalise<Light>(std::span(flat.lights).first(flat.area_lights),
                     std::span(collector.powers).first(flat.area_lights), &Light::area_cumulative,
                     &Light::area_probability);
    flat.punctual_lights = count(EMITTER_POINT, EMITTER_SPOT);
    flat.directional_lights = count(EMITTER_DIRECTIONAL);
    const std::size_t near = choice_lights(flat);
    normalise<Light>(std::span(flat.lights).first(near),
                     choice_weights(std::span(collector.powers).first(near)),
                     &Light::choice_cumulative, &Light::choice_probability);
    flat.light_nodes.clear();
    if (near > 1)
        flat.light_nodes =
            build_light_tree(std::span(flat.lights).first(near),
                             intensities(flat, std::span(collector.powers).first(near)));
    flat.features |= (near > 1 ? FEATURE_LIGHT_TREE : 0U) |
                     (flat.area_lights > 0 ? FEATURE_AREA_LIGHTS : 0U) |
                     (flat.punctual_lights > 0 ? FEATURE_PUNCTUAL_LIGHTS : 0U) |
                     (flat.directional_lights > 0 ? FEATURE_DIRECTIONAL_LIGHTS : 0U);
}

}  // namespace weft
