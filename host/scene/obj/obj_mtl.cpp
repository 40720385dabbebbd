// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/obj/obj_mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/quote.h"
#include "scene/obj/obj_text.h"

namespace weft {
namespace {

constexpr WarningUnit mtl_material_unit{"material", "materials"};

/// A statement that Weft does not simulate, and the numbers with which it has no effect.
struct Unsimulated {
    std::string_view keyword;
    double neutral;
    const char* message;
};

constexpr const char* specular = "specular reflection is not simulated";
constexpr const char* transparency = "transparency is not simulated, surfaces are opaque";
constexpr const char* metal = "metals are not simulated, a diffuse surface is rendered instead";
constexpr const char* coat = "clear coat is not simulated";
constexpr const char* sheen = "sheen is not simulated";
constexpr const char* reflection = "maps of what is reflected are not simulated";
constexpr const char* normal = "normal maps are not simulated";
constexpr const char* bump = "bump and displacement maps are not simulated";
constexpr double always = std::numeric_limits<double>::quiet_NaN();

/// Of MaterialDetail::diffuse.
constexpr std::array undiffuse = {
    Unsimulated{"ks", 0.0, specular},
    Unsimulated{"map_ks", always, specular},
    Unsimulated{"d", 1.0, transparency},
    Unsimulated{"tr", 0.0, transparency},
    Unsimulated{"kt", 0.0, transparency},
    Unsimulated{"map_d", always, transparency},
    Unsimulated{"map_tr", always, transparency},
    Unsimulated{"map_opacity", always, transparency},
    Unsimulated{"pm", 0.0, metal},
    Unsimulated{"map_pm", always, metal},
    Unsimulated{"pc", 0.0, coat},
    Unsimulated{"map_pc", always, coat},
    Unsimulated{"map_pcr", always, coat},
    Unsimulated{"norm", always, normal},
    Unsimulated{"map_norm", always, normal},
    Unsimulated{"map_kn", always, normal},
};

/// What no algorithm renders.
constexpr std::array unsimulated = {
    Unsimulated{"refl", always, reflection},
    Unsimulated{"map_refl", always, reflection},
    Unsimulated{"sharpness", 60.0, reflection},
    Unsimulated{"ps", 0.0, sheen},
    Unsimulated{"map_ps", always, sheen},
    Unsimulated{"bump", always, bump},
    Unsimulated{"map_bump", always, bump},
    Unsimulated{"disp", always, bump},
    Unsimulated{"map_disp", always, bump},
    Unsimulated{"decal", always, "decals are not simulated"},
};

/// Statements that only modify the ones above, or whose effect light simulation replaces.
constexpr std::array<std::string_view, 21> passive = {
    "ka",        "map_ka", "ambient",    "ns",      "map_ns", "ni",     "map_ni",
    "illum",     "tf",     "map_tf",     "pr",      "map_pr", "pcr",    "aniso",
    "map_aniso", "anisor", "map_anisor", "map_aat", "pbr",    "map_ao", "map_illum"};

using MtlNumber = std::optional<double> MtlMaterial::*;
using MtlColour = std::optional<glm::vec3> MtlMaterial::*;
using MtlImage = std::optional<MtlMap> MtlMaterial::*;

constexpr std::array<std::pair<std::string_view, MtlNumber>, 9> number_statements = {{
    {"ns", &MtlMaterial::exponent},
    {"ni", &MtlMaterial::ior},
    {"d", &MtlMaterial::dissolve},
    {"tr", &MtlMaterial::transparency},
    {"illum", &MtlMaterial::illumination},
    {"pr", &MtlMaterial::roughness},
    {"pm", &MtlMaterial::metallic},
    {"pc", &MtlMaterial::coat},
    {"pcr", &MtlMaterial::coat_roughness},
}};

constexpr std::array<std::pair<std::string_view, MtlColour>, 2> colour_statements = {{
    {"ks", &MtlMaterial::specular},
    {"tf", &MtlMaterial::filter},
}};

/// Images of numbers and normals, and that of Ks.
constexpr std::array<std::pair<std::string_view, MtlImage>, 9> map_statements = {{
    {"map_ks", &MtlMaterial::specular_map},
    {"map_ns", &MtlMaterial::exponent_map},
    {"map_d", &MtlMaterial::dissolve_map},
    {"map_opacity", &MtlMaterial::dissolve_map},
    {"map_pr", &MtlMaterial::roughness_map},
    {"map_pm", &MtlMaterial::metallic_map},
    {"norm", &MtlMaterial::normal_map},
    {"map_norm", &MtlMaterial::normal_map},
    {"map_kn", &MtlMaterial::normal_map},
}};

/// The member that a statement fills in, or null.
template <class Statements>
auto member_of(const Statements& statements, std::string_view keyword) {
    const auto* const found =
        std::find_if(statements.begin(), statements.end(),
                     [&](const auto& statement) { return statement.first == keyword; });
    return found == statements.end() ? nullptr : found->second;
}

/// Options of an image by the number of words that follow.
struct MapOption {
    std::string_view name;
    std::size_t words;
    bool harmless;
};

constexpr std::array map_options = {
    MapOption{"-blendu", 1, true},      MapOption{"-blendv", 1, true},
    MapOption{"-boost", 1, true},       MapOption{"-texres", 1, true},
    MapOption{"-mm", 2, false},         MapOption{"-imfchan", 1, false},
    MapOption{"-type", 1, false},       MapOption{"-cc", 1, true},
    MapOption{"-colorspace", 1, false},
};

std::string lower(std::string_view text) {
    std::string result(text);
    std::transform(result.begin(), result.end(), result.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return result;
}

class MtlParser {
  public:
    using Materials = std::map<std::string, MtlMaterial, std::less<>>;

    MtlParser(std::string_view text, const std::string& file, WarningCollector& report,
              MaterialDetail detail, Materials& materials)
        : lines_(text, file), report_(report), detail_(detail), materials_(materials) {}

    void parse() {
        ObjStatement statement;
        while (lines_.next(statement)) read(statement);
    }

  private:
    void read(const ObjStatement& statement) {
        const std::string keyword = lower(statement.keyword);
        const std::string place = lines_.place(statement);
        if (keyword == "newmtl") {
            begin_material(statement, place);
        } else if (current_ == nullptr) {
            report_.once(place, "statements before the first 'newmtl' are ignored");
        } else if (keyword == "kd") {
            if (const auto colour = read_colour(statement.rest, place))
                current_->diffuse = clamped(*colour, 1.0F, place);
        } else if (keyword == "ke") {
            if (const auto colour = read_colour(statement.rest, place))
                current_->emission = clamped(*colour, std::numeric_limits<float>::max(), place);
        } else if (keyword == "map_kd") {
            current_->diffuse_map = read_map(statement.rest, place);
        } else if (keyword == "map_ke") {
            current_->emission_map = read_map(statement.rest, place);
        } else {
            if (detail_ == MaterialDetail::full) read_surface(keyword, statement.rest, place);
            report_unsimulated(keyword, statement.rest, place);
        }
    }

    /// What is not part of a diffuse surface.
    void read_surface(const std::string& keyword, std::string_view rest, const std::string& place) {
        if (const MtlNumber number = member_of(number_statements, keyword)) {
            current_->*number = read_number(rest, place);
        } else if (const MtlColour colour = member_of(colour_statements, keyword)) {
            if (const auto given = read_colour(rest, place))
                current_->*colour = clamped(*given, 1.0F, place);
        } else if (const MtlImage image = member_of(map_statements, keyword)) {
            current_->*image = read_map(rest, place, keyword != "map_ks");
        }
    }

    /// The number of a statement; nothing, with a warning, where it is none. `d` may have the
    /// option `-halo`.
    [[nodiscard]] std::optional<double> read_number(std::string_view rest,
                                                    const std::string& place) {
        std::string_view word = take_word(rest);
        if (lower(word) == "-halo") word = take_word(rest);
        double value = 0.0;
        if (read_obj_number(word, value) && std::isfinite(value)) return value;
        report_.count(place, {"number", "numbers"}, "not a finite number, ignored");
        return std::nullopt;
    }

    void begin_material(const ObjStatement& statement, const std::string& place) {
        reported_.clear();
        const auto [found, added] = materials_.try_emplace(std::string(statement.rest));
        if (added) {
            found->second.place = place;
            current_ = &found->second;
            return;
        }
        report_.count(place + " " + quote(statement.rest), mtl_material_unit,
                      "defined twice, the first definition is used");
        ignored_ = MtlMaterial();
        current_ = &ignored_;
    }

    /// `r g b`, or one number for all three; nothing for a spectrum.
    [[nodiscard]] std::optional<glm::vec3> read_colour(std::string_view rest,
                                                       const std::string& place) {
        std::string_view words = rest;
        const std::string first = lower(take_word(words));
        if (first == "spectral" || first == "xyz") {
            report_.count(place, {"colour", "colours"},
                          "given as " + quote(first) + ", ignored, expected r g b");
            return std::nullopt;
        }
        const std::vector<double> values = read_obj_numbers(rest, 3, place);
        if (values.empty()) throw input_error(place, "lacks its colour, expected r g b");
        glm::vec3 colour{0.0F};
        for (std::size_t i = 0; i < 3; ++i) {
            const double value = i < values.size() ? values[i] : values[0];
            if (!(std::abs(value) <= std::numeric_limits<float>::max()))
                throw input_error(place, "colour that is not finite, expected r g b");
            colour[static_cast<int>(i)] = static_cast<float>(value);
        }
        return colour;
    }

    [[nodiscard]] glm::vec3 clamped(const glm::vec3& colour, float most, const std::string& place) {
        const glm::vec3 inside = glm::clamp(colour, 0.0F, most);
        if (inside != colour)
            report_.count(place, {"colour", "colours"}, "outside of the range, clamped");
        return inside;
    }

    /// One number to `most`, but never the last word, which is the name of the file.
    [[nodiscard]] static std::vector<double> take_numbers(std::string_view& rest,
                                                          std::size_t most = 3) {
        std::vector<double> values;
        while (values.size() < most) {
            std::string_view after = rest;
            double value = 0.0;
            const std::string_view word = take_word(after);
            if (word.empty() || trim_blanks(after).empty() || !read_obj_number(word, value) ||
                !std::isfinite(value))
                break;
            values.push_back(value);
            rest = after;
        }
        return values;
    }

    /// An image of colours, or of numbers, of which an option may choose a channel.
    [[nodiscard]] std::optional<MtlMap> read_map(std::string_view rest, const std::string& place,
                                                 bool numbers = false) {
        MtlMap map;
        map.place = place;
        rest = trim_blanks(rest);
        while (rest.starts_with('-')) {
            std::string_view after = rest;
            const std::string option = lower(take_word(after));
            if (!read_map_option(option, after, map, numbers)) break;
            rest = trim_blanks(after);
        }
        if (rest.size() >= 2 && rest.front() == '"' && rest.back() == '"')
            rest = rest.substr(1, rest.size() - 2);
        if (rest.empty()) {
            report_.count(place, {"texture map", "texture maps"}, "no file is named, ignored");
            return std::nullopt;
        }
        map.file = rest;
        return map;
    }

    /// False where it is no option, but the start of a file name.
    [[nodiscard]] bool read_map_option(const std::string& option, std::string_view& rest,
                                       MtlMap& map, bool numbers) {
        if (option == "-o" || option == "-s" || option == "-t") {
            const std::vector<double> values = take_numbers(rest);
            if (option == "-t") report_option(map, option);
            glm::dvec2& target = option == "-s" ? map.scale : map.offset;
            for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 2); ++i)
                if (option != "-t") target[static_cast<int>(i)] = values[i];
            return true;
        }
        if (option == "-clamp") {
            map.clamp = lower(take_word(rest)) == "on";
            return true;
        }
        if (option == "-bm") {
            const std::vector<double> values = take_numbers(rest, 1);
            if (values.empty())
                static_cast<void>(take_word(rest));
            else
                map.strength = values[0];
            return true;
        }
        if (option == "-imfchan" && numbers) {
            const std::string channel = lower(take_word(rest));
            if (!channel.empty()) map.channel = channel.front();
            return true;
        }
        const auto* const known =
            std::find_if(map_options.begin(), map_options.end(),
                         [&](const MapOption& entry) { return entry.name == option; });
        if (known == map_options.end()) return false;
        for (std::size_t i = 0; i < known->words; ++i) static_cast<void>(take_word(rest));
        if (!known->harmless) report_option(map, option);
        return true;
    }

