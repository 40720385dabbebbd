// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_surfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <variant>

#include "base/error.h"
#include "scene/flat_scene.h"
#include "scene/mean_albedo.h"
#include "scene/shown_parts.h"
#include "scene/surface_lobes.h"

namespace weft {
namespace {

shared::float4 packed(const glm::vec3& v, float w) {
    return {v.x, v.y, v.z, w};
}

std::uint32_t channel_number(Channel channel) {
    switch (channel) {
        case Channel::rgb:
            return CHANNEL_COLOUR;
        case Channel::red:
            return CHANNEL_RED;
        case Channel::green:
            return CHANNEL_GREEN;
        case Channel::blue:
            return CHANNEL_BLUE;
        case Channel::alpha:
            return CHANNEL_ALPHA;
        case Channel::luminance:
            return CHANNEL_LUMINANCE;
    }
    return CHANNEL_COLOUR;
}

std::uint32_t scale_number(RoughnessScale scale) {
    switch (scale) {
        case RoughnessScale::roughness:
            return ROUGHNESS_SQUARED;
        case RoughnessScale::glossiness:
            return ROUGHNESS_GLOSS;
        case RoughnessScale::alpha:
            return ROUGHNESS_ALPHA;
        case RoughnessScale::exponent:
            return ROUGHNESS_EXPONENT;
    }
    return ROUGHNESS_SQUARED;
}

std::uint32_t flags_of(const Microfacets& facets) {
    return (facets.distribution == MicrofacetDistribution::beckmann ? SURFACE_BECKMANN : 0U) |
           (facets.separable ? SURFACE_SEPARABLE : 0U) |
           (facets.single_scatter ? SURFACE_SINGLE_SCATTER : 0U);
}

/// Makes the record of a material.
class RecordBuilder {
  public:
    explicit RecordBuilder(std::vector<shared::SurfaceMap>& maps) : maps_(maps) {
        record_.specular = {0.0F, 0.0F, 0.0F, 0.0F};
        record_.base = {1.0F, 1.0F, 1.0F, 0.0F};
        record_.roughness_u = 1.0F;
        record_.roughness_v = -1.0F;
        record_.normal_scale = 1.0F;
        record_.coat_normal_scale = 1.0F;
        record_.table = INVALID_INDEX;
        set_index(1.0, 1.0);
    }

    shared::SurfaceRecord build(const SurfaceDescription& surface) {
        std::visit(*this, surface.model);
        add_normal_map(surface.normal_map);
        const Opacity& opacity = surface.opacity;
        record_.alpha = opacity.alpha.factor;
        record_.cutoff = opacity.cutoff;
        if (opacity.mode == OpacityMode::mask) record_.flags |= SURFACE_MASK;
        if (opacity.mode == OpacityMode::blend) record_.flags |= SURFACE_BLEND;
        if (opacity.mode != OpacityMode::opaque) add(MAP_ALPHA, opacity.alpha.map);
        record_.first_map = static_cast<std::uint32_t>(maps_.size());
        // In the order of the bits.
        std::sort(found_.begin(), found_.end(),
                  [](const auto& a, const auto& b) { return a.first < b.first; });
        for (const auto& [bit, map] : found_) {
            record_.maps |= bit;
            shared::SurfaceMap flat{};
            flat.to_s = row(map.to_uv, 0);
            flat.to_t = row(map.to_uv, 1);
            flat.texture = static_cast<std::uint32_t>(map.texture);
            flat.uv_set = map.uv_set;
            flat.channel = channel_number(map.channel);
            maps_.push_back(flat);
        }
        return record_;
    }

