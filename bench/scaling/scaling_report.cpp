// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/scaling/scaling_report.h"

#include <fmt/format.h>

#include <optional>

#include "bench/scaling/least_squares.h"

namespace weft::bench {
namespace {

std::vector<double> abscissas(const AxisFrames& frames) {
    std::vector<double> x;
    for (const PointFrames& point : frames.points) x.push_back(point.x);
    return x;
}

/// How an error grows with x, as a power law; null where it is not known everywhere.
nlohmann::json error_exponent(const std::vector<double>& x,
                              const std::vector<std::optional<double>>& errors) {
    std::vector<double> known;
    for (const auto& error : errors)
        if (error) known.push_back(*error);
    if (known.size() != x.size()) return {};
    const auto power = fit_power(x, known);
    return power ? nlohmann::json(power->exponent) : nlohmann::json();
}

nlohmann::json method_json(const ScalingAxis& axis, const std::string& name, std::size_t method,
                           const AxisFrames& frames) {
    nlohmann::json points = nlohmann::json::array();
    std::vector<double> ms;
    std::vector<std::optional<double>> relmse;
    std::vector<std::optional<double>> hdrflip;
    for (const PointFrames& point : frames.points) {
        const MethodAtPoint& at = point.methods[method];
        ms.push_back(median(at.wall_ms));
        relmse.push_back(at.errors.relmse);
        hdrflip.push_back(at.errors.hdrflip);
        points.push_back({{"x", point.x},
                          {"triangles", point.triangles},
                          {"ms", ms.back()},
                          {"device_ms", median(at.device_ms)},
                          {"runs_ms", at.wall_ms},
                          {"rays", at.rays},
                          {"errors", at.errors.relmse ? at.errors.json() : nlohmann::json()}});
    }
    const std::vector<double> x = abscissas(frames);
    return {{"method", name},
            {"points", points},
            {"law", law_json(axis.law, x, ms)},
            {"relmse_exponent", error_exponent(x, relmse)},
            {"hdrflip_exponent", error_exponent(x, hdrflip)}};
}

nlohmann::json build_json(const ScalingAxis& axis, const AxisFrames& frames) {
    if (!axis.builds) return {};
    nlohmann::json points = nlohmann::json::array();
    std::vector<double> ms;
    for (const PointFrames& point : frames.points) {
        ms.push_back(median(point.build_ms));
        points.push_back({{"x", point.x}, {"ms", ms.back()}, {"runs_ms", point.build_ms}});
    }
    return {{"points", points}, {"law", law_json({LawKind::line}, abscissas(frames), ms)}};
}

std::string cell(const nlohmann::json& number, int width, int decimals) {
    return number.is_number() ? fmt::format("{:{}.{}f}", number.get<double>(), width, decimals)
                              : fmt::format("{:>{}}", "-", width);
}

nlohmann::json expected_at(const nlohmann::json& law, std::size_t point) {
    return law.is_object() ? law["expected"][point] : nlohmann::json();
}

std::string law_line(const std::string& name, const nlohmann::json& law) {
    if (!law.is_object()) return "";
    std::string text = fmt::format("  {}: {}", name, law["text"].get<std::string>());
    for (const auto& [key, value] : law["parameters"].items())
        text += fmt::format(", {} {:.4g}", key, value.get<double>());
    return text + fmt::format("; off by {:.1f} % (root mean square); as a power of x: {:.2f}\n",
                              100.0 * law["relative_rms"].get<double>(),
                              law["exponent"].get<double>());
}

}  // namespace

nlohmann::json axis_json(const ScalingAxis& axis, const std::vector<FrameMethod>& methods,
                         const AxisFrames& frames) {
    nlohmann::json of_methods = nlohmann::json::array();
    for (std::size_t m = 0; m < methods.size(); ++m)
        of_methods.push_back(method_json(axis, methods[m].name, m, frames));
    nlohmann::json references = nlohmann::json::array();
    for (const PointFrames& point : frames.points) references.push_back(point.reference);
    return {{"axis", axis.name},
            {"unit", axis.unit},
            {"setting", axis.setting},
            {"methods", of_methods},
            {"build", build_json(axis, frames)},
            {"references", references},
            {"left_out", frames.left_out}};
}

std::string axis_table(const nlohmann::json& axis) {
    std::string text =
        fmt::format("\n{}: {}\n  {:>14}", axis["axis"].get<std::string>(),
                    axis["setting"].get<std::string>(), axis["unit"].get<std::string>());
    const nlohmann::json& methods = axis["methods"];
    const nlohmann::json& build = axis["build"];
    for (const nlohmann::json& method : methods)
        text += fmt::format("{:>11}{:>11}{:>10}{:>9}", method["method"].get<std::string>() + " ms",
                            "expected", "relMSE", "FLIP");
    if (build.is_object()) text += fmt::format("{:>12}{:>12}", "build ms", "expected");
    text += "\n";
    for (std::size_t p = 0; p < methods.front()["points"].size(); ++p) {
        text += fmt::format("  {:14g}", methods.front()["points"][p]["x"].get<double>());
        for (const nlohmann::json& method : methods) {
            const nlohmann::json& point = method["points"][p];
            const nlohmann::json& errors = point["errors"];
            text += cell(point["ms"], 11, 2) + cell(expected_at(method["law"], p), 11, 2) +
                    cell(errors.is_object() ? errors["relmse"] : errors, 10, 5) +
                    cell(errors.is_object() ? errors["hdrflip"] : errors, 9, 4);
        }
        if (build.is_object())
            text +=
                cell(build["points"][p]["ms"], 12, 2) + cell(expected_at(build["law"], p), 12, 2);
        text += "\n";
    }
    for (const nlohmann::json& method : methods)
        text += law_line(method["method"].get<std::string>(), method["law"]);
    if (build.is_object()) text += law_line("build", build["law"]);
    for (const nlohmann::json& line : axis["left_out"])
        text += "  left out: " + line.get<std::string>() + "\n";
    return text;
}

nlohmann::json scaling_summary(const nlohmann::json& axes) {
    nlohmann::json summary = nlohmann::json::object();
    const auto add = [&](const nlohmann::json& axis, const std::string& name,
                         const nlohmann::json& law) {
        if (!law.is_object()) return;
        nlohmann::json& entry = summary[axis["axis"].get<std::string>()][name];
        entry = law["parameters"];
        entry["exponent"] = law["exponent"];
        entry["relative_rms"] = law["relative_rms"];
    };
    for (const nlohmann::json& axis : axes) {
        for (const nlohmann::json& method : axis["methods"])
            add(axis, method["method"].get<std::string>(), method["law"]);
        if (axis["build"].is_object()) add(axis, "build", axis["build"]["law"]);
    }
    return summary;
}

}  // namespace weft::bench
