// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/tangents.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <map>
#include <unordered_map>
#include <utility>

namespace weft {
namespace {

constexpr std::uint32_t no_index = 0xFFFFFFFF;

/// What decides whether corners of triangles are one vertex: position, normal and texture
/// coordinates, by their bits.
using VertexKey = std::array<std::uint32_t, 8>;

struct VertexKeyHash {
    std::size_t operator()(const VertexKey& key) const {
        std::uint64_t state = 0xcbf29ce484222325ULL;
        for (const std::uint32_t word : key) {
            state ^= word;
            state *= 0x100000001b3ULL;
            state ^= state >> 29;
        }
        return static_cast<std::size_t>(state);
    }
};

/// The bits of a number, in which both zeros are alike.
std::uint32_t bits_of(float x) {
    return std::bit_cast<std::uint32_t>(x == 0.0F ? 0.0F : x);
}

/// The vector at length 1, or 0 where it has no direction.
glm::dvec3 unit_vector(const glm::dvec3& v) {
    const double length = glm::length(v);
    return length > 0.0 && std::isfinite(length) ? v / length : glm::dvec3(0.0);
}

glm::dvec3 across_normal(const glm::dvec3& v, const glm::dvec3& normal) {
    return v - glm::dot(v, normal) * normal;
}

/// Any unit vector across the normal.
glm::dvec3 any_across(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1, 0, 0)
                            : size.y <= size.z                   ? glm::dvec3(0, 1, 0)
                                                                 : glm::dvec3(0, 0, 1);
    return unit_vector(across_normal(axis, normal));
}

/// A triangle, and how the texture lies on it.
struct Facet {
    std::array<std::uint32_t, 3> welded{};  ///< numbers of its corners, equal where they are one
    std::array<std::uint32_t, 3> neighbours{no_index, no_index, no_index};  ///< by edge i to i + 1
    std::array<std::uint32_t, 3> groups{no_index, no_index, no_index};
    glm::dvec3 normal{0.0};
    glm::dvec3 along_u{0.0};    ///< unit
    bool upright = false;       ///< the texture is not mirrored
    bool indifferent = true;    ///< it has no texture that tells a direction
    bool without_edge = false;  ///< two of its corners are at the same place
};

/// Corners about one vertex, connected by edges, that share a tangent.
struct CornerGroup {
    std::uint32_t vertex = 0;
    bool upright = false;
    glm::dvec3 sum{0.0};
    glm::dvec3 normal{0.0};
};

class TangentBuilder {
  public:
    TangentBuilder(const Mesh& mesh, const std::vector<glm::vec2>& uvs) : mesh_(mesh), uvs_(uvs) {
        facets_.resize(mesh.triangles.size());
        for (std::size_t i = 0; i < facets_.size(); ++i) lay_texture(i);
        weld();
        connect();
        for (std::uint32_t i = 0; i < facets_.size(); ++i)
            for (std::uint32_t corner = 0; corner < 3; ++corner) begin_group(i, corner);
        adopt_others();
    }

    [[nodiscard]] MeshTangents take() {
        const std::size_t vertices = mesh_.positions.size();
        MeshTangents made;
        made.triangles = mesh_.triangles;
        made.tangents.resize(vertices);
        // By vertex of the mesh and group: the vertex that has its tangent.
        std::vector<std::uint32_t> first_group(vertices, no_index);
        std::vector<bool> is_used(vertices, false);
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> others;
        for (std::size_t i = 0; i < facets_.size(); ++i)
            for (std::size_t corner = 0; corner < 3; ++corner) {
                const std::uint32_t vertex = mesh_.triangles[i][corner];
                const std::uint32_t group = facets_[i].groups[corner];
                if (!is_used[vertex]) {
                    is_used[vertex] = true;
                    first_group[vertex] = group;
                    made.tangents[vertex] = tangent_of(i, corner);
                } else if (first_group[vertex] != group) {
                    const auto next = static_cast<std::uint32_t>(made.tangents.size());
                    const auto [at, is_new] = others.try_emplace({vertex, group}, next);
                    if (is_new) {
                        made.copies.push_back(vertex);
                        made.tangents.push_back(tangent_of(i, corner));
                    }
                    made.triangles[i][corner] = at->second;
                }
            }
        for (std::size_t vertex = 0; vertex < vertices; ++vertex)
            if (!is_used[vertex]) made.tangents[vertex] = glm::vec4(1.0F, 0.0F, 0.0F, 1.0F);
        return made;
    }

