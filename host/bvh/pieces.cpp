// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bvh/pieces.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "base/limits.h"

namespace weft {

Corners corners_of(std::span<const shared::float4> positions,
                   const shared::Triangle& triangle) noexcept {
    return {positions[triangle.v0], positions[triangle.v1], positions[triangle.v2]};
}

bool can_be_hit(const Corners& corners) noexcept {
    for (const shared::float4& v : corners)
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) return false;
    // Products of differences of floats neither overflow nor vanish in double.
    const auto& [a, b, c] = corners;
    const Point u{double{b.x} - double{a.x}, double{b.y} - double{a.y}, double{b.z} - double{a.z}};
    const Point v{double{c.x} - double{a.x}, double{c.y} - double{a.y}, double{c.z} - double{a.z}};
    return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

Box box_of(const Corners& corners) noexcept {
    Box box;
    for (const shared::float4& v : corners) box.extend({{v.x, v.y, v.z}, {v.x, v.y, v.z}});
    return box;
}

Box box_of(const Piece& piece) noexcept {
    return {{piece.lower_x, piece.lower_y, piece.lower_z},
            {piece.upper_x, piece.upper_y, piece.upper_z}};
}

std::array<float, 3> centre_of(const Piece& piece) noexcept {
    // Halves first: sums of large coordinates overflow.
    return {0.5F * piece.lower_x + 0.5F * piece.upper_x,
            0.5F * piece.lower_y + 0.5F * piece.upper_y,
            0.5F * piece.lower_z + 0.5F * piece.upper_z};
}

Piece with_box(const Piece& piece, const Box& box) noexcept {
    return {box.lower[0], box.lower[1], box.lower[2], piece.geomID,
            box.upper[0], box.upper[1], box.upper[2], piece.primID};
}

std::vector<Piece> make_pieces(std::span<const shared::float4> positions,
                               std::span<const shared::Triangle> triangles, std::size_t first) {
    if (triangles.size() > limits::max_triangles)
        throw Error(ExitCode::bad_input, "the scene has " + std::to_string(triangles.size()) +
                                             " triangles, expected at most " +
                                             std::to_string(limits::max_triangles));
    std::vector<Piece> pieces;
    pieces.reserve(triangles.size() - std::min(first, triangles.size()));
    for (std::size_t i = first; i < triangles.size(); ++i) {
        const shared::Triangle& t = triangles[i];
        if (t.v0 >= positions.size() || t.v1 >= positions.size() || t.v2 >= positions.size())
            throw Error(ExitCode::bad_input,
                        "triangle " + std::to_string(i) + ": a vertex index is out of range, " +
                            "expected less than " + std::to_string(positions.size()));
        const Corners corners = corners_of(positions, t);
        if (!can_be_hit(corners)) continue;
        Piece piece{};
        piece.primID = static_cast<unsigned>(i);
        pieces.push_back(with_box(piece, box_of(corners)));
    }
    return pieces;
}

}  // namespace weft
