// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/html_text.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace weft::html_text_test {
namespace {

TEST(HtmlText, EscapesMarkup) {
    EXPECT_EQ(escape_markup("<a href=\"x\">'&'</a>"),
              "&lt;a href=&quot;x&quot;&gt;&#39;&amp;&#39;&lt;/a&gt;");
    EXPECT_EQ(text_element("td", "<b>", "class=\"c\""), "<td class=\"c\">&lt;b&gt;</td>");
    EXPECT_EQ(text_element("td", ""), "<td></td>");
}

TEST(HtmlText, ReplacesWhatXmlDoesNotKnow) {
    const std::string bad = "\xEF\xBF\xBD";
    const std::string whole = "caf\xC3\xA9 \xE2\x82\xAC \xF0\x9F\x98\x80\t\n";
    EXPECT_EQ(escape_markup(whole), whole);
    EXPECT_EQ(escape_markup(std::string("a\0b\x1B", 4)), "a" + bad + "b" + bad);
    EXPECT_EQ(escape_markup("\xC3"), bad) << "cut";
    EXPECT_EQ(escape_markup("\xC3<"), bad + "&lt;") << "what follows is not swallowed";
    EXPECT_EQ(escape_markup("\xC0\xBC"), bad + bad) << "an overlong form of <";
    EXPECT_EQ(escape_markup("\xE0\x80\xBC"), bad + bad + bad) << "another";
    EXPECT_EQ(escape_markup("\xED\xA0\x80"), bad + bad + bad) << "a surrogate";
    EXPECT_EQ(escape_markup("\xEF\xBF\xBF"), bad + bad + bad) << "U+FFFF";
    EXPECT_EQ(escape_markup("\xF4\x90\x80\x80"), bad + bad + bad + bad) << "beyond U+10FFFF";
}

TEST(HtmlText, KeepsThreeDigits) {
    EXPECT_EQ(figure_text(0.0), "0");
    EXPECT_EQ(figure_text(1.0), "1.00");
    EXPECT_EQ(figure_text(9.996), "10.0");
    EXPECT_EQ(figure_text(123.4), "123");
    EXPECT_EQ(figure_text(170.0), "170");
    EXPECT_EQ(figure_text(999.7), "1000");
    EXPECT_EQ(figure_text(-0.012345), "-0.0123");
    EXPECT_EQ(figure_text(2.5e-7), "2.5e-07");
    for (const double value : {std::numeric_limits<double>::infinity(),
                               -std::numeric_limits<double>::infinity(), std::nan("")})
        EXPECT_EQ(figure_text(value), "\xE2\x80\x93");
    EXPECT_EQ(round_text(0.3), "0.3");
    EXPECT_EQ(round_text(4.0), "4");
    EXPECT_EQ(count_text(0), "0");
    EXPECT_EQ(count_text(999), "999");
    EXPECT_EQ(count_text(1234567),
              "1\xE2\x80\xAF"
              "234\xE2\x80\xAF"
              "567");
}

TEST(HtmlText, ShortCountsHaveThreeDigitsAndAPrefix) {
    const std::string space = "\u202F";
    EXPECT_EQ(short_count_text(0), "0");
    EXPECT_EQ(short_count_text(9999), "9999");
    EXPECT_EQ(short_count_text(10'000), "10.0" + space + "k");
    EXPECT_EQ(short_count_text(999'499), "999" + space + "k");
    EXPECT_EQ(short_count_text(999'600), "1.00" + space + "M");
    EXPECT_EQ(short_count_text(2'521'285), "2.52" + space + "M");
    EXPECT_EQ(short_count_text(~0ULL), "18.4" + space + "E");
}

TEST(HtmlText, CutsAtCharacters) {
    EXPECT_EQ(cut_text("four", 4), "four");
    EXPECT_EQ(cut_text("fifty", 4), "fif\xE2\x80\xA6");
    EXPECT_EQ(cut_text("\xC3\xA9\xC3\xA9\xC3\xA9", 2), "\xC3\xA9\xE2\x80\xA6");
}

}  // namespace
}  // namespace weft::html_text_test