    void operator()(const LambertSurface& s) { set_base(s.colour); }
    void operator()(const UnlitSurface& s) {
        record_.model = SURFACE_UNLIT;
        set_base(s.colour);
    }
    void operator()(const MetallicSurface& s) {
        set_base(s.base_colour);
        record_.base.w = s.metallic.factor;
        add(MAP_METALLIC, s.metallic.map);
        set_roughness(s.roughness);
        record_.anisotropy = s.anisotropy.strength;
        record_.rotation = s.anisotropy.rotation;
        add(MAP_ANISOTROPY, s.anisotropy.map);
        const auto ior = static_cast<double>(s.ior);
        const double root = (ior - 1.0) / (ior + 1.0);
        const auto f0 = static_cast<float>(root * root);
        record_.specular = packed(s.specular_colour.factor * f0, s.specular.factor);
        add(MAP_SPECULAR, s.specular.map);
        add(MAP_SPECULAR_COLOUR, s.specular_colour.map);
        record_.transmission = s.transmission.factor;
        add(MAP_TRANSMISSION, s.transmission.map);
        record_.flags |=
            (s.solid ? 0U : SURFACE_THIN) | (s.transmission_by_root ? SURFACE_ROOT_TINT : 0U);
        set_index(std::max(ior, 1.0), 1.0);
        record_.coat = s.clearcoat.factor.factor;
        record_.coat_roughness = s.clearcoat.roughness.value.factor;
        record_.coat_normal_scale = s.clearcoat.normal_map.scale;
        add(MAP_COAT, s.clearcoat.factor.map);
        add(MAP_COAT_ROUGHNESS, s.clearcoat.roughness.value.map);
        add(MAP_COAT_NORMAL, s.clearcoat.normal_map.map);
    }
    void operator()(const SpecularSurface& s) {
        set_base(s.diffuse);
        record_.specular = packed(s.specular.factor, 1.0F);
        add(MAP_SPECULAR_COLOUR, s.specular.map);
        set_roughness(s.roughness);
        if (s.diffuse_is_scaled) record_.flags |= SURFACE_SPECULAR_SCALES;
    }
    void operator()(const ConductorSurface& s) {
        set_base(s.reflectance);
        record_.base.w = 1.0F;
        record_.eta = packed(s.eta, 0.0F);
        record_.k = packed(s.k, 0.0F);
        record_.flags |= SURFACE_CONDUCTOR | flags_of(s.microfacets);
        set_roughness(s.roughness_u, s.roughness_v);
    }
    void operator()(const DielectricSurface& s) {
        set_base(s.transmittance);
        record_.transmission = 1.0F;
        set_index(s.ior_inside, s.ior_outside);
        record_.specular = packed(s.reflectance.factor, 1.0F);
        add(MAP_SPECULAR_COLOUR, s.reflectance.map);
        record_.flags |= SURFACE_EXACT_FRESNEL | (s.thin ? SURFACE_THIN : 0U) |
                         (s.local_index ? SURFACE_LOCAL_INDEX : 0U) | flags_of(s.microfacets);
        set_roughness(s.roughness_u, s.roughness_v);
    }
    void operator()(const PlasticSurface& s) {
        record_.model = SURFACE_PLASTIC;
        set_base(s.diffuse);
        set_index(s.ior_inside, s.ior_outside);
        record_.specular = packed(s.specular.factor, 1.0F);
        add(MAP_SPECULAR_COLOUR, s.specular.map);
        set_roughness(s.roughness);
        record_.flags |= (s.nonlinear ? SURFACE_NONLINEAR : 0U) | flags_of(s.microfacets);
        const float mirror = (s.specular.factor.r + s.specular.factor.g + s.specular.factor.b);
        const float body = (s.diffuse.factor.r + s.diffuse.factor.g + s.diffuse.factor.b);
        record_.weight = mirror + body > 0.0F ? mirror / (mirror + body) : 0.0F;
        const double x = s.ior_outside / s.ior_inside;
        record_.inner = static_cast<float>(-1.4399 * x * x + 0.7099 * x + 0.6681 + 0.0636 / x);
    }

  private:
    static shared::float4 row(const glm::dmat3& m, int i) {
        return {static_cast<float>(m[0][i]), static_cast<float>(m[1][i]),
                static_cast<float>(m[2][i]), 0.0F};
    }

