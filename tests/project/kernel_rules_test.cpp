// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/testing/kernel_rules.h"

#include <gtest/gtest.h>

#include "device/kernel_sources.h"

namespace weft::kernel_rules_test {
namespace {

std::string violations_of(std::string_view source, bool is_shim = false) {
    std::string all;
    for (const std::string& violation : kernel_rule_violations(source, is_shim))
        all += violation + "\n";
    return all;
}

TEST(KernelRules, EveryKernelSourceKeepsThem) {
    for (const KernelSource& source : kernel_sources()) {
        const bool is_shim = source.name.starts_with("core/port");
        EXPECT_EQ(violations_of(source.text, is_shim), "") << "in kernels/" << source.name;
    }
}

TEST(KernelRules, RefuseEveryForbiddenForm) {
    const std::vector<std::pair<std::string_view, std::string_view>> samples = {
        {"barrier(CLK_LOCAL_MEM_FENCE);", "barrier"},
        {"__local float tile[64];", "__local"},
        {"void f(local int* p);", "local"},
        {"printf(\"%d\", i);", "printf"},
        {"y = native_exp(x);", "native_exp"},
        {"y = half_sqrt(x);", "half_sqrt"},
        {"double d;", "double"},
        {"v = (float3)(a, b, c);", "float3"},
        {"v = (float4) (0.0f);", "float4"},
        {"v = (uint16){0};", "uint16"},
        {"v = a.xyz;", "xyz"},
        {"v.wx = b;", "wx"},
        {"v = p->xy;", "xy"},
        {"f = v.s3;", "s3"},
        {"v = a.s0a;", "s0a"},
        {"f = v.sb;", "sb"},
        {"v = a.lo;", "lo"},
        {"if (!p) return;", "p"},
        {"ok = !hit->valid;", "hit"},
        {"x = 1.0;", "1.0"},
        {"x = .5;", ".5"},
        {"x = 2.;", "2."},
        {"x = 1e-3;", "1e-3"},
        {"x = 0x1.8p+1;", "0x1.8p+1"},
    };
    for (const auto& [source, name] : samples) {
        const std::string expected = "3: '" + std::string(name) + "'";
        const std::string found = violations_of("\n\n" + std::string(source));
        EXPECT_TRUE(found.starts_with(expected)) << source << " gave: " << found;
    }
}

TEST(KernelRules, AcceptWhatOnlyLooksForbidden) {
    const std::vector<std::string_view> samples = {
        "// barrier, 1.0, (float3)(a, b, c) and v.xyz in a comment",
        "/* printf(\n 1.0 \n) */ int i;",
        "char* s = \"barrier 1.0\"; char c = '\\'';",
        "#if !defined(A) && !B\n#endif",
        "#define T(a) a \\\n    + !A",
        "x = 1.0f + .5F + 1e-3f + 2.f + 0x1.8p1f; i = 10u + 0x1e;",
        "if (a != b) return; ok = !is_valid(p); ok = !(a < b);",
        "float4 v = *(float4*)(p); n = (int)(x); v.x = w.w; s.start = t.s + u.seed;",
        "local_count = barrier_index + my_printf + sum.s0_total + native_scene(s);",
    };
    for (const std::string_view source : samples) EXPECT_EQ(violations_of(source), "") << source;
}

TEST(KernelRules, LetTheShimMakeVectorsButNotPrint) {
    EXPECT_EQ(violations_of("v = (float3)(a, b, c); w = v.xyz; if (!p) return;", true), "");
    EXPECT_NE(violations_of("printf(s);", true), "");
}

TEST(KernelRules, CountLinesThroughComments) {
    EXPECT_TRUE(violations_of("/* a\n b\n */ // c\nx = 1.0;").starts_with("4: '1.0'"));
}

}  // namespace
}  // namespace weft::kernel_rules_test
