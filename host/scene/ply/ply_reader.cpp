// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/finite.h"
#include "base/limits.h"
#include "base/quote.h"
#include "base/srgb.h"
#include "base/warning_collector.h"
#include "scene/ply/ply_header.h"
#include "scene/ply/ply_source.h"

namespace weft {

namespace {

enum Slot : std::size_t { x, y, z, nx, ny, nz, u, v, red, green, blue, slot_count };

constexpr std::array<std::pair<std::string_view, Slot>, 15> slot_names = {{
    {"x", Slot::x},
    {"y", Slot::y},
    {"z", Slot::z},
    {"nx", Slot::nx},
    {"ny", Slot::ny},
    {"nz", Slot::nz},
    {"u", Slot::u},
    {"s", Slot::u},
    {"texture_u", Slot::u},
    {"v", Slot::v},
    {"t", Slot::v},
    {"texture_v", Slot::v},
    {"red", Slot::red},
    {"green", Slot::green},
    {"blue", Slot::blue},
}};

/// Where each vertex property goes (`slot_count`: nowhere), and which slots are filled.
struct VertexLayout {
    std::vector<Slot> slots;
    std::array<bool, slot_count> present{};
    std::array<float, 3> colour_scale = {1.0F, 1.0F, 1.0F};
    bool srgb = false;

    [[nodiscard]] bool has(std::initializer_list<Slot> wanted) const {
        return std::all_of(wanted.begin(), wanted.end(), [&](Slot slot) { return present[slot]; });
    }
};

VertexLayout make_layout(const PlyElement& element) {
    VertexLayout layout;
    for (const PlyProperty& property : element.properties) {
        const auto* const found =
            std::find_if(slot_names.begin(), slot_names.end(),
                         [&](const auto& entry) { return entry.first == property.name; });
        const bool usable =
            found != slot_names.end() && !property.is_list && !layout.present[found->second];
        layout.slots.push_back(usable ? found->second : slot_count);
        if (!usable) continue;
        layout.present[found->second] = true;
        if (found->second >= Slot::red && ply_is_integer(property.type)) {
            const bool wide = ply_size(property.type) == 2;
            layout.colour_scale[found->second - Slot::red] = 1.0F / (wide ? 65535.0F : 255.0F);
            layout.srgb = true;
        }
    }
    if (!layout.has({Slot::x, Slot::y, Slot::z}))
        throw input_error(element.place, "vertices without a position, expected x, y and z");
    return layout;
}

template <typename Source>
class BodyReader {
  public:
    BodyReader(Source source, const PlyHeader& header, std::string file, Diagnostics& diagnostics)
        : source_(source), header_(header), file_(std::move(file)), report_(diagnostics) {}

    Mesh read() {
        check_elements();
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.name == "face") {
                read_faces(element);
            } else {
                skip_element(element);
            }
        }
        if (source_.left() > 0) report_.once(file_, "data after the last element is ignored");
        drop_non_finite();
        repair_attributes();
        return std::move(mesh_);
    }

  private:
    /// Place of what is being read, for error messages: its line, or in a binary file its number.
    [[nodiscard]] std::string item_place(const PlyElement& element, std::uint64_t index) const {
        if (const std::optional<std::size_t> line = source_.line())
            return fmt::format("{}:{}", file_, header_.lines + *line + 1);
        const bool known = element.name == "vertex" || element.name == "face";
        return fmt::format("{}: {} {}", file_, known ? element.name : quote(element.name), index);
    }

    double next(const PlyElement& element, std::uint64_t index, PlyType type) {
        const std::optional<double> value = source_.next(type);
        if (!value)
            throw input_error(item_place(element, index),
                              source_.left() == 0 ? "the file ends here, expected a number"
                                                  : "bad value, expected a number");
        return *value;
    }

    std::uint64_t next_length(const PlyElement& element, std::uint64_t index,
                              const PlyProperty& property) {
        const double length = next(element, index, property.count_type);
        // Also false for NaN.
        const bool fits = length >= 0.0 && length <= 4294967295.0 && length == std::floor(length);
        if (!fits || static_cast<std::uint64_t>(length) >
                         source_.capacity(source_.least_size(property.type)))
            throw input_error(
                item_place(element, index),
                fmt::format("list length {} of {}, expected a count that the file can hold", length,
                            quote(property.name)));
        return static_cast<std::uint64_t>(length);
    }

