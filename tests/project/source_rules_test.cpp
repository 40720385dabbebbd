// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace weft::source_rules_test {
namespace {

namespace fs = std::filesystem;

struct SourceFile {
    std::string path;  // from the source folder, with forward slashes
    std::vector<std::string> lines;
};

std::vector<std::string> split_lines(std::istream& in) {
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::vector<SourceFile> all_source_files() {
    const fs::path root = WEFT_SOURCE_DIR;
    std::vector<SourceFile> files;
    for (const char* folder : {"host", "kernels", "tests", "bench"}) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp" && extension != ".cl") continue;
            std::ifstream in(entry.path());
            files.push_back(
                {entry.path().lexically_relative(root).generic_string(), split_lines(in)});
        }
    }
    return files;
}

/// host/base/error.h -> WEFT_BASE_ERROR_H, kernels/core/port.h -> WEFT_KERNELS_CORE_PORT_H
std::string guard_of(std::string path) {
    constexpr std::string_view host = "host/";
    if (path.starts_with(host)) path.erase(0, host.size());
    std::string guard = "WEFT_";
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        guard += std::isalnum(byte) ? static_cast<char>(std::toupper(byte)) : '_';
    }
    return guard;
}

/// What is wrong with a file, one line each; empty where nothing is.
std::string violations_of(const SourceFile& file) {
    constexpr std::size_t max_columns = 100;
    // Split, so that this file does not hold them itself.
    const std::array<std::string, 3> unfinished = {
        std::string("TO") + "DO", std::string("FIX") + "ME", std::string("HA") + "CK"};

    std::string found;
    const auto report = [&](std::size_t line, const std::string& message) {
        found += file.path + ":" + std::to_string(line) + ": " + message + "\n";
    };
    const std::vector<std::string>& lines = file.lines;
    if (lines.size() < 2 || lines[0] != "// Copyright 2026 The Weft Authors" ||
        lines[1] != "// SPDX-License-Identifier: Apache-2.0")
        report(1, "has no licence header, expected its two lines first");
    if (file.path.ends_with(".h")) {
        const std::string guard = guard_of(file.path);
        if (std::find(lines.begin(), lines.end(), "#ifndef " + guard) == lines.end() ||
            std::find(lines.begin(), lines.end(), "#define " + guard) == lines.end())
            report(3, "has no include guard, expected " + guard);
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        if (line.size() > max_columns) report(i + 1, "is wider than 100 columns");
        if (line.find('\t') != std::string::npos) report(i + 1, "holds a tab");
        if (line.ends_with(' ') || line.ends_with('\r')) report(i + 1, "ends in white space");
        for (const std::string& mark : unfinished)
            if (line.find(mark) != std::string::npos)
                report(i + 1, "is marked unfinished: " + mark);
    }
    return found;
}

TEST(SourceRules, EveryFileKeepsThem) {
    const std::vector<SourceFile> files = all_source_files();
    EXPECT_GT(files.size(), 5u);
    for (const SourceFile& file : files) EXPECT_EQ(violations_of(file), "");
}

TEST(SourceRules, RefuseABadFile) {
    const std::vector<std::string> header = {"// Copyright 2026 The Weft Authors",
                                             "// SPDX-License-Identifier: Apache-2.0"};
    const auto file = [&](const std::string& path, const std::vector<std::string>& more) {
        SourceFile made{path, header};
        made.lines.insert(made.lines.end(), more.begin(), more.end());
        return made;
    };
    EXPECT_EQ(violations_of(file("host/a.cpp", {"int x;"})), "");
    EXPECT_EQ(violations_of(
                  file("kernels/b.h", {"#ifndef WEFT_KERNELS_B_H", "#define WEFT_KERNELS_B_H"})),
              "");
    EXPECT_EQ(violations_of({"host/a.cpp", {"int x;", ""}}),
              "host/a.cpp:1: has no licence header, expected its two lines first\n");
    EXPECT_EQ(violations_of(file("host/base/e.h", {"#ifndef E_H", "#define E_H"})),
              "host/base/e.h:3: has no include guard, expected WEFT_BASE_E_H\n");
    EXPECT_EQ(violations_of(file("host/a.cpp", {std::string(101, 'a')})),
              "host/a.cpp:3: is wider than 100 columns\n");
    EXPECT_EQ(violations_of(file("host/a.cpp", {"\tint x;", "int y; "})),
              "host/a.cpp:3: holds a tab\nhost/a.cpp:4: ends in white space\n");
    EXPECT_EQ(violations_of(file("host/a.cpp", {std::string("// TO") + "DO later"})),
              std::string("host/a.cpp:3: is marked unfinished: TO") + "DO\n");
}

}  // namespace
}  // namespace weft::source_rules_test
