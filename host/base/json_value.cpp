// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/json_value.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/limits.h"

namespace weft {

JsonValue::JsonValue(const nlohmann::json& value, std::string place)
    : value_(&value), place_(std::move(place)) {}

void JsonValue::expect_object() const {
    if (!value_->is_object())
        throw error(std::string("is of type ") + value_->type_name() + ", expected an object");
}

void JsonValue::expect_size(std::size_t size_expected) const {
    if (size() != size_expected)
        throw error("has " + std::to_string(size()) + " elements, expected " +
                    std::to_string(size_expected));
}

std::optional<JsonValue> JsonValue::find(const char* key) const {
    expect_object();
    const auto member = value_->find(key);
    if (member == value_->end()) return std::nullopt;
    return JsonValue(*member, place_ + "/" + key);
}

JsonValue JsonValue::at(const char* key) const {
    std::optional<JsonValue> member = find(key);
    if (!member) throw error(std::string("lacks '") + key + "', which is required");
    return *std::move(member);
}

std::optional<JsonValue> JsonValue::extension(const char* name) const {
    const std::optional<JsonValue> extensions = find("extensions");
    return extensions ? extensions->find(name) : std::nullopt;
}

std::size_t JsonValue::size() const {
    if (!value_->is_array())
        throw error(std::string("is of type ") + value_->type_name() + ", expected an array");
    return value_->size();
}

JsonValue JsonValue::element(std::size_t index) const {
    if (index >= size())
        throw error("has " + std::to_string(size()) + " elements, element " +
                    std::to_string(index) + " was asked for");
    return {(*value_)[index], place_ + "/" + std::to_string(index)};
}

std::size_t JsonValue::size_of(const char* key) const {
    const std::optional<JsonValue> member = find(key);
    return member ? member->size() : 0;
}

double JsonValue::as_number() const {
    if (!value_->is_number())
        throw error(std::string("is of type ") + value_->type_name() + ", expected a number");
    const double number = value_->get<double>();
    if (!std::isfinite(number)) throw error("is not a finite number");
    return number;
}

const std::string& JsonValue::as_string() const {
    if (!value_->is_string())
        throw error(std::string("is of type ") + value_->type_name() + ", expected a string");
    return value_->get_ref<const std::string&>();
}

bool JsonValue::as_bool() const {
    if (!value_->is_boolean())
        throw error(std::string("is of type ") + value_->type_name() + ", expected true or false");
    return value_->get<bool>();
}

std::uint64_t JsonValue::as_integer() const {
    constexpr double largest = 9007199254740992.0;  // 2^53, exact in the doubles JSON is made of
    const double number = as_number();
    if (number < 0.0 || number > largest || number != std::floor(number))
        throw error("is " + value_->dump() + ", expected a whole number that is not negative");
    return static_cast<std::uint64_t>(number);
}

std::size_t JsonValue::as_index(std::size_t count, const char* what) const {
    const std::uint64_t index = as_integer();
    if (index >= count)
        throw error("is " + std::to_string(index) + ", but there are only " +
                    std::to_string(count) + " " + what);
    return static_cast<std::size_t>(index);
}

double JsonValue::number_or(const char* key, double otherwise) const {
    const std::optional<JsonValue> member = find(key);
    return member ? member->as_number() : otherwise;
}

std::string JsonValue::string_or(const char* key, const std::string& otherwise) const {
    const std::optional<JsonValue> member = find(key);
    return member ? member->as_string() : otherwise;
}

std::string JsonValue::name_or(const std::string& otherwise) const {
    const std::optional<JsonValue> member = find("name");
    if (!member || member->as_string().empty()) return otherwise;
    const std::string& name = member->as_string();
    std::size_t length = std::min(name.size(), limits::max_name_bytes);
    // Not inside a character of UTF-8, whose further bytes all begin with the bits 10.
    while (length < name.size() && length > 0 &&
           (static_cast<unsigned char>(name[length]) & 0xC0U) == 0x80U)
        --length;
    return name.substr(0, length);
}

bool JsonValue::bool_or(const char* key, bool otherwise) const {
    const std::optional<JsonValue> member = find(key);
    return member ? member->as_bool() : otherwise;
}

std::uint64_t JsonValue::integer_or(const char* key, std::uint64_t otherwise) const {
    const std::optional<JsonValue> member = find(key);
    return member ? member->as_integer() : otherwise;
}

}  // namespace weft