    void add(std::uint32_t bit, const TextureMap& map) {
        if (map.present()) found_.emplace_back(bit, map);
    }
    void add_normal_map(const NormalMap& normals) {
        add(MAP_NORMAL, normals.map);
        record_.normal_scale = normals.scale;
        record_.flags |= (normals.mitsuba_frame ? SURFACE_MITSUBA_NORMALS : 0U) |
                         (normals.mitsuba_shadowing ? SURFACE_NORMAL_SHADOWING : 0U) |
                         (normals.mitsuba_flip ? SURFACE_NORMAL_FLIP : 0U);
    }
    void set_base(const ColourParameter& colour) {
        record_.base = packed(colour.factor, record_.base.w);
        add(MAP_BASE, colour.map);
    }
    void set_roughness(const Roughness& roughness) {
        record_.roughness_u = roughness.value.factor;
        record_.roughness_scale = scale_number(roughness.scale);
        add(MAP_ROUGHNESS, roughness.value.map);
    }
    void set_roughness(const Roughness& u, const Roughness& v) {
        set_roughness(u);
        if (u.value.factor == v.value.factor && u.value.map == v.value.map) return;
        record_.roughness_v = v.value.factor;
        add(MAP_ROUGHNESS_V, v.value.map);
    }
    void set_index(double inside, double outside) {
        const double eta = inside / outside;
        record_.eta = {static_cast<float>(eta), 0.0F, 0.0F, 0.0F};
        record_.k = {static_cast<float>((eta - 1.0) * (eta + 1.0)),
                     static_cast<float>((1.0 / eta - 1.0) * (1.0 / eta + 1.0)), 0.0F, 0.0F};
    }

