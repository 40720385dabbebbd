// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_JSON_VALUE_H
#define WEFT_BASE_JSON_VALUE_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "base/error.h"

namespace weft {

/// A value inside a glTF file together with its place (`file#/json/pointer`). Every access checks
/// the type and throws Error (exit code 2) with that place. Refers to the JSON tree, does not own
/// it.
class JsonValue {
  public:
    JsonValue(const nlohmann::json& value, std::string place);

    [[nodiscard]] const std::string& place() const { return place_; }

    /// The error for this place, to be thrown by the caller.
    [[nodiscard]] Error error(const std::string& message) const {
        return input_error(place_, message);
    }

    /// Member of an object, if it is there.
    [[nodiscard]] std::optional<JsonValue> find(const char* key) const;
    /// Member of an object that must be there.
    [[nodiscard]] JsonValue at(const char* key) const;
    /// Extension object `extensions/<name>`, if it is there.
    [[nodiscard]] std::optional<JsonValue> extension(const char* name) const;

    /// Number of elements; the value must be an array.
    [[nodiscard]] std::size_t size() const;
    /// Element of an array, `index` < size().
    [[nodiscard]] JsonValue element(std::size_t index) const;
    /// Number of elements of the array member `key`, 0 where it is missing.
    [[nodiscard]] std::size_t size_of(const char* key) const;

    [[nodiscard]] double as_number() const;
    [[nodiscard]] const std::string& as_string() const;
    [[nodiscard]] bool as_bool() const;
    /// A whole number in [0, 2^53].
    [[nodiscard]] std::uint64_t as_integer() const;
    /// A whole number below `count`, the number of `what` that this value chooses from.
    [[nodiscard]] std::size_t as_index(std::size_t count, const char* what) const;

    [[nodiscard]] double number_or(const char* key, double otherwise) const;
    [[nodiscard]] std::string string_or(const char* key, const std::string& otherwise) const;
    /// Member `name`, cut to `limits::max_name_bytes` since names are copied to whatever is placed;
    /// `otherwise` where it is missing or empty.
    [[nodiscard]] std::string name_or(const std::string& otherwise) const;
    [[nodiscard]] bool bool_or(const char* key, bool otherwise) const;
    [[nodiscard]] std::uint64_t integer_or(const char* key, std::uint64_t otherwise) const;

    /// Array member of exactly N numbers, or `otherwise` where it is missing.
    template <std::size_t N>
    [[nodiscard]] std::array<double, N> numbers_or(const char* key,
                                                   const std::array<double, N>& otherwise) const {
        const std::optional<JsonValue> member = find(key);
        if (!member) return otherwise;
        member->expect_size(N);
        std::array<double, N> result{};
        for (std::size_t i = 0; i < N; ++i) result[i] = member->element(i).as_number();
        return result;
    }

  private:
    void expect_object() const;
    void expect_size(std::size_t size) const;

    const nlohmann::json* value_;
    std::string place_;
};

}  // namespace weft

#endif
