// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "device/launch.h"
#include "tests/testing/render_fixture.h"

// Which VPLs blocks of receivers trace (kernels/light/vpl_roulette.cl), against the definition.
namespace weft::vpl_roulette_test {
namespace {

using test::TestBackend;

constexpr std::uint32_t blocks = 12;
constexpr std::uint32_t slots = blocks * PACKET_BLOCK;
constexpr std::uint32_t sets = 3;

struct Room {
    std::vector<float> planes = std::vector<float>(std::size_t{7} * slots, 0.0F);
    std::vector<std::uint32_t> block_sets;
    std::vector<shared::Vpl> vpls;
    std::uint32_t per_set;
};

/// Receivers on a floor, some missing, below VPLs at many heights, of which some are dark.
Room make_room(std::uint32_t per_set) {
    Room room{.block_sets = {}, .vpls = {}, .per_set = per_set};
    std::mt19937 random(23);
    std::uniform_real_distribution<float> uniform(0.0F, 1.0F);
    for (std::uint32_t slot = 0; slot < slots; ++slot) {
        const auto block = static_cast<float>(slot / PACKET_BLOCK);
        room.planes[slot] = block + uniform(random);
        room.planes[slots + slot] = uniform(random);
        room.planes[5 * slots + slot] = 1.0F;
        room.planes[6 * slots + slot] = slot % 11 == 3 || slot / PACKET_BLOCK == 7 ? 0.0F : 1.0F;
    }
    for (std::uint32_t block = 0; block < blocks; ++block) room.block_sets.push_back(block % sets);
    for (std::uint32_t i = 0; i < sets * per_set; ++i) {
        shared::Vpl vpl{};
        vpl.position = {blocks * uniform(random), uniform(random), 0.1F + uniform(random), 50.0F};
        vpl.normal = {0.0F, 0.0F, -1.0F, 0.0F};
        const float flux = i % 9 == 0 ? 0.0F : std::exp(4.0F * uniform(random));
        vpl.flux = {flux, flux, flux, std::max(1e-3F, uniform(random))};
        room.vpls.push_back(vpl);
    }
    return room;
}

/// The most that the VPL brings to a receiver of the block.
double importance_of(const Room& room, std::uint32_t block, const shared::Vpl& vpl) {
    double most = 0.0;
    for (std::uint32_t slot = block * PACKET_BLOCK; slot < (block + 1) * PACKET_BLOCK; ++slot) {
        if (!(room.planes[6 * slots + slot] > 0.0F)) continue;
        const double x =
            static_cast<double>(room.planes[slot]) - static_cast<double>(vpl.position.x);
        const double y =
            static_cast<double>(room.planes[slots + slot]) - static_cast<double>(vpl.position.y);
        const double z = static_cast<double>(vpl.position.z);
        const double square = x * x + y * y + z * z;
        most = std::max(most, std::min(50.0, z * z / (square * square)));
    }
    return most * static_cast<double>(vpl.flux.x);
}

std::vector<std::uint32_t> survival_of(TestBackend backend, const Room& room, float roulette,
                                       float scale = 1.0F) {
    Executor& executor = test::shared_executor(backend);
    executor.build(std::vector{KernelId::vpl_roulette}, 0);
    const auto receivers = upload<kinds::ReceiverPlanes>(executor, room.planes, "receivers");
    const auto block_set = upload<kinds::BlockSets>(executor, room.block_sets, "sets");
    const auto vpls = upload<kinds::VirtualLights>(executor, room.vpls, "VPLs");
    const std::size_t words = std::size_t{blocks} * SURVIVAL_WORDS(room.per_set);
    auto survival = allocate<kinds::VplSurvival>(executor, words, "survival");
    shared::RenderParams params{};
    params.sampling.gather_sets = sets;
    params.sampling.sets = sets;
    EXPECT_TRUE(
        run_kernel(executor, params,
                   kernels::vpl_roulette{.list = shared::SetList{0, room.per_set, room.per_set},
                                         .roulette = roulette,
                                         .scale = scale,
                                         .slots = slots,
                                         .receiver_planes = receivers,
                                         .block_set = block_set,
                                         .vpls = vpls,
                                         .survival = survival},
                   blocks));
    return read_buffer(executor, survival, words);
}

TEST(VplRoulette, SurvivalIsInProportionToTheMostThatAVplBrings) {
    // Lists whose bytes fill their words and not, and one that is longer than what is kept.
    for (const std::uint32_t per_set : {6U, 64U, 301U}) {
        const Room room = make_room(per_set);
        const std::uint32_t words = SURVIVAL_WORDS(per_set);
        for (const TestBackend backend : test::backends()) {
            const auto survival = survival_of(backend, room, 2.0F);
            std::uint32_t ended = 0;
            std::uint32_t certain = 0;
            for (std::uint32_t block = 0; block < blocks; ++block) {
                const shared::Vpl* vpls = room.vpls.data() + block % sets * per_set;
                double sum = 0.0;
                for (std::uint32_t i = 0; i < per_set; ++i)
                    sum += importance_of(room, block, vpls[i]);
                const double level = 2.0 * sum / per_set;
                for (std::uint32_t i = 0; i < per_set; ++i) {
                    const std::uint32_t byte =
                        survival[block * words + i / 4] >> 8 * (i % 4) & 255U;
                    const double importance = importance_of(room, block, vpls[i]);
                    if (!(importance > 0.0)) {
                        EXPECT_EQ(byte, 0U) << "block " << block << ", VPL " << i;
                        continue;
                    }
                    const double p = std::min(1.0, importance / level);
                    const auto chance = static_cast<double>(vpls[i].flux.w);
                    // The probability is rounded up to the next step, or one more by rounding.
                    if (byte == 0) {
                        EXPECT_GT(chance, p) << "block " << block << ", VPL " << i;
                    } else {
                        EXPECT_LE(chance, p + 1.001 / 255.0) << "block " << block << ", VPL " << i;
                        EXPECT_NEAR(byte / 255.0, p + 0.5 / 255.0, 0.51 / 255.0)
                            << "block " << block << ", VPL " << i;
                    }
                    if (byte == 0) ++ended;
                    if (byte == 255) ++certain;
                }
            }
            EXPECT_GT(ended, blocks * per_set / 5) << test::backend_name(backend);
            EXPECT_GT(certain, blocks * per_set / 20) << test::backend_name(backend);
        }
    }
}

TEST(VplRoulette, LightBeyondTheRangeOfNumbersKeepsAllVpls) {
    Room room = make_room(8);
    for (shared::Vpl& vpl : room.vpls) vpl.flux = {3e38F, 3e38F, 3e38F, 1.0F};
    const auto survival = survival_of(TestBackend::own_bvh, room, 2.0F, 1e10F);
    for (std::uint32_t block = 0; block < blocks; ++block) {
        if (block == 7) continue;  // it has no receiver
        EXPECT_EQ(survival[2 * std::size_t{block}], 0xFFFFFFFFU) << block;
    }
}

}  // namespace
}  // namespace weft::vpl_roulette_test