    std::vector<shared::SurfaceMap>& maps_;
    std::vector<std::pair<std::uint32_t, TextureMap>> found_;
    shared::SurfaceRecord record_{};
};

bool scatters_by_record(const Material& material) {
    return material.description.has_value() && !is_lambertian(*material.description);
}

bool asks_for_tangents(const shared::SurfaceRecord& record) {
    return (record.maps & (MAP_NORMAL | MAP_COAT_NORMAL)) != 0 || record.roughness_v >= 0.0F ||
           record.anisotropy > 0.0F;
}

/// The index and the absorption of the inside, of a solid that transmits light.
std::optional<shared::InterfaceRecord> inside_of(const Material& material, double unit) {
    if (!scatters_by_record(material) || !transmits(*material.description)) return std::nullopt;
    shared::InterfaceRecord inside{};
    if (const auto* const s = std::get_if<DielectricSurface>(&material.description->model)) {
        if (s->thin) return std::nullopt;
        inside.index = static_cast<float>(s->ior_inside / s->ior_outside);
        inside.is_local = s->local_index ? 1 : 0;
        return inside;
    }
    const auto* const s = std::get_if<MetallicSurface>(&material.description->model);
    if (s == nullptr || !s->solid) return std::nullopt;
    const glm::vec3 sigma(sigma_a(s->absorption) / unit);
    inside.index = std::max(s->ior, 1.0F);
    inside.sigma_a = packed(sigma, 0.0F);
    return inside;
}

/// Finds out what previews follow anywhere.
void find_followed_parts(FlatSurfaces& surfaces) {
    std::uint32_t all = 0;
    for (const shared::SurfaceRecord& record : surfaces.records) all |= record.flags;
    surfaces.mirrors = (all & SURFACE_MIRRORS) != 0;
    surfaces.glossy = (all & SURFACE_GLOSSY) != 0;
    surfaces.rough_glass = (all & SURFACE_ROUGH_GLASS) != 0;
    surfaces.lets_through = (all & SURFACE_LETS_THROUGH) != 0;
}

/// What a scene's materials are before tables add to them.
struct PlainSurfaces {
    std::vector<shared::SurfaceRecord> records;
    std::vector<AlphaRange> glass;  ///< by material
    std::vector<shared::SurfaceMap> maps;
};

/// Makes records of plain ones, and the tables of albedos that they read.
void take(PlainSurfaces plain, FlatSurfaces& surfaces) {
    surfaces.records = plain.records;
    surfaces.values = surfaces.tables.add_to(surfaces.records, plain.glass);
    surfaces.plain = std::move(plain.records);
    surfaces.maps = std::move(plain.maps);
    find_followed_parts(surfaces);
}

/// What of a surface previews follow: SURFACE_MIRRORS, SURFACE_GLOSSY, SURFACE_LETS_THROUGH.
/// What is sharp is bounded by MIRROR_ALPHA of kernels/bsdf/seen_lobes.h.
std::uint32_t followed_parts(const SurfaceDescription& surface,
                             std::span<const SurfaceLobe> lobes) {
    std::uint32_t parts = 0;
    if (surface.opacity.mode == OpacityMode::blend) parts |= SURFACE_LETS_THROUGH;
    for (const SurfaceLobe& lobe : lobes) {
        if (lobe.is_diffuse) continue;
        if (lobe.transmits) {
            parts |= SURFACE_LETS_THROUGH;
            if (width_of(lobe.most_alpha) > LobeWidth::sharp) parts |= SURFACE_ROUGH_GLASS;
            continue;
        }
        if (width_of(lobe.least_alpha) <= LobeWidth::sharp) parts |= SURFACE_MIRRORS;
        if (width_of(lobe.most_alpha) > LobeWidth::sharp && !is_nearly_diffuse(lobe))
            parts |= SURFACE_GLOSSY;
    }
    return parts;
}

AlphaRange glass_alphas(std::span<const SurfaceLobe> lobes) {
    const auto glass = std::find_if(lobes.begin(), lobes.end(),
                                    [](const SurfaceLobe& lobe) { return lobe.transmits; });
    return glass != lobes.end() ? AlphaRange{glass->least_alpha, glass->most_alpha} : AlphaRange{};
}

/// The plain records of all materials, and the textures that they name. What no instance shows is
/// as good as diffuse, or kernels would follow, and tables be made for, what the scene does not
/// hold.
PlainSurfaces plain_surfaces(const Scene& scene, std::span<const TextureStatistics> textures) {
    const std::vector<bool> shown = shown_materials(scene);
    PlainSurfaces plain;
    for (std::size_t i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        shared::SurfaceRecord record{};
        record.model = SURFACE_LAMBERT;
        record.table = INVALID_INDEX;
        AlphaRange glass;
        if (shown[i] && scatters_by_record(material)) {
            const SurfaceDescription& surface = *material.description;
            const std::vector<SurfaceLobe> lobes = lobes_of(surface, textures);
            record = RecordBuilder(plain.maps).build(surface);
            record.flags |= followed_parts(surface, lobes);
            glass = glass_alphas(lobes);
        }
        plain.records.push_back(record);
        plain.glass.push_back(glass);
    }
    return plain;
}

/// Whether two records of one material have the same colours and roughness.
bool same_numbers(const shared::SurfaceRecord& a, const shared::SurfaceRecord& b) {
    return a.base.x == b.base.x && a.base.y == b.base.y && a.base.z == b.base.z &&
           a.roughness_u == b.roughness_u && a.roughness_v == b.roughness_v;
}

double volume_of(const FlatScene& flat, const InstanceRange& range) {
    const auto vertex = [&](std::uint32_t i) {
        const shared::float4& p = flat.positions[i];
        return glm::dvec3(p.x, p.y, p.z);
    };
    double volume = 0.0;
    for (std::uint32_t t = 0; t < range.triangles; ++t) {
        const shared::Triangle& triangle = flat.triangles[range.first_triangle + t];
        volume +=
            glm::dot(vertex(triangle.v0), glm::cross(vertex(triangle.v1), vertex(triangle.v2))) /
            6.0;
    }
    return std::abs(volume);
}

double area_of(const FlatScene& flat, const InstanceRange& range) {
    double area = 0.0;
    for (std::uint32_t t = 0; t < range.triangles; ++t)
        area += triangle_area(flat, flat.triangles[range.first_triangle + t]);
    return area;
}

/// Whether at least half of the light goes on through an instance, over the mean chord 4 V / S of a
/// solid that absorbs (Cauchy).
bool passes_half(const Scene& scene, const FlatScene& flat, std::size_t instance) {
    constexpr double half = 0.5;
    const Material& material = scene.materials[scene.instances[instance].material];
    auto passes = static_cast<double>(mean_transmittance(material, flat.texture_statistics));
    if (passes < half) return false;
    const auto inside = inside_of(material, flat.units.scale);
    const double area = area_of(flat, flat.ranges[instance]);
    if (!inside || !(area > 0.0)) return true;
    const double chord = 4.0 * volume_of(flat, flat.ranges[instance]) / area;
    const shared::float4& sigma = inside->sigma_a;
    passes *= luminance({std::exp(-sigma.x * static_cast<float>(chord)),
                         std::exp(-sigma.y * static_cast<float>(chord)),
                         std::exp(-sigma.z * static_cast<float>(chord))});
    return passes >= half;
}

/// Numbers the instances that are solid dielectrics, those that enclose least first.
void number_interfaces(const Scene& scene, const FlatScene& flat, FlatSurfaces& surfaces) {
    struct Solid {
        double volume;
        std::uint32_t instance;
        shared::InterfaceRecord inside;
    };
    std::vector<Solid> solids;
    for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
        const auto inside =
            inside_of(scene.materials[scene.instances[i].material], flat.units.scale);
        if (inside) solids.push_back({volume_of(flat, flat.ranges[i]), i, *inside});
    }
    std::stable_sort(solids.begin(), solids.end(),
                     [](const Solid& a, const Solid& b) { return a.volume < b.volume; });
    constexpr std::size_t most = 0xFFFF;
    if (solids.size() >= most)
        throw input_error(scene.source, "there are too many solid dielectrics, at most 65534");
    for (const Solid& solid : solids) {
        surfaces.of_instances[solid.instance * SURFACE_INSTANCE_WORDS + SURFACE_INTERFACE] =
            static_cast<std::uint32_t>(surfaces.interfaces.size());
        surfaces.interfaces.push_back(solid.inside);
    }
}

/// Appends the texture coordinates of instances, and the alphas of their vertices, those of a mesh
/// once.
void append_coordinates(const Scene& scene, const FlatScene& flat, FlatSurfaces& surfaces) {
    surfaces.of_instances.assign(scene.instances.size() * SURFACE_INSTANCE_WORDS, 0);
    std::vector<std::vector<std::uint32_t>> firsts(scene.meshes.size());
    std::map<std::size_t, std::uint32_t> alphas;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
        std::uint32_t* const words = &surfaces.of_instances[i * SURFACE_INSTANCE_WORDS];
        words[SURFACE_INTERFACE] = INVALID_INDEX;
        words[SURFACE_VERTEX_ALPHA] = INVALID_INDEX;
        words[SURFACE_BOUNDARY] = INVALID_INDEX;
        const Material& material = scene.materials[scene.instances[i].material];
        if (!scatters_by_record(material)) continue;
        const std::size_t number = scene.instances[i].mesh;
        const Mesh& mesh = scene.meshes[number];
        if (firsts[number].empty()) {
            firsts[number].assign(SURFACE_UV_SETS, 0);
            for (std::size_t set = 0; set < SURFACE_UV_SETS; ++set) {
                firsts[number][set] = static_cast<std::uint32_t>(surfaces.coordinates.size() / 2);
                const bool has = set < mesh.uv_sets.size() && !mesh.uv_sets[set].empty();
                // Without coordinates all vertices are at (0, 0); the first such set serves all.
                if (!has && set > 0 &&
                    (set - 1 >= mesh.uv_sets.size() || mesh.uv_sets[set - 1].empty())) {
                    firsts[number][set] = firsts[number][set - 1];
                    continue;
                }
                for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
                    const glm::vec2 uv = has ? mesh.uv_sets[set][v] : glm::vec2(0.0F);
                    surfaces.coordinates.insert(surfaces.coordinates.end(), {uv.x, uv.y});
                }
            }
        }
        for (std::size_t set = 0; set < SURFACE_UV_SETS; ++set)
            words[set] = firsts[number][set] - flat.ranges[i].first_vertex;
        if (mesh.alphas.empty()) continue;
        const auto [first_alpha, is_new] =
            alphas.try_emplace(number, static_cast<std::uint32_t>(surfaces.coordinates.size() / 2));
        if (is_new)
            for (const float alpha : mesh.alphas)
                surfaces.coordinates.insert(surfaces.coordinates.end(), {alpha, 0.0F});
        words[SURFACE_VERTEX_ALPHA] = first_alpha->second - flat.ranges[i].first_vertex;
    }
}

}  // namespace

