// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "shared/shared_types.h"

#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "device/kernel_sources.h"
#if WEFT_HAS_OPENCL
#include "device/opencl/opencl_devices.h"
#endif

namespace weft::shared_types_test {
namespace {

struct Member {
    std::string name;
    std::size_t offset, bytes;
};

struct Layout {
    std::vector<Member> members;
    std::size_t bytes = 0;  // sum over members
};

std::string types_source() {
    for (const KernelSource& source : kernel_sources())
        if (source.name == "core/types.h") return std::string(source.text);
    throw std::runtime_error("types.h is not embedded");
}

/// The text after the #define of a number.
std::size_t number_of(const std::string& source, const std::string& name) {
    std::smatch match;
    if (!std::regex_search(source, match, std::regex("#define " + name + " ([0-9]+)")))
        throw std::runtime_error(name + " is not defined");
    return std::stoul(match[1]);
}

/// Adds the members of `uint a, b[6][8]`, or of a struct among `known`.
void add_members(const std::string& source, const std::map<std::string, Layout>& known,
                 const std::string& declaration, Layout& layout) {
    std::smatch match;
    if (!std::regex_match(declaration, match, std::regex("\\s*(\\w+)\\s+(.*)")))
        throw std::runtime_error("not a plain member: " + declaration);
    const auto structure = known.find(match[1]);
    if (structure == known.end() && match[1] != "float4" && match[1] != "float" &&
        match[1] != "uint")
        throw std::runtime_error("neither a scalar nor a struct declared before: " + declaration);
    const std::size_t scalar = structure != known.end() ? structure->second.bytes
                               : match[1] == "float4"   ? 16
                                                        : 4;
    const std::string names = match[2];
    const std::regex one("(\\w+)((?:\\[\\w+\\])*)");
    for (std::sregex_iterator it(names.begin(), names.end(), one), end; it != end; ++it) {
        std::size_t bytes = scalar;
        const std::string sizes = (*it)[2];
        const std::regex size("\\[(\\w+)\\]");
        for (std::sregex_iterator s(sizes.begin(), sizes.end(), size); s != end; ++s) {
            const std::string text = (*s)[1];
            bytes *= std::isdigit(static_cast<unsigned char>(text[0])) != 0
                         ? std::stoul(text)
                         : number_of(source, text);
        }
        layout.members.push_back({(*it)[1], layout.bytes, bytes});
        layout.bytes += bytes;
    }
}

/// Every struct of types.h, laid out as if no compiler ever put padding in.
std::map<std::string, Layout> unpadded_layouts(const std::string& source) {
    std::map<std::string, Layout> layouts;
    const std::string bare = std::regex_replace(source, std::regex("//[^\n]*"), "");
    const std::regex structure("typedef struct \\{([^}]*)\\} (\\w+);");
    for (std::sregex_iterator it(bare.begin(), bare.end(), structure), end; it != end; ++it) {
        Layout layout;
        std::istringstream body((*it)[1]);
        for (std::string declaration; std::getline(body, declaration, ';');)
            if (declaration.find_first_not_of(" \n") != std::string::npos)
                add_members(source, layouts, declaration, layout);
        layouts[(*it)[2]] = layout;
    }
    return layouts;
}

std::map<std::string, std::size_t> host_sizes() {
    using namespace shared;
    return {{"BvhNode", sizeof(BvhNode)},
            {"Triangle", sizeof(Triangle)},
            {"InstanceRecord", sizeof(InstanceRecord)},
            {"MaterialRecord", sizeof(MaterialRecord)},
            {"TextureRecord", sizeof(TextureRecord)},
            {"LightRecord", sizeof(LightRecord)},
            {"LightNode", sizeof(LightNode)},
            {"EmissiveTriangle", sizeof(EmissiveTriangle)},
            {"LightNode", sizeof(LightNode)},
            {"SurfaceMap", sizeof(SurfaceMap)},
            {"SurfaceRecord", sizeof(SurfaceRecord)},
            {"InterfaceRecord", sizeof(InterfaceRecord)},
            {"Vpl", sizeof(Vpl)},
            {"EnvironmentRecord", sizeof(EnvironmentRecord)},
            {"DensityGridRecord", sizeof(DensityGridRecord)},
            {"MediumRecord", sizeof(MediumRecord)},
            {"MediaRecord", sizeof(MediaRecord)},
            {"CacheRecord", sizeof(CacheRecord)},
            {"TileRecord", sizeof(TileRecord)},
            {"RayCounter", sizeof(RayCounter)},
            {"NonfiniteCounter", sizeof(NonfiniteCounter)},
            {"CameraParams", sizeof(CameraParams)},
            {"SceneParams", sizeof(SceneParams)},
            {"LightSampling", sizeof(LightSampling)},
            {"SamplingParams", sizeof(SamplingParams)},
            {"FilterParams", sizeof(FilterParams)},
            {"RenderParams", sizeof(RenderParams)},
            {"LaunchRange", sizeof(LaunchRange)},
            {"SetList", sizeof(SetList)},
            {"HemisphereGrid", sizeof(HemisphereGrid)},
            {"RecordUpdate", sizeof(RecordUpdate)},
            {"PathParams", sizeof(PathParams)}};
}

// Where the members' sizes add up to the struct's, no compiler has put anything between them, so
// that all compilers agree on every offset.
TEST(SharedTypes, NoPaddingOnTheHost) {
    const std::map<std::string, std::size_t> sizes = host_sizes();
    const std::map<std::string, Layout> layouts = unpadded_layouts(types_source());
    EXPECT_EQ(layouts.size(), sizes.size()) << "a struct of types.h is missing in this test";
    for (const auto& [name, layout] : layouts) {
        const auto size = sizes.find(name);
        ASSERT_NE(size, sizes.end()) << name << " is missing in this test";
        EXPECT_EQ(layout.bytes, size->second) << name << " is padded, expected explicit members";
        for (const Member& member : layout.members)
            if (member.bytes % 16 != 0) {
                EXPECT_EQ(member.offset % 4, 0u) << name << "." << member.name;
            }
    }
}

TEST(SharedTypes, OffsetsOnTheHost) {
    const std::map<std::string, Layout> layouts = unpadded_layouts(types_source());
    const auto offset = [&](const std::string& type, const std::string& member) {
        for (const Member& m : layouts.at(type).members)
            if (m.name == member) return m.offset;
        throw std::runtime_error(type + " has no member " + member);
    };
    EXPECT_EQ(offset("BvhNode", "child"), offsetof(shared::BvhNode, child));
    EXPECT_EQ(offset("LightRecord", "both_sides"), offsetof(shared::LightRecord, both_sides));
    EXPECT_EQ(offset("MaterialRecord", "texture"), offsetof(shared::MaterialRecord, texture));
    EXPECT_EQ(offset("CameraParams", "width"), offsetof(shared::CameraParams, width));
    EXPECT_EQ(offset("SamplingParams", "first_vpl"), offsetof(shared::SamplingParams, first_vpl));
    EXPECT_EQ(offset("RenderParams", "filter"), offsetof(shared::RenderParams, filter));
    EXPECT_EQ(offset("RenderParams", "features"), offsetof(shared::RenderParams, features));
}

#if WEFT_HAS_OPENCL

/// A kernel that writes the size of every struct, and offset and size of its members.
std::string probe_source(const std::map<std::string, Layout>& layouts) {
    std::string source = types_source() + "__kernel void probe(__global uint* out) {\n";
    for (const auto& [name, layout] : layouts) {
        source += "    {\n        " + name + " s;\n        *out++ = (uint)sizeof(" + name + ");\n";
        for (const Member& member : layout.members)
            source += "        *out++ = (uint)((const char*)&s." + member.name +
                      " - (const char*)&s);\n        *out++ = (uint)sizeof(s." + member.name +
                      ");\n";
        source += "    }\n";
    }
    return source + "}\n";
}

TEST(SharedTypes, DevicesLayThemOutAlike) {
    const std::vector<OpenClDevice> devices = opencl_devices();
    if (devices.empty()) GTEST_SKIP() << "there is no OpenCL device";
    const std::map<std::string, Layout> layouts = unpadded_layouts(types_source());
    std::vector<std::pair<std::string, std::size_t>> expected;
    for (const auto& [name, layout] : layouts) {
        expected.emplace_back("sizeof(" + name + ")", layout.bytes);
        for (const Member& member : layout.members) {
            expected.emplace_back("offset of " + name + "." + member.name, member.offset);
            expected.emplace_back("size of " + name + "." + member.name, member.bytes);
        }
    }
    for (const OpenClDevice& device : devices) {
        const cl::Context context(device.device);
        const cl::CommandQueue queue(context, device.device);
        const cl::Program program(context, probe_source(layouts));
        program.build({device.device}, "-cl-std=CL1.2");
        cl::Kernel kernel(program, "probe");
        std::vector<cl_uint> found(expected.size());
        const cl::Buffer out(context, CL_MEM_WRITE_ONLY, found.size() * sizeof(cl_uint));
        kernel.setArg(0, out);
        queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
        queue.enqueueReadBuffer(out, CL_TRUE, 0, found.size() * sizeof(cl_uint), found.data());
        for (std::size_t i = 0; i < expected.size(); ++i)
            EXPECT_EQ(found[i], expected[i].second)
                << expected[i].first << " on " << device.info.name;
    }
}

#endif

}  // namespace
}  // namespace weft::shared_types_test
