// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tradeoff/tradeoff_page.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <string_view>

#include "base/shell_word.h"
#include "tradeoff/html_text.h"
#include "tradeoff/page_equal_time.h"
#include "tradeoff/page_images.h"
#include "tradeoff/page_method.h"
#include "tradeoff/page_plots.h"
#include "tradeoff/page_style.h"
#include "tradeoff/page_tables.h"
#include "tradeoff/svg_plot.h"

namespace weft {
namespace {

/// Content security policy: whatever texts of the result contain, the page loads nothing.
constexpr std::string_view policy =
    R"(<meta http-equiv="Content-Security-Policy" )"
    R"(content="default-src 'none'; img-src data:; style-src 'unsafe-inline'"/>)";

std::string head(const TradeoffResult& result) {
    std::string text =
        "<!DOCTYPE html>\n"
        "<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\" xml:lang=\"en\">\n<head>\n"
        "<meta charset=\"utf-8\"/>\n";
    text += policy;
    text += "\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
    text += text_element("title", "What accuracy costs: " + result.scene);
    text += "\n<style>";
    text += plot_style();
    text += page_style();
    return text + "</style>\n</head>\n";
}

std::string introduction(const TradeoffResult& result) {
    std::set<std::string_view> families;
    for (const TradeoffPoint& point : result.points) families.insert(point.family);
    const std::string facts = fmt::format(
        "{} × {} pixels. {} settings of {} algorithms, each rendered {} times, against a "
        "reference of {} samples per pixel. The front goes by {}.",
        result.width, result.height, count_text(result.points.size()), families.size(),
        result.repetitions, count_text(result.reference.samples), label(result.measure));
    return "<header>\n" + text_element("h1", "What accuracy costs: " + result.scene) + "\n" +
           text_element("p", facts, R"(class="lead")") + "\n</header>\n";
}

std::string answers(const TradeoffResult& result) {
    std::string text = "<section>\n<h2>Answers</h2>\n";
    if (result.advice.empty()) return text + "<p>There is no advice.</p>\n</section>\n";
    text += "<ul class=\"answers\">\n";
    for (const TradeoffAdvice& advice : result.advice) {
        text += "<li>" + text_element("p", advice.sentence);
        if (!advice.preset_file.empty())
            text +=
                "<pre>" +
                text_element(
                    "code",
                    fmt::format(
                        "weft render {} --preset {}{} -o out.exr", shell_file(result.scene_path),
                        shell_file(
                            (std::filesystem::path(result.folder) / advice.preset_file).string()),
                        result.image_options)) +
                "</pre>";
        text += "</li>\n";
    }
    return text + "</ul>\n</section>\n";
}

}  // namespace

std::string tradeoff_page(const TradeoffResult& result) {
    return head(result) + "<body>\n" + introduction(result) + "<main>\n" + answers(result) +
           plots_section(result) + front_section(result) + images_section(result) +
           equal_time_section(result) + points_section(result) + method_section(result) +
           "</main>\n</body>\n</html>\n";
}

}  // namespace weft