  private:
    [[nodiscard]] glm::dvec3 position(std::size_t facet, std::size_t corner) const {
        return glm::dvec3(mesh_.positions[mesh_.triangles[facet][corner % 3]]);
    }
    /// The shading normal of a corner, of length 1 or 0.
    [[nodiscard]] glm::dvec3 normal(std::size_t facet, std::size_t corner) const {
        if (mesh_.normals.empty()) return facets_[facet].normal;
        return unit_vector(glm::dvec3(mesh_.normals[mesh_.triangles[facet][corner]]));
    }
    /// Texture coordinates with v upwards.
    [[nodiscard]] glm::dvec2 uv(std::size_t facet, std::size_t corner) const {
        const glm::vec2& value = uvs_[mesh_.triangles[facet][corner]];
        return {static_cast<double>(value.x), -static_cast<double>(value.y)};
    }

    /// Finds along which direction u grows on a triangle.
    void lay_texture(std::size_t i) {
        Facet& facet = facets_[i];
        const glm::dvec3 first = position(i, 1) - position(i, 0);
        const glm::dvec3 second = position(i, 2) - position(i, 0);
        facet.normal = unit_vector(glm::cross(first, second));
        facet.without_edge = first == glm::dvec3(0.0) || second == glm::dvec3(0.0) ||
                             position(i, 1) == position(i, 2);
        if (uvs_.empty()) return;
        const glm::dvec2 t = uv(i, 1) - uv(i, 0);
        const glm::dvec2 s = uv(i, 2) - uv(i, 0);
        const double area = t.x * s.y - t.y * s.x;
        facet.upright = area > 0.0;
        facet.along_u = unit_vector((facet.upright ? 1.0 : -1.0) * (s.y * first - t.y * second));
        const glm::dvec3 along_v = t.x * second - s.x * first;
        facet.indifferent = !(area != 0.0 && std::isfinite(area)) ||
                            facet.along_u == glm::dvec3(0.0) ||
                            unit_vector(along_v) == glm::dvec3(0.0);
    }

    [[nodiscard]] VertexKey key_of(std::size_t facet, std::size_t corner) const {
        const std::uint32_t vertex = mesh_.triangles[facet][corner];
        const glm::vec3 n =
            mesh_.normals.empty() ? glm::vec3(facets_[facet].normal) : mesh_.normals[vertex];
        const glm::vec3& p = mesh_.positions[vertex];
        const glm::vec2 t = uvs_.empty() ? glm::vec2(0.0F) : uvs_[vertex];
        return {bits_of(p.x), bits_of(p.y), bits_of(p.z), bits_of(n.x),
                bits_of(n.y), bits_of(n.z), bits_of(t.x), bits_of(t.y)};
    }

    /// Numbers corners, such that those of the same position, normal and texture coordinates have
    /// the same number.
    void weld() {
        std::unordered_map<VertexKey, std::uint32_t, VertexKeyHash> numbers;
        numbers.reserve(mesh_.positions.size());
        for (std::size_t i = 0; i < facets_.size(); ++i)
            for (std::size_t corner = 0; corner < 3; ++corner)
                facets_[i].welded[corner] =
                    numbers
                        .try_emplace(key_of(i, corner), static_cast<std::uint32_t>(numbers.size()))
                        .first->second;
        group_at_.assign(numbers.size(), no_index);
    }

    /// Finds the triangle beyond each edge: one that has the edge the other way round.
    void connect() {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> open;
        for (std::uint32_t i = 0; i < facets_.size(); ++i) {
            if (facets_[i].without_edge) continue;
            for (std::uint32_t edge = 0; edge < 3; ++edge) {
                const std::uint32_t from = facets_[i].welded[edge];
                const std::uint32_t to = facets_[i].welded[(edge + 1) % 3];
                const auto found = open.find({to, from});
                if (found == open.end() || found->second.empty()) {
                    open[{from, to}].push_back(3 * i + edge);
                    continue;
                }
                const std::uint32_t other = found->second.front();
                found->second.erase(found->second.begin());
                facets_[i].neighbours[edge] = other / 3;
                facets_[other / 3].neighbours[other % 3] = i;
            }
        }
    }

