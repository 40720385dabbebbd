// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/mitsuba/mitsuba_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <string_view>

#include "base/error.h"
#include "base/quote.h"

namespace weft::mitsuba {

namespace {

constexpr std::string_view blanks = " \t\r\n";

/// The colour of a spectrum of constant 1 as an emitter: equal-energy white in Rec.709.
constexpr glm::vec3 equal_energy_white(1.2047940F, 0.9482910F, 0.9089161F);

std::string_view trim(std::string_view text) {
    const std::size_t begin = std::min(text.find_first_not_of(blanks), text.size());
    text.remove_prefix(begin);
    return text.substr(0, text.find_last_not_of(blanks) + 1);
}

double parse_word(const Element& element, std::string_view word) {
    std::string_view digits = word;
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    double value = 0.0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, code] = std::from_chars(digits.data(), end, value);
    const bool whole = code == std::errc() && stop == end;
    if (!whole || !(std::abs(value) <= std::numeric_limits<float>::max()))
        throw input_error(element.place(),
                          "bad number " + quote(word) + ", expected a finite decimal number");
    return value;
}

glm::dvec3 parse_triple(const Element& element, const std::string& attribute) {
    const std::string& text = element.required(attribute);
    const std::vector<double> numbers = parse_numbers(element, text, 3);
    if (numbers.size() != 3)
        throw input_error(element.place(),
                          fmt::format("{} has {} numbers in {}, expected 3", quote(attribute),
                                      numbers.size(), quote(text)));
    return {numbers[0], numbers[1], numbers[2]};
}

glm::dmat4 parse_lookat(const Element& element) {
    const glm::dvec3 origin = parse_triple(element, "origin");
    const glm::dvec3 target = parse_triple(element, "target");
    const glm::dvec3 forward = target - origin;
    const glm::dvec3 up = element.attribute("up") != nullptr ? parse_triple(element, "up")
                                                             : glm::dvec3(0.0, 1.0, 0.0);
    if (glm::length(forward) == 0.0)
        throw input_error(element.place(),
                          "lookat origin and target are the same point, expected "
                          "two points");
    const glm::dvec3 direction = glm::normalize(forward);
    const glm::dvec3 left = glm::cross(up, direction);
    if (!(glm::length(left) > 1e-12 * glm::length(up)))
        throw input_error(element.place(),
                          "lookat 'up' is zero or along the view, expected another direction");
    const glm::dvec3 left_unit = glm::normalize(left);
    return {glm::dvec4(left_unit, 0.0), glm::dvec4(glm::cross(direction, left_unit), 0.0),
            glm::dvec4(direction, 0.0), glm::dvec4(origin, 1.0)};
}

glm::dmat4 parse_matrix(const Element& element) {
    const std::vector<double> numbers = parse_numbers(element, element.required("value"), 16);
    if (numbers.size() != 16 && numbers.size() != 9)
        throw input_error(element.place(),
                          fmt::format("matrix of {} numbers, expected 16 or 9", numbers.size()));
    const std::size_t size = numbers.size() == 16 ? 4 : 3;
    glm::dmat4 matrix(1.0);
    for (std::size_t row = 0; row < size; ++row) {
        for (std::size_t column = 0; column < size; ++column) {
            matrix[static_cast<int>(column)][static_cast<int>(row)] = numbers[row * size + column];
        }
    }
    if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0)
        throw input_error(element.place(), "projective matrix, expected the last row 0 0 0 1");
    return matrix;
}

glm::dmat4 parse_step(const Element& element) {
    const glm::dmat4 identity(1.0);
    if (element.tag == "translate") return glm::translate(identity, parse_vector(element, 0.0));
    if (element.tag == "scale") return glm::scale(identity, parse_vector(element, 1.0));
    if (element.tag == "lookat") return parse_lookat(element);
    if (element.tag == "matrix") return parse_matrix(element);
    if (element.tag == "rotate") {
        const double angle = parse_number(element, element.required("angle"));
        const glm::dvec3 axis = parse_vector(element, 0.0);
        if (glm::length(axis) == 0.0)
            throw input_error(element.place(), "rotation about a zero axis, expected x, y or z");
        return glm::rotate(identity, glm::radians(angle), axis);
    }
    throw input_error(element.place(), "element " + quote(element.tag) +
                                           " in a transform, expected translate, scale, rotate, "
                                           "lookat or matrix");
}

double child_number(const Element& element, const std::string& name, double missing) {
    for (const Element& child : element.children) {
        const std::string* const child_name = child.attribute("name");
        if (child.tag == "float" && child_name != nullptr && *child_name == name)
            return parse_number(child, child.required("value"));
    }
    return missing;
}

/// `400:0.1, 500:0.2`: the mean of the values.
double mean_of_samples(const Element& element, const std::string& text) {
    std::string numbers = text;
    std::replace(numbers.begin(), numbers.end(), ':', ' ');
    const std::vector<double> pairs =
        parse_numbers(element, numbers, std::numeric_limits<std::size_t>::max());
    if (pairs.empty() || pairs.size() % 2 != 0)
        throw input_error(element.place(),
                          "bad spectrum " + quote(text) + ", expected wavelength:value pairs");
    double sum = 0.0;
    for (std::size_t i = 1; i < pairs.size(); i += 2) sum += pairs[i];
    return sum / (static_cast<double>(pairs.size()) / 2.0);
}