    /// Refuses tables that cannot fit in the file before anything is allocated for them.
    void check_elements() {
        bool has_faces = false;
        for (const PlyElement& element : header_.elements) {
            std::size_t least = 0;
            for (const PlyProperty& property : element.properties)
                least += source_.least_size(property.is_list ? property.count_type : property.type);
            if (least > 0 && element.count > source_.capacity(least))
                throw input_error(
                    element.place,
                    fmt::format("{} {} elements do not fit in the file, expected at "
                                "most {}",
                                element.count, quote(element.name), source_.capacity(least)));
            if (element.name == "vertex") vertex_count_ = element.count;
            if (vertex_count_ > limits::max_vertices)
                throw input_error(element.place, fmt::format("{} vertices, expected at most {}",
                                                             vertex_count_, limits::max_vertices));
            has_faces = has_faces || element.name == "face";
        }
        if (!has_faces)
            throw input_error(fmt::format("{}:{}", file_, header_.lines),
                              "no faces, expected an element 'face'");
    }

    void skip_property(const PlyElement& element, std::uint64_t index,
                       const PlyProperty& property) {
        const std::uint64_t count =
            property.is_list ? next_length(element, index, property) : std::uint64_t{1};
        if (!source_.skip(property.type, count))
            throw input_error(item_place(element, index),
                              "bad value or end of file, expected " + quote(property.name));
    }

