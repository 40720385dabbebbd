// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#if WEFT_HAS_OPENCL

#include "device/opencl/program_source.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "device/executor.h"
#include "device/kernel_sources.h"
#include "tests/testing/temporary_folder.h"

namespace weft::program_source_test {
namespace {

const std::vector<std::string>& kernels() {
    static const std::vector<std::string> names{
#define WEFT_KERNEL_ENTRY(name, chunk, work) #name,
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
    };
    return names;
}

std::size_t count_of(const std::string& text, const std::string& part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

/// Lines that define an include guard, and how often.
std::map<std::string, int> guards_of(const std::string& source) {
    std::map<std::string, int> guards;
    std::istringstream lines(source);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("#define WEFT_") && line.ends_with("_H")) ++guards[line];
    return guards;
}

TEST(ProgramSource, NoIncludeIsLeft) {
    for (const std::string& kernel : kernels()) {
        std::istringstream lines(program_source(kernel));
        for (std::string line; std::getline(lines, line);) {
            const std::size_t begin = line.find_first_not_of(" \t");
            if (begin == std::string::npos || line[begin] != '#') continue;
            EXPECT_EQ(line.find("include"), std::string::npos) << kernel << ": " << line;
        }
    }
}

TEST(ProgramSource, EveryHeaderComesOnce) {
    for (const std::string& kernel : kernels()) {
        const std::map<std::string, int> guards = guards_of(program_source(kernel));
        EXPECT_EQ(guards.count("#define WEFT_KERNELS_CORE_PORT_H"), 1u) << kernel;
        EXPECT_EQ(guards.count("#define WEFT_KERNELS_CORE_TYPES_H"), 1u) << kernel;
        for (const auto& [guard, count] : guards) EXPECT_EQ(count, 1) << kernel << ": " << guard;
    }
}

TEST(ProgramSource, HeadersPrecedeTheKernel) {
    for (const std::string& kernel : kernels()) {
        const std::string source = program_source(kernel);
        EXPECT_EQ(count_of(source, "WEFT_KERNEL(" + kernel + ")"), 1u) << kernel;
        EXPECT_LT(source.find("#define WEFT_KERNELS_CORE_PORT_H"),
                  source.find("WEFT_KERNEL(" + kernel + ")"))
            << kernel;
        EXPECT_LT(source.find("#define WEFT_KERNELS_CORE_TYPES_H"), source.find("void name("))
            << kernel;
    }
}

TEST(ProgramSource, NativeHalvesAreLeftOut) {
    for (const std::string& kernel : kernels()) {
        const std::string source = program_source(kernel);
        EXPECT_EQ(source.find("WEFT_KERNELS_CORE_PORT_NATIVE_H"), std::string::npos) << kernel;
        EXPECT_EQ(source.find("reinterpret_cast"), std::string::npos) << kernel;
    }
}

TEST(ProgramSource, HoldsNoPathAndOnlyAscii) {
    const std::string folder = WEFT_SOURCE_DIR;
    for (const std::string& kernel : kernels()) {
        const std::string source = program_source(kernel);
        EXPECT_EQ(source.find(folder), std::string::npos) << kernel;
        EXPECT_EQ(source.find("/kernels/"), std::string::npos) << kernel;
        for (const char c : source) {
            const auto byte = static_cast<unsigned char>(c);
            ASSERT_TRUE(byte == '\n' || (byte >= 0x20 && byte < 0x7f)) << kernel;
        }
    }
}

TEST(ProgramSource, EveryListedKernelIsEmbeddedAndListed) {
    std::size_t files = 0;
    for (const KernelSource& source : kernel_sources()) {
        EXPECT_FALSE(source.name.starts_with("/")) << source.name;
        EXPECT_EQ(source.name.find(".."), std::string_view::npos) << source.name;
        if (!source.name.ends_with(".cl")) continue;
        ++files;
        const std::string_view file = source.name.substr(source.name.rfind('/') + 1);
        const std::string name(file.substr(0, file.size() - 3));
        EXPECT_NE(std::find(kernels().begin(), kernels().end(), name), kernels().end()) << name;
    }
    EXPECT_EQ(files, kernels().size());
}

TEST(ProgramSource, FilesAreIncludedByTheirPathFromTheRoot) {
    constexpr std::string_view directive = "#include \"";
    constexpr std::string_view root = "kernels/";
    std::set<std::string> embedded;
    for (const KernelSource& source : kernel_sources()) embedded.emplace(source.name);
    for (const KernelSource& source : kernel_sources()) {
        std::istringstream lines{std::string(source.text)};
        for (std::string line; std::getline(lines, line);) {
            if (!line.starts_with(directive)) continue;
            std::string file = line.substr(directive.size());
            file.resize(file.find('"'));
            EXPECT_TRUE(file.starts_with(root)) << source.name << " includes " << file;
            file.erase(0, root.size());
            EXPECT_TRUE(embedded.contains(file)) << source.name << " includes " << file;
        }
    }
    const std::string walk = program_source("vpl_walk");
    EXPECT_EQ(count_of(walk, "#define WEFT_KERNELS_BSDF_BSDF_H"), 1U);
    EXPECT_EQ(count_of(walk, "#define WEFT_KERNELS_LIGHT_LIGHT_H"), 1U);
}

/// Sets WEFT_KERNELS for as long as it lives.
class KernelsInEnvironment {
  public:
    explicit KernelsInEnvironment(const std::string& folder) {
        setenv("WEFT_KERNELS", folder.c_str(), 1);
    }
    ~KernelsInEnvironment() { unsetenv("WEFT_KERNELS"); }
    KernelsInEnvironment(const KernelsInEnvironment&) = delete;
    KernelsInEnvironment& operator=(const KernelsInEnvironment&) = delete;
};

TEST(ProgramSource, AFolderMayTakeThePlaceOfTheEmbeddedFiles) {
    const std::string embedded = program_source("gbuffer");
    {
        const KernelsInEnvironment folder(WEFT_SOURCE_DIR "/kernels");
        EXPECT_EQ(program_source("gbuffer"), embedded);
    }
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder.path() / "film");
    std::ofstream(folder.path() / "film" / "gbuffer.cl")
        << "#include \"kernels/a.h\"\n#include \"kernels/a.h\"\nlast\n";
    std::ofstream(folder.path() / "a.h") << "first\n";
    const KernelsInEnvironment environment(folder.path().string());
    EXPECT_EQ(program_source("gbuffer"), "first\nlast\n");
    try {
        (void)program_source("compose");
        FAIL() << "a source was found";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::bad_input);
        EXPECT_NE(std::string(error.what()).find("compose.cl"), std::string::npos);
    }
}

TEST(ProgramSource, UnknownKernelsAreRefused) {
    try {
        (void)program_source("nothing");
        FAIL() << "a source was found";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::device);
        EXPECT_STREQ(error.what(), "kernel source nothing.cl is not embedded");
    }
}

}  // namespace
}  // namespace weft::program_source_test

#endif
