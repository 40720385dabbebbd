// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/fill_template.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

namespace weft::fill_template_test {
namespace {

using Json = nlohmann::json;

TEST(FillTemplate, PutsValuesInTheirPlaces) {
    const Json values = {{"name", "a"},
                         {"none", ""},
                         {"yes", true},
                         {"no", false},
                         {"empty", Json::array()},
                         {"parts", {{{"name", "b"}}, {{"other", "c"}}}},
                         {"texts", {"x", "y"}}};
    EXPECT_EQ(fill_template("{{name}}{{none}}{{no}}.", values), "a.");
    EXPECT_EQ(
        fill_template("{{#yes}}1{{/yes}}{{#no}}2{{/no}}{{#none}}3{{/none}}{{#empty}}4{{/empty}}",
                      values),
        "1");
    EXPECT_EQ(
        fill_template("{{^yes}}1{{/yes}}{{^no}}2{{/no}}{{^none}}3{{/none}}{{^empty}}4{{/empty}}",
                      values),
        "234");
    EXPECT_EQ(fill_template("{{#parts}}<{{name}}>{{/parts}}{{#texts}}{{.}}{{/texts}}", values),
              "<b><a>xy");
}

TEST(FillTemplate, TakesValuesForText) {
    const Json values = {{"value", "<{{name}}>\xFF"}, {"name", "a"}};
    EXPECT_EQ(fill_template("{{value}}", values), "&lt;{{name}}&gt;\xEF\xBF\xBD");
    EXPECT_EQ(fill_template("{{{value}}}", values), "<{{name}}>\xFF");
}

TEST(FillTemplate, RefusesMistakes) {
    const Json values = {{"name", "a"}, {"yes", true}};
    for (const char* text : {"{{name", "{{#yes}}", "{{/yes}}", "{{#yes}}{{#name}}{{/yes}}{{/name}}",
                             "{{nme}}", "{{#ye}}{{/ye}}", "{{^ye}}{{/ye}}", "{{>name}}", "{{=}}"})
        EXPECT_THROW(static_cast<void>(fill_template(text, values)), std::invalid_argument) << text;
    for (const Json& value : {Json(1.5), Json(2), Json()})
        EXPECT_THROW(static_cast<void>(fill_template("", {{"value", value}})),
                     std::invalid_argument);
}

}  // namespace
}  // namespace weft::fill_template_test
