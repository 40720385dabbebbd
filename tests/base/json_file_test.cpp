// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/json_file.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/limits.h"
#include "tests/testing/temporary_folder.h"

namespace weft::json_file_test {
namespace {

using nlohmann::json;

constexpr std::size_t enough = std::size_t{1} << 20;

class JsonFile : public testing::Test {
  protected:
    [[nodiscard]] json read(const std::string& text, std::size_t max_bytes = enough) const {
        return read_json_file(folder_.write("a.json", text), max_bytes);
    }

    /// The message of what must be refused, from the name of the file on.
    template <class Use>
    [[nodiscard]] static std::string message_of(const Use& use) {
        try {
            use();
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::bad_input);
            const std::string message = error.what();
            for (const char c : message) EXPECT_GE(static_cast<unsigned char>(c), 0x20) << message;
            const std::size_t name = message.find("a.json");
            return name == std::string::npos ? message : message.substr(name);
        }
        return "no failure";
    }
    [[nodiscard]] std::string refusal(const std::string& text,
                                      std::size_t max_bytes = enough) const {
        return message_of([&] { (void)read(text, max_bytes); });
    }

    TemporaryFolder folder_;
};

/// `value` in so many arrays.
std::string nested(std::size_t levels, const std::string& value) {
    return std::string(levels, '[') + value + std::string(levels, ']');
}

TEST_F(JsonFile, ReadsWhatIsSound) {
    EXPECT_EQ(read(R"({"a": [1, 2.5, "x", true, null], "b": {"a": {}}})"),
              (json{{"a", {1, 2.5, "x", true, nullptr}}, {"b", {{"a", json::object()}}}}));
    EXPECT_EQ(read("3"), 3);
    EXPECT_EQ(read("\xEF\xBB\xBF[]"), json::array())
        << "the mark of an encoding is no syntax error";
}

TEST_F(JsonFile, IsAsLongAsItMayBeAndNoLonger) {
    const std::string text = "[1, 2, 3]";
    EXPECT_EQ(read(text, text.size()).size(), 3U);
    EXPECT_EQ(refusal(text, text.size() - 1), "a.json: is longer than the limit of 8 bytes");
}

TEST_F(JsonFile, IsAsDeepAsItMayBeAndNoDeeper) {
    const auto most = static_cast<std::size_t>(limits::max_nesting);
    EXPECT_EQ(read(nested(most, "1")).size(), 1U);
    const std::string too_deep = "a.json: JSON is nested deeper than 128 levels";
    EXPECT_EQ(refusal(nested(most + 1, "1")), too_deep);
    // Refused at the first level too many, whatever follows: a parser that recurses would have
    // overflowed its stack.
    EXPECT_EQ(refusal(std::string(enough, '[')), too_deep);
    std::string objects;
    for (std::size_t i = 0; i <= most; ++i) objects += R"({"a":)";
    EXPECT_EQ(refusal(objects), too_deep);
}

TEST_F(JsonFile, NamesTheLineOfASyntaxError) {
    const std::vector<std::pair<std::string, int>> cases{{"", 1},
                                                         {"{", 1},
                                                         {"[1,]", 1},
                                                         {"{\n\n oops}", 3},
                                                         {"[1\n2]", 2},
                                                         {"{\"a\": 1}\n\n\n{}", 4},
                                                         {"{'a': 1}", 1},
                                                         {"[1, // one\n 2]", 1},
                                                         {"[\n\"\xFF\"]", 2},
                                                         {"[NaN]", 1},
                                                         {"[01]", 1},
                                                         {std::string("[1]\n\0]", 6), 2}};
    for (const auto& [text, line] : cases)
        EXPECT_EQ(refusal(text), "a.json:" + std::to_string(line) + ": JSON syntax error") << text;
}

TEST_F(JsonFile, RefusesNumbersBeyondADouble) {
    const auto too_large = [](const std::string& place, const std::string& number) {
        return place + ": the number '" + number + "' is too large, expected at most 1.8e308";
    };
    EXPECT_EQ(refusal("1e400"), too_large("a.json:1", "1e400"));
    EXPECT_EQ(refusal("[\n\n1, -1e999]"), too_large("a.json:3", "-1e999"));
    EXPECT_EQ(refusal("{\"a\": 1,\n\"b\": 123e4567\n}\n"), too_large("a.json:2", "123e4567"));
    EXPECT_EQ(refusal("[\n1" + std::string(400, '0') + "]"),
              too_large("a.json:2", "1" + std::string(79, '0') + "..."));
    EXPECT_EQ(read("1e-400"), 0.0);
}

TEST_F(JsonFile, RefusesAKeyThatIsThereTwice) {
    const std::string twice = "a.json: JSON has an object with the key 'a' twice, expected it once";
    for (const char* const text : {R"({"a": 1, "a": 2})", R"({"a": 1, "b": {"a": 2}, "a": 3})",
                                   R"([[{"b": {"a": 1, "a": 1}}]])", R"({"a": 1, "\u0061": 2})",
                                   R"({"b": [{"a": {}}, {"a": {}, "c": 0, "a": {}}]})"})
        EXPECT_EQ(refusal(text), twice) << text;
    EXPECT_EQ(read(R"({"a": {"a": [{"a": 1}, {"a": 1}]}, "b": {"a": 1}})")["b"]["a"], 1)
        << "the same key of several objects";
    EXPECT_EQ(refusal(R"({"x\ny": 1, "x\ny": 1})"),
              "a.json: JSON has an object with the key 'x?y' twice, expected it once");
}

TEST_F(JsonFile, RefusesWhatIsNoFile) {
    EXPECT_NE(message_of([&] {
                  (void)read_json_file(folder_.path(), enough);
              }).find("is not a regular file"),
              std::string::npos);
    EXPECT_NE(message_of([&] {
                  (void)read_json_file(folder_.path() / "a.json", enough);
              }).find("cannot be opened"),
              std::string::npos);
}

TEST_F(JsonFile, PlacesOfValuesAreTheirPointers) {
    const json content = read(R"({"a": [{"b": 1}, {"b": "x"}], "c": 1.5, "d": -1, "e": 1e300})");
    const JsonValue value(content, "a.json#");
    const auto place = [&](const auto& use) { return message_of([&] { (void)use(); }); };
    const JsonValue second = value.at("a").element(1);
    EXPECT_EQ(place([&] { return second.at("b").as_number(); }),
              "a.json#/a/1/b: is of type string, expected a number");
    EXPECT_EQ(place([&] { return second.at("b").as_bool(); }),
              "a.json#/a/1/b: is of type string, expected true or false");
    EXPECT_EQ(place([&] { return second.at("b").size(); }),
              "a.json#/a/1/b: is of type string, expected an array");
    EXPECT_EQ(place([&] { return second.at("b").find("x"); }),
              "a.json#/a/1/b: is of type string, expected an object");
    EXPECT_EQ(place([&] { return second.as_string(); }),
              "a.json#/a/1: is of type object, expected a string");
    EXPECT_EQ(place([&] { return second.at("x"); }), "a.json#/a/1: lacks 'x', which is required");
    for (const char* const key : {"c", "d", "e"})
        EXPECT_EQ(place([&] {
                      return value.at(key).as_integer();
                  }).find(std::string("a.json#/") + key + ": is "),
                  0U)
            << key;
}

TEST_F(JsonFile, KnowsTheKeysOfAnObject) {
    const json content = read(R"({"a": 1, "b\u0007": 2})");
    const JsonValue value(content, "a.json#");
    EXPECT_EQ(message_of([&] {
                  check_keys(value, content, {"a", "c"});
              }),
              "a.json#: has the unknown key 'b?', expected 'a', 'c'");
    EXPECT_NO_THROW(check_keys(value, content, {"a", "b\a", "c"}));
    EXPECT_EQ(list_of({"a"}), "'a'");
    EXPECT_EQ(list_of({}), "");
}

// What was written is read back, to the bit.
TEST_F(JsonFile, NumbersSurvive) {
    const json numbers = {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, 9007199254740993, -0.0};
    EXPECT_EQ(read(numbers.dump()).dump(), numbers.dump());
}

}  // namespace
}  // namespace weft::json_file_test