    void report_option(const MtlMap& map, const std::string& option) {
        report_.count(map.place, {"texture map", "texture maps"},
                      "option " + quote(option) + " is not simulated, ignored");
    }

    void report_unsimulated(const std::string& keyword, std::string_view rest,
                            const std::string& place) {
        const auto entry_of = [&](const auto& entries) -> const Unsimulated* {
            const auto* const found =
                std::find_if(entries.begin(), entries.end(),
                             [&](const Unsimulated& entry) { return entry.keyword == keyword; });
            return found != entries.end() ? found : nullptr;
        };
        const Unsimulated* known = entry_of(unsimulated);
        const Unsimulated* const diffuse = entry_of(undiffuse);
        if (detail_ == MaterialDetail::diffuse && diffuse != nullptr) known = diffuse;
        if (known == nullptr) {
            if (diffuse == nullptr &&
                std::find(passive.begin(), passive.end(), keyword) == passive.end())
                report_.once(place, "statement " + quote(keyword) + " is not known, ignored");
            return;
        }
        bool neutral = !std::isnan(known->neutral);
        for (std::string_view word = take_word(rest); neutral && !word.empty();
             word = take_word(rest)) {
            double value = 0.0;
            neutral = !read_obj_number(word, value) || value == known->neutral;
        }
        if (!neutral && reported_.insert(known->message).second)
            report_.count(place, mtl_material_unit, known->message);
    }

    ObjLines lines_;
    WarningCollector& report_;
    MaterialDetail detail_;
    Materials& materials_;
    MtlMaterial* current_ = nullptr;
    std::set<std::string_view> reported_;  ///< of the current material
    MtlMaterial ignored_;
};

}  // namespace

void parse_mtl(std::string_view text, const std::string& file, WarningCollector& report,
               MaterialDetail detail, std::map<std::string, MtlMaterial, std::less<>>& materials) {
    MtlParser(text, file, report, detail, materials).parse();
}

}  // namespace weft
