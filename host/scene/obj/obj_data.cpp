// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <system_error>
#include <utility>

#include "base/error.h"
#include "base/finite.h"
#include "base/limits.h"
#include "base/quote.h"
#include "base/srgb.h"
#include "scene/obj/obj_text.h"

namespace weft {
namespace {

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

class ObjParser {
  public:
    ObjParser(std::string_view text, const std::string& file, WarningCollector& report)
        : lines_(text, file), report_(report) {
        data_.file = file;
    }

    ObjData parse() {
        ObjStatement statement;
        while (lines_.next(statement)) read(statement);
        forget_missing_tables();
        check_references();
        report_.count(first_small_, {"face", "faces"}, "fewer than three corners, left out",
                      small_faces_);
        return std::move(data_);
    }

  private:
    void read(const ObjStatement& statement) {
        const std::string_view keyword = statement.keyword;
        if (keyword == "v") {
            read_position(statement);
        } else if (keyword == "vt") {
            read_uv(statement);
        } else if (keyword == "vn") {
            read_normal(statement);
        } else if (keyword == "f" || keyword == "fo") {
            read_face(statement);
        } else if (keyword == "usemtl") {
            use_material(statement);
        } else if (keyword == "mtllib") {
            data_.libraries.push_back({lines_.place(statement), std::string(statement.rest)});
        } else if (keyword == "l" || keyword == "p") {
            report_.count(lines_.place(statement), {"statement", "statements"},
                          "points and lines are not simulated, they are left out");
        } else if (!is_one_of(keyword, {"o", "g", "s", "mg", "usemap", "maplib", "lod"})) {
            report_.once(lines_.place(statement),
                         "statement " + quote(keyword) + " is not known, ignored");
        }
    }

    [[nodiscard]] std::vector<double> numbers(const ObjStatement& statement, std::size_t least,
                                              std::size_t most) const {
        const std::string place = lines_.place(statement);
        std::vector<double> values = read_obj_numbers(statement.rest, most, place);
        if (values.size() < least)
            throw input_error(place, fmt::format("{} numbers after '{}', expected {}",
                                                 values.size(), statement.keyword, least));
        return values;
    }

    void check_count(const ObjStatement& statement, std::size_t count) const {
        if (count < limits::max_vertices) return;
        throw input_error(lines_.place(statement),
                          fmt::format("more than {} '{}', expected fewer", limits::max_vertices,
                                      statement.keyword));
    }

    /// Doubles beyond the range of float become infinite.
    static glm::vec3 to_float(double x, double y, double z) {
        constexpr double largest = std::numeric_limits<float>::max();
        const auto narrow = [](double value) {
            return std::abs(value) > largest ? std::numeric_limits<float>::infinity()
                                             : static_cast<float>(value);
        };
        return {narrow(x), narrow(y), narrow(z)};
    }

    /// `v x y z [w] [r g b]`. The weight w has no meaning for polygons.
    void read_position(const ObjStatement& statement) {
        check_count(statement, data_.positions.size());
        const std::vector<double> values = numbers(statement, 3, 7);
        data_.positions.push_back(to_float(values[0], values[1], values[2]));
        const bool coloured = values.size() >= 6;
        if (!coloured && data_.colours.empty()) return;
        data_.colours.resize(data_.positions.size(), glm::vec3(1.0F));
        if (!coloured) return;
        glm::vec3 colour = to_float(values[3], values[4], values[5]);
        bool clamped = false;
        for (int i = 0; i < 3; ++i) {
            const float inside = colour[i] >= 0.0F ? std::min(colour[i], 1.0F) : 0.0F;
            clamped = clamped || inside != colour[i];
            colour[i] = inside;
        }
        if (clamped)
            report_.count(lines_.place(statement), {"vertex colour", "vertex colours"},
                          "outside of [0, 1], clamped");
        data_.colours.back() = linear_from_srgb(colour);
    }

    void read_uv(const ObjStatement& statement) {
        check_count(statement, data_.uvs.size());
        const std::vector<double> values = numbers(statement, 1, 3);
        const glm::vec3 uv = to_float(values[0], values.size() > 1 ? values[1] : 0.0, 0.0);
        const bool usable = is_finite(glm::vec2(uv));
        if (!usable)
            report_.count(lines_.place(statement), {"texture coordinate", "texture coordinates"},
                          "not finite, zero is used instead");
        data_.uvs.push_back(usable ? glm::vec2(uv) : glm::vec2(0.0F));
    }

    void read_normal(const ObjStatement& statement) {
        check_count(statement, data_.normals.size());
        const std::vector<double> values = numbers(statement, 3, 3);
        const glm::dvec3 normal(values[0], values[1], values[2]);
        const double length = glm::length(normal);
        const bool usable = length > 0.0 && std::isfinite(length);
        if (!usable)
            report_.count(lines_.place(statement), {"normal", "normals"},
                          "zero or not finite, the normals of the faces around are used instead");
        data_.normals.push_back(usable ? glm::vec3(normal / length) : glm::vec3(0.0F));
    }