void place_tangents(const Scene& scene, std::size_t instance, std::size_t first_vertex,
                    FlatSurfaces& surfaces) {
    const Instance& placed = scene.instances[instance];
    const std::vector<glm::vec4>& tangents = scene.meshes[placed.mesh].tangents;
    const glm::dmat3 linear(placed.to_world);
    // The bitangent turns with the surface, but normals stay on the outside.
    const bool mirrored = (glm::determinant(linear) < 0.0) != placed.flip_normals;
    for (std::size_t i = 0; i < tangents.size(); ++i) {
        glm::dvec3 along = linear * glm::dvec3(tangents[i]);
        const double length = glm::length(along);
        along = length > 0.0 ? along / length : glm::dvec3(0.0);
        surfaces.tangents[first_vertex + i] =
            packed(glm::vec3(along), mirrored ? -tangents[i].w : tangents[i].w);
    }
}

void link_boundaries(const Scene& scene, const FlatMedia& media, FlatSurfaces& surfaces) {
    if (!surfaces.present()) return;
    for (const FlatMedia::SurfaceBoundary& boundary : media.surfaces) {
        const bool inwards = boundary.inwards != scene.instances[boundary.instance].flip_normals;
        surfaces.of_instances[boundary.instance * SURFACE_INSTANCE_WORDS + SURFACE_BOUNDARY] =
            boundary.number | (inwards ? SURFACE_BOUNDARY_INWARDS : 0U);
    }
}