glm::vec3 parse_spectrum(const Element& element, ColourUse use, Warnings& warnings) {
    const std::string* const value = element.attribute("value");
    if (value != nullptr && value->find(':') != std::string::npos) {
        warnings.count(element, {"spectrum", "spectra"},
                       "variation with wavelength is not simulated, the mean is used");
        return glm::vec3(static_cast<float>(mean_of_samples(element, *value)));
    }
    if (value != nullptr) {
        const glm::vec3 white = use == ColourUse::emission ? equal_energy_white : glm::vec3(1.0F);
        return white * static_cast<float>(parse_number(element, *value));
    }
    const std::string* const type = element.attribute("type");
    if (type != nullptr && *type == "uniform")
        return glm::vec3(static_cast<float>(child_number(element, "value", 1.0)));
    if (type != nullptr && *type == "d65")
        return glm::vec3(static_cast<float>(child_number(element, "scale", 1.0)));
    const float grey = use == ColourUse::reflectance ? 0.5F : 1.0F;
    warnings.count(element, {"spectrum", "spectra"},
                   fmt::format("type {} is not supported, grey {} is used instead",
                               quote(type != nullptr ? *type : "from a file"), grey));
    return glm::vec3(grey);
}

}  // namespace

double parse_number(const Element& element, const std::string& text) {
    return parse_word(element, trim(text));
}

std::vector<double> parse_numbers(const Element& element, const std::string& text,
                                  std::size_t most) {
    constexpr std::string_view separators = " \t\r\n,";
    std::vector<double> numbers;
    std::string_view rest = text;
    while (true) {
        rest.remove_prefix(std::min(rest.find_first_not_of(separators), rest.size()));
        if (rest.empty()) return numbers;
        if (numbers.size() == most)
            throw input_error(element.place(), fmt::format("too many numbers in {}, expected {}",
                                                           quote(text), most));
        const std::size_t length = std::min(rest.find_first_of(separators), rest.size());
        numbers.push_back(parse_word(element, rest.substr(0, length)));
        rest.remove_prefix(length);
    }
}

long parse_integer(const Element& element) {
    const std::string_view text = trim(element.required("value"));
    long value = 0;
    const auto [stop, code] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (code != std::errc() || stop != text.data() + text.size())
        throw input_error(element.place(), "bad number " + quote(text) + ", expected an integer");
    return value;
}

bool parse_boolean(const Element& element) {
    const std::string_view text = trim(element.required("value"));
    if (text == "true") return true;
    if (text == "false") return false;
    throw input_error(element.place(), "bad boolean " + quote(text) + ", expected true or false");
}

glm::dvec3 parse_vector(const Element& element, double missing) {
    if (const std::string* const value = element.attribute("value")) {
        const std::vector<double> numbers = parse_numbers(element, *value, 3);
        if (numbers.size() == 1 && element.tag == "scale") return glm::dvec3(numbers[0]);
        return parse_triple(element, "value");
    }
    const auto coordinate = [&](const char* name) {
        const std::string* const text = element.attribute(name);
        return text == nullptr ? missing : parse_number(element, *text);
    };
    return {coordinate("x"), coordinate("y"), coordinate("z")};
}

glm::dmat4 parse_transform(const Element& element) {
    glm::dmat4 matrix(1.0);
    for (const Element& step : element.children) matrix = parse_step(step) * matrix;
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(matrix[column][row]))
                throw input_error(element.place(),
                                  "the transform overflows, expected numbers of "
                                  "a moderate size");
        }
    }
    return matrix;
}

glm::vec3 parse_colour(const Element& element, ColourUse use, Warnings& warnings) {
    glm::vec3 colour(0.0F);
    if (element.tag == "spectrum") {
        colour = parse_spectrum(element, use, warnings);
    } else {
        const std::string& text = element.required("value");
        const std::vector<double> numbers =
            parse_numbers(element, text, element.tag == "float" ? 1 : 3);
        if (numbers.size() != 1 && numbers.size() != 3)
            throw input_error(element.place(),
                              "bad colour " + quote(text) + ", expected 1 or 3 numbers");
        for (int i = 0; i < 3; ++i)
            colour[i] = static_cast<float>(
                numbers[numbers.size() == 3 ? static_cast<std::size_t>(i) : std::size_t{0}]);
    }
    const bool negative = glm::any(glm::lessThan(colour, glm::vec3(0.0F)));
    const bool above_one = glm::any(glm::greaterThan(colour, glm::vec3(1.0F)));
    if (negative || (use == ColourUse::reflectance && above_one))
        throw input_error(element.place(), use == ColourUse::reflectance
                                               ? "reflectance outside of its range, expected 0 to 1"
                                               : "negative colour, expected numbers from 0 on");
    if (!std::isfinite(colour.r + colour.g + colour.b))
        throw input_error(element.place(), "colour too large, expected less");
    return colour;
}

bool is_colour(const Element& element) {
    return element.tag == "rgb" || element.tag == "spectrum" || element.tag == "float";
}

}  // namespace weft::mitsuba