    /// Turns an index of the file into one from 0. Those of later elements are checked at the end.
    [[nodiscard]] std::int32_t read_index(std::string_view digits, std::string_view word,
                                          const ObjStatement& statement, std::size_t count) const {
        std::int64_t index = 0;
        if (digits.starts_with('+')) digits.remove_prefix(1);
        const char* const end = digits.data() + digits.size();
        const auto [stop, code] = std::from_chars(digits.data(), end, index);
        if (code != std::errc() || stop != end)
            throw input_error(
                lines_.place(statement),
                "bad corner " + quote(word) + ", expected v, v/vt, v//vn or v/vt/vn with integers");
        const std::int64_t from_zero =
            index > 0 ? index - 1 : index + static_cast<std::int64_t>(count);
        if (index == 0 || from_zero < 0 ||
            from_zero >= static_cast<std::int64_t>(limits::max_vertices))
            throw input_error(
                lines_.place(statement),
                fmt::format("index {} of corner {}, expected 1 or more, or a negative number that "
                            "counts back over the {} so far",
                            index, quote(word), count));
        return static_cast<std::int32_t>(from_zero);
    }

    [[nodiscard]] ObjCorner read_corner(std::string_view word,
                                        const ObjStatement& statement) const {
        std::array<std::string_view, 3> parts{};
        std::string_view rest = word;
        for (std::size_t i = 0; i < 3; ++i) {
            const std::size_t slash = i < 2 ? rest.find('/') : std::string_view::npos;
            parts[i] = rest.substr(0, slash);
            rest = slash == std::string_view::npos ? std::string_view() : rest.substr(slash + 1);
        }
        ObjCorner corner;
        corner.position = read_index(parts[0], word, statement, data_.positions.size());
        if (!parts[1].empty()) corner.uv = read_index(parts[1], word, statement, data_.uvs.size());
        if (!parts[2].empty())
            corner.normal = read_index(parts[2], word, statement, data_.normals.size());
        return corner;
    }

    void read_face(const ObjStatement& statement) {
        const std::size_t first = data_.corners.size();
        std::string_view rest = statement.rest;
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            if (data_.corners.size() - first >= 2 && triangles_ >= limits::max_triangles)
                throw input_error(lines_.place(statement),
                                  fmt::format("too many triangles, expected at most {} in a file",
                                              limits::max_triangles));
            data_.corners.push_back(read_corner(word, statement));
            if (data_.corners.size() - first >= 3) ++triangles_;
        }
        const std::size_t count = data_.corners.size() - first;
        if (count < 3) {
            if (small_faces_++ == 0) first_small_ = lines_.place(statement);
            data_.corners.resize(first);
            return;
        }
        data_.faces.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count),
                               static_cast<std::uint32_t>(statement.line)});
    }

    void use_material(const ObjStatement& statement) {
        const auto next = static_cast<std::uint32_t>(data_.material_names.size());
        const auto [found, added] = names_.try_emplace(std::string(statement.rest), next);
        if (added) data_.material_names.push_back(found->first);
        const auto face = static_cast<std::uint32_t>(data_.faces.size());
        if (!data_.uses.empty() && data_.uses.back().first_face == face) data_.uses.pop_back();
        data_.uses.push_back({face, found->second});
    }

    /// Clears indices into tables that the file lacks: some writers refer to texture coordinates or
    /// normals that they leave out altogether.
    void forget_missing_tables() {
        const bool no_uvs = data_.uvs.empty();
        const bool no_normals = data_.normals.empty();
        if (!no_uvs && !no_normals) return;
        bool forgotten = false;
        for (ObjCorner& corner : data_.corners) {
            forgotten =
                forgotten || (no_uvs && corner.uv >= 0) || (no_normals && corner.normal >= 0);
            if (no_uvs) corner.uv = -1;
            if (no_normals) corner.normal = -1;
        }
        if (forgotten)
            report_.once(data_.file,
                         "faces name texture coordinates or normals of which the file "
                         "has none, they are ignored");
    }

    void check_references() const {
        const auto check = [&](const ObjFace& face, std::int32_t index, std::size_t count,
                               const char* kind) {
            if (index < 0 || static_cast<std::size_t>(index) < count) return;
            throw input_error(data_.place(face),
                              fmt::format("{} {} does not exist, expected 1 to {}", kind,
                                          std::int64_t{index} + 1, count));
        };
        for (const ObjFace& face : data_.faces) {
            for (std::uint32_t i = face.first; i < face.first + face.count; ++i) {
                check(face, data_.corners[i].position, data_.positions.size(), "vertex");
                check(face, data_.corners[i].uv, data_.uvs.size(), "texture coordinate");
                check(face, data_.corners[i].normal, data_.normals.size(), "normal");
            }
        }
    }

    ObjLines lines_;
    WarningCollector& report_;
    ObjData data_;
    std::map<std::string, std::uint32_t, std::less<>> names_;
    std::size_t triangles_ = 0;
    std::size_t small_faces_ = 0;
    std::string first_small_;
};

}  // namespace

ObjData parse_obj(std::string_view text, const std::string& file, WarningCollector& report) {
    return ObjParser(text, file, report).parse();
}

}  // namespace weft