    /// Makes a group of the corners that a corner is connected with, where it is in none yet.
    void begin_group(std::uint32_t first, std::uint32_t corner) {
        const Facet& facet = facets_[first];
        if (facet.without_edge || facet.indifferent || facet.groups[corner] != no_index) return;
        const auto number = static_cast<std::uint32_t>(groups_.size());
        groups_.push_back(
            {facet.welded[corner], facet.upright, glm::dvec3(0.0), normal(first, corner)});
        if (group_at_[facet.welded[corner]] == no_index) group_at_[facet.welded[corner]] = number;
        std::vector<std::uint32_t> waiting{first};
        while (!waiting.empty()) {
            const std::uint32_t i = waiting.back();
            waiting.pop_back();
            const std::uint32_t at = join(i, number);
            if (at == no_index) continue;
            for (const std::uint32_t next :
                 {facets_[i].neighbours[(at + 2) % 3], facets_[i].neighbours[at]})
                if (next != no_index) waiting.push_back(next);
        }
    }

    /// Puts a triangle into a group, unless its texture is mirrored against it. Returns the corner
    /// with which it has joined, or no_index.
    std::uint32_t join(std::uint32_t i, std::uint32_t number) {
        Facet& facet = facets_[i];
        CornerGroup& group = groups_[number];
        const auto at = static_cast<std::uint32_t>(
            std::find(facet.welded.begin(), facet.welded.end(), group.vertex) -
            facet.welded.begin());
        if (at == 3 || facet.groups[at] != no_index) return no_index;
        const bool is_free = std::all_of(facet.groups.begin(), facet.groups.end(),
                                         [](std::uint32_t g) { return g == no_index; });
        // The first group that it joins decides about a triangle that tells nothing itself.
        if (facet.indifferent && is_free) facet.upright = group.upright;
        if (facet.upright != group.upright) return no_index;
        facet.groups[at] = number;
        if (!facet.indifferent)
            group.sum += corner_angle(i, at, group.normal) *
                         unit_vector(across_normal(facet.along_u, group.normal));
        return at;
    }

    /// The angle of a corner, seen along the normal, radians.
    [[nodiscard]] double corner_angle(std::size_t i, std::size_t corner,
                                      const glm::dvec3& along) const {
        const glm::dvec3 here = position(i, corner);
        const glm::dvec3 a = unit_vector(across_normal(position(i, corner + 1) - here, along));
        const glm::dvec3 b = unit_vector(across_normal(position(i, corner + 2) - here, along));
        return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
    }

    /// Corners that are in no group take the tangent of another one at the same vertex.
    void adopt_others() {
        for (Facet& facet : facets_)
            for (std::size_t corner = 0; corner < 3; ++corner)
                if (facet.groups[corner] == no_index)
                    facet.groups[corner] = group_at_[facet.welded[corner]];
    }

    [[nodiscard]] glm::vec4 tangent_of(std::size_t i, std::size_t corner) const {
        const std::uint32_t number = facets_[i].groups[corner];
        const glm::dvec3 sum =
            number == no_index ? glm::dvec3(0.0) : unit_vector(groups_[number].sum);
        const bool mirrored = number != no_index && !groups_[number].upright;
        const glm::dvec3 tangent = sum == glm::dvec3(0.0) ? any_across(normal(i, corner)) : sum;
        return {glm::vec3(tangent), mirrored ? -1.0F : 1.0F};
    }

    const Mesh& mesh_;
    const std::vector<glm::vec2>& uvs_;
    std::vector<Facet> facets_;
    std::vector<CornerGroup> groups_;
    std::vector<std::uint32_t> group_at_;  ///< by welded corner: the first group there
};

}  // namespace

MeshTangents make_tangents(const Mesh& mesh, const std::vector<glm::vec2>& uvs) {
    return TangentBuilder(mesh, uvs).take();
}

}  // namespace weft
