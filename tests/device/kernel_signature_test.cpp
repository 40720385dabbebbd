// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/kernel_signature.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "device/launch.h"
#include "device/native/native_executor.h"

// Launches are checked against the signatures of kernels/core/signatures.h: by their types where
// they are made of them (tests/device/launch_errors_check.sh), and here where they are put together
// by hand.
namespace weft::kernel_signature_test {
namespace {

constexpr KernelId kernel = KernelId::shadow_edges;  // takes two buffers and traces nothing

/// Text of the Error that the check throws for a launch of `kernel`, or "accepted".
std::string verdict(KernelId of, const TracedScene* scene,
                    const std::vector<LaunchArgument>& arguments) {
    const shared::RenderParams params{};
    try {
        check_arguments({of, params, scene, arguments, 1});
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::device);
        return error.what();
    }
    return "accepted";
}

class KernelSignature : public testing::Test {
  protected:
    std::unique_ptr<Executor> executor_ = make_native_executor(NativeTraversal::own_bvh, 1);
    std::unique_ptr<Buffer> memory_ = executor_->allocate(64, "test");
};

TEST_F(KernelSignature, HandMadeLaunchesAreHeldAgainstTheDeclaration) {
    const float number = 1.0F;
    const LaunchArgument buffer{.buffer = memory_.get()};
    const LaunchArgument value{.value = &number, .bytes = sizeof(number)};
    EXPECT_EQ(verdict(kernel, nullptr, {buffer, buffer}), "accepted");
    EXPECT_EQ(verdict(kernel, nullptr, {buffer, LaunchArgument{}}), "accepted");
    EXPECT_EQ(verdict(kernel, nullptr, {buffer}),
              "kernel shadow_edges was launched with 1 arguments, expected 2");
    EXPECT_EQ(verdict(kernel, nullptr, {buffer, buffer, buffer}),
              "kernel shadow_edges was launched with 3 arguments, expected 2");
    EXPECT_EQ(verdict(kernel, nullptr, {buffer, value}),
              "kernel shadow_edges was launched with something else as its argument shadow_edges, "
              "expected a buffer");
    const TracedScene scene;
    EXPECT_EQ(verdict(kernel, &scene, {buffer, buffer}),
              "kernel shadow_edges was launched with a scene, expected none");
    const LaunchArgument slots{.value = &number, .bytes = sizeof(shared::uint)};
    EXPECT_EQ(verdict(KernelId::query_packet, &scene, {slots, buffer, buffer, buffer}), "accepted");
    EXPECT_EQ(verdict(KernelId::query_packet, nullptr, {slots, buffer, buffer, buffer}),
              "kernel query_packet was launched without the scene that it traces in");
    const LaunchArgument wide{.value = &number, .bytes = 8};
    EXPECT_EQ(verdict(KernelId::query_packet, &scene, {wide, buffer, buffer, buffer}),
              "kernel query_packet was launched with something else as its argument slots, "
              "expected a value of 4 bytes");
}

TEST_F(KernelSignature, TypedLaunchesNeedTheBuffersThatAreNotOptional) {
    const DeviceBuffer<kinds::PixelShadows> none;
    const auto edges = allocate<kinds::ShadowEdges>(*executor_, 16, "edges");
    try {
        run_kernel(*executor_, {},
                   kernels::shadow_edges{.pixel_shadows = none, .shadow_edges = edges}, 1);
        FAIL() << "the launch ran";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::device);
        EXPECT_STREQ(error.what(),
                     "kernel shadow_edges was launched without its buffer "
                     "pixel_shadows");
    }
}

TEST_F(KernelSignature, ArgumentsAreFoundByTheirNames) {
    const shared::RenderParams params{};
    const std::vector<LaunchArgument> arguments{{.buffer = memory_.get()}, {}};
    const Launch launch{kernel, params, nullptr, arguments, 1};
    EXPECT_EQ(&argument_of(launch, "pixel_shadows"), launch.arguments.data());
    EXPECT_EQ(argument_of(launch, "shadow_edges").buffer, nullptr);
    EXPECT_THROW((void)argument_of(launch, "vpls"), Error);
}

TEST_F(KernelSignature, EveryKernelHasOneWithDistinctNames) {
    constexpr KernelId kernels[] = {
#define WEFT_KERNEL_ENTRY(name, chunk, work) KernelId::name,
#include "kernels/core/kernels.def"
#undef WEFT_KERNEL_ENTRY
    };
    for (const KernelId id : kernels) {
        EXPECT_EQ(kernel_of(kernel_name(id)), id);
        std::size_t bytes = sizeof(shared::RenderParams) + sizeof(shared::LaunchRange);
        if (kernel_traces(id)) bytes += 2 * sizeof(void*);
        std::set<std::string_view> names;
        for (const ArgumentInfo& argument : kernel_arguments(id)) {
            bytes += argument.bytes;
            names.insert(argument.name);
        }
        EXPECT_EQ(names.size(), kernel_arguments(id).size()) << kernel_name(id);
        EXPECT_FALSE(names.empty()) << kernel_name(id);
        EXPECT_LE(bytes, most_argument_bytes) << kernel_name(id);
    }
    EXPECT_FALSE(kernel_of("no such kernel").has_value());
}

}  // namespace
}  // namespace weft::kernel_signature_test