    void skip_element(const PlyElement& element) {
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties)
                skip_property(element, i, property);
        }
    }

    void read_vertices(const PlyElement& element) {
        const VertexLayout layout = make_layout(element);
        const auto count = static_cast<std::size_t>(element.count);
        const bool normals = layout.has({Slot::nx, Slot::ny, Slot::nz});
        const bool uvs = layout.has({Slot::u, Slot::v});
        const bool colours = layout.has({Slot::red, Slot::green, Slot::blue});
        mesh_.positions.reserve(count);
        if (normals) mesh_.normals.reserve(count);
        if (uvs) mesh_.uvs.reserve(count);
        if (colours) mesh_.colours.reserve(count);
        std::array<float, slot_count + 1> value{};
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const PlyProperty& property = element.properties[p];
                if (layout.slots[p] == slot_count) {
                    skip_property(element, i, property);
                } else {
                    value[layout.slots[p]] = to_float(next(element, i, property.type));
                }
            }
            mesh_.positions.emplace_back(value[Slot::x], value[Slot::y], value[Slot::z]);
            if (normals)
                mesh_.normals.emplace_back(value[Slot::nx], value[Slot::ny], value[Slot::nz]);
            if (uvs) mesh_.uvs.emplace_back(value[Slot::u], value[Slot::v]);
            if (colours)
                add_colour(layout, value[Slot::red], value[Slot::green], value[Slot::blue]);
        }
    }

    /// Doubles beyond the range of float become infinite, and are dropped as such later.
    static float to_float(double value) {
        constexpr double largest = std::numeric_limits<float>::max();
        if (std::abs(value) > largest) return std::numeric_limits<float>::infinity();
        return static_cast<float>(value);
    }

    void add_colour(const VertexLayout& layout, float r, float g, float b) {
        glm::vec3 colour(r * layout.colour_scale[0], g * layout.colour_scale[1],
                         b * layout.colour_scale[2]);
        if (layout.srgb) colour = linear_from_srgb(colour);
        mesh_.colours.push_back(colour);
    }

    void read_faces(const PlyElement& element) {
        const auto is_indices = [](const PlyProperty& property) {
            return property.is_list &&
                   (property.name == "vertex_indices" || property.name == "vertex_index");
        };
        const auto indices =
            std::find_if(element.properties.begin(), element.properties.end(), is_indices);
        if (indices == element.properties.end() || !ply_is_integer(indices->type))
            throw input_error(element.place,
                              "faces without corners, expected an integer list 'vertex_indices'");
        mesh_.triangles.reserve(static_cast<std::size_t>(
            std::min<std::uint64_t>(element.count, limits::max_triangles)));
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (const PlyProperty& property : element.properties) {
                if (&property == &*indices) {
                    read_polygon(element, i, property);
                } else {
                    skip_property(element, i, property);
                }
            }
        }
        if (small_faces_ > 0)
            report_.count(file_, {"face", "faces"}, "fewer than three corners, left out",
                          small_faces_);
    }

    void read_polygon(const PlyElement& element, std::uint64_t index, const PlyProperty& property) {
        const std::uint64_t corners = next_length(element, index, property);
        if (corners < 3) ++small_faces_;
        if (corners > 2 && corners - 2 > limits::max_triangles - mesh_.triangles.size())
            throw input_error(item_place(element, index),
                              fmt::format("too many triangles, expected at most {} in a file",
                                          limits::max_triangles));
        std::uint32_t first = 0;
        std::uint32_t previous = 0;
        for (std::uint64_t corner = 0; corner < corners; ++corner) {
            const double value = next(element, index, property.type);
            const bool valid = value >= 0.0 && value < static_cast<double>(vertex_count_) &&
                               value == std::floor(value);
            if (!valid)
                throw input_error(item_place(element, index),
                                  fmt::format("vertex index {}, expected an integer from 0 to "
                                              "below {}",
                                              value, vertex_count_));
            const auto vertex = static_cast<std::uint32_t>(value);
            if (corner == 0) first = vertex;
            if (corner >= 2) mesh_.triangles.push_back({first, previous, vertex});
            previous = vertex;
        }
    }

    void drop_non_finite() {
        if (all_finite(mesh_.positions)) return;
        const auto broken = [&](const std::array<std::uint32_t, 3>& triangle) {
            return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t vertex) {
                return !is_finite(mesh_.positions[vertex]);
            });
        };
        const std::size_t dropped = std::erase_if(mesh_.triangles, broken);
        report_.count(file_, {"triangle", "triangles"}, "a vertex is not finite, left out",
                      dropped);
        // Unused now, but bounding boxes are taken over all vertices.
        const auto good =
            std::find_if(mesh_.positions.begin(), mesh_.positions.end(),
                         [](const glm::vec3& position) { return is_finite(position); });
        const glm::vec3 filler = good == mesh_.positions.end() ? glm::vec3(0.0F) : *good;
        for (glm::vec3& position : mesh_.positions) {
            if (!is_finite(position)) position = filler;
        }
    }

    /// Normalises normals; invalid ones become the mean of the normals of the triangles around.
    std::size_t repair_normals() {
        std::vector<std::uint32_t> broken;
        for (std::size_t i = 0; i < mesh_.normals.size(); ++i) {
            const double length = glm::length(glm::dvec3(mesh_.normals[i]));
            if (length > 0.0 && std::isfinite(length)) {
                mesh_.normals[i] = glm::vec3(glm::dvec3(mesh_.normals[i]) / length);
            } else {
                broken.push_back(static_cast<std::uint32_t>(i));
            }
        }
        if (broken.empty()) return 0;
        std::vector<glm::dvec3> sums(mesh_.positions.size(), glm::dvec3(0.0));
        for (const auto& [a, b, c] : mesh_.triangles) {
            const glm::dvec3 origin(mesh_.positions[a]);
            const glm::dvec3 area = glm::cross(glm::dvec3(mesh_.positions[b]) - origin,
                                               glm::dvec3(mesh_.positions[c]) - origin);
            for (const std::uint32_t corner : {a, b, c}) sums[corner] += area;
        }
        for (const std::uint32_t vertex : broken) {
            const double length = glm::length(sums[vertex]);
            mesh_.normals[vertex] =
                length > 0.0 ? glm::vec3(sums[vertex] / length) : glm::vec3(0.0F, 0.0F, 1.0F);
        }
        return broken.size();
    }

    void repair_attributes() {
        report_.count(file_, {"normal", "normals"},
                      "zero or not finite, the normals of the faces around are used instead",
                      repair_normals());
        std::size_t broken_uvs = 0;
        for (glm::vec2& uv : mesh_.uvs) {
            if (is_finite(uv)) continue;
            uv = glm::vec2(0.0F);
            ++broken_uvs;
        }
        report_.count(file_, {"texture coordinate", "texture coordinates"},
                      "not finite, zero is used instead", broken_uvs);
        std::size_t clamped = 0;
        for (glm::vec3& colour : mesh_.colours) {
            if (is_finite(colour) && glm::all(glm::greaterThanEqual(colour, glm::vec3(0.0F))) &&
                glm::all(glm::lessThanEqual(colour, glm::vec3(1.0F))))
                continue;
            colour = is_finite(colour) ? glm::clamp(colour, 0.0F, 1.0F) : glm::vec3(1.0F);
            ++clamped;
        }
        report_.count(file_, {"vertex colour", "vertex colours"}, "outside of [0, 1], clamped",
                      clamped);
    }

    Source source_;
    const PlyHeader& header_;
    std::string file_;
    WarningCollector report_;
    Mesh mesh_;
    std::uint64_t vertex_count_ = 0;
    std::uint64_t small_faces_ = 0;
};

}  // namespace

Mesh read_ply(const std::filesystem::path& path, const std::string& place,
              Diagnostics& diagnostics) {
    const std::vector<std::byte> bytes = read_file(path, limits::max_binary_file_bytes, place);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    const std::string file = path.string();
    const PlyHeader header = parse_ply_header(text, file);
    const std::string_view body = text.substr(header.body_offset);
    Mesh mesh;
    if (header.format == PlyFormat::ascii) {
        mesh = BodyReader(PlyAsciiSource(body), header, file, diagnostics).read();
    } else {
        const PlyBinarySource source(body, header.format == PlyFormat::big_endian);
        mesh = BodyReader(source, header, file, diagnostics).read();
    }
    mesh.name = path.stem().string();
    return mesh;
}

}  // namespace weft