FlatSurfaces flatten_surfaces(const Scene& scene, const FlatScene& flat) {
    FlatSurfaces surfaces;
    if (std::none_of(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
            return scatters_by_record(scene.materials[instance.material]);
        }))
        return surfaces;
    take(plain_surfaces(scene, flat.texture_statistics), surfaces);
    append_coordinates(scene, flat, surfaces);
    if (std::any_of(surfaces.records.begin(), surfaces.records.end(), asks_for_tangents)) {
        surfaces.tangents.assign(flat.positions.size(), {0.0F, 0.0F, 0.0F, 0.0F});
        for (std::size_t i = 0; i < scene.instances.size(); ++i)
            place_tangents(scene, i, flat.ranges[i].first_vertex, surfaces);
    }
    number_interfaces(scene, flat, surfaces);
    for (std::size_t i = 0; i < scene.instances.size(); ++i)
        surfaces.passes_light.push_back(passes_half(scene, flat, i));
    surfaces.see_through = std::any_of(
        surfaces.records.begin(), surfaces.records.end(), [](const shared::SurfaceRecord& record) {
            return (record.flags & (SURFACE_MASK | SURFACE_BLEND)) != 0 ||
                   ((record.flags & SURFACE_THIN) != 0 && record.transmission > 0.0F);
        });
    return surfaces;
}

void update_surfaces(const Scene& scene, std::span<const TextureStatistics> textures,
                     FlatSurfaces& surfaces) {
    if (!surfaces.present()) return;
    // There are fewer maps where roughness becomes the same along both directions.
    PlainSurfaces plain = plain_surfaces(scene, textures);
    if (std::equal(plain.records.begin(), plain.records.end(), surfaces.plain.begin(),
                   surfaces.plain.end(), same_numbers))
        return;
    take(std::move(plain), surfaces);
}

}  // namespace weft
