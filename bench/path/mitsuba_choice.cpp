// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/path/mitsuba_choice.h"

#include <nlohmann/json.hpp>

#include "base/error.h"
#include "bench/common/child_process.h"

namespace weft::bench {

std::string MitsubaChoice::text() const {
    if (!available()) return "No variant of Mitsuba works: " + problem;
    std::string found = "Mitsuba " + version + ", " + variant;
    if (!llvm.empty()) found += " with LLVM " + llvm;
    if (!library.empty()) found += " (" + library + ")";
    return found;
}

MitsubaChoice read_choice(const PythonPrograms& programs, const std::string& line) {
    MitsubaChoice choice;
    choice.programs = programs;
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object()) {
        choice.problem = "the program that looks for one says nothing that can be read";
        return choice;
    }
    const auto text = [](const nlohmann::json& object, const char* key) {
        const auto found = object.find(key);
        return found != object.end() && found->is_string() ? found->get<std::string>()
                                                           : std::string{};
    };
    choice.variant = text(json, "variant");
    choice.library = text(json, "library");
    choice.version = text(json, "version");
    choice.llvm = text(json, "llvm");
    choice.problem = text(json, "problem");
    for (const nlohmann::json& failed : json.value("failed", nlohmann::json::array())) {
        if (!failed.is_object()) continue;
        const std::string library = text(failed, "library");
        choice.failed.push_back(text(failed, "variant") + (library.empty() ? "" : ", ") + library +
                                ": " + text(failed, "problem"));
    }
    return choice;
}

MitsubaChoice choose_mitsuba(const PythonPrograms& programs, const std::string& variant) {
    std::vector<std::string> command{programs.python, "-B",
                                     programs.folder / "common" / "mitsuba_variant.py"};
    if (!variant.empty()) command.insert(command.end(), {"--variant", variant});
    MitsubaChoice none;
    none.programs = programs;
    try {
        ChildProcess child(command);
        const auto line = child.read_line();
        if (line) return read_choice(programs, *line);
        none.problem = child.fate();
    } catch (const Error& error) {
        none.problem = error.what();
    }
    return none;
}

}  // namespace weft::bench
