// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/native/native_variants.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "device/executor.h"

namespace weft::native_variants_test {
namespace {

const std::vector<std::string_view>& listed_kernels() {
    static const std::vector<std::string_view> names{
#define WEFT_KERNEL_ENTRY(name, chunk, work) #name,
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
    };
    return names;
}

TEST(NativeVariants, AllHaveTheListedKernelsInOrder) {
    const std::vector<NativeVariant> variants = runnable_variants();
    ASSERT_FALSE(variants.empty());
    EXPECT_EQ(variants.front().isa, "base");
    for (const NativeVariant& variant : variants) {
        SCOPED_TRACE(testing::Message() << variant.isa << ", " << variant.lanes);
        ASSERT_EQ(variant.kernels.size(), listed_kernels().size());
        for (std::size_t k = 0; k < listed_kernels().size(); ++k) {
            EXPECT_EQ(variant.kernels[k].name, listed_kernels()[k]);
            EXPECT_EQ(kernel_name(static_cast<KernelId>(k)), listed_kernels()[k]);
            EXPECT_GT(kernel_chunk(static_cast<KernelId>(k)), 0u);
            EXPECT_NE(variant.kernels[k].run, nullptr);
        }
    }
}

TEST(NativeVariants, EveryWidthCanBeChosen) {
    for (const std::uint32_t lanes : {1U, 4U, 8U, 16U})
        EXPECT_EQ(choose_variant(lanes).lanes, lanes);
    for (const std::uint32_t lanes : {2U, 3U, 32U}) {
        try {
            (void)choose_variant(lanes);
            FAIL() << lanes << " lanes were found";
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ExitCode::device);
        }
    }
}

TEST(NativeVariants, TheDefaultIsTheNewestInstructionSet) {
    const std::vector<NativeVariant> variants = runnable_variants();
    const NativeVariant chosen = choose_variant(0);
    const bool newer = std::any_of(variants.begin(), variants.end(),
                                   [](const NativeVariant& v) { return v.isa != "base"; });
    EXPECT_EQ(chosen.isa != "base", newer);
    EXPECT_EQ(chosen.isa, variants.back().isa);
    EXPECT_GE(chosen.lanes, 4u);
}

TEST(NativeVariants, NoVariantIsThereTwice) {
    const std::vector<NativeVariant> variants = runnable_variants();
    for (std::size_t a = 0; a < variants.size(); ++a)
        for (std::size_t b = a + 1; b < variants.size(); ++b)
            EXPECT_FALSE(variants[a].isa == variants[b].isa &&
                         variants[a].lanes == variants[b].lanes);
}

}  // namespace
}  // namespace weft::native_variants_test
