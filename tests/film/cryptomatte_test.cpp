// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "film/cryptomatte.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "shared/shared_types.h"

namespace weft::cryptomatte_test {
namespace {

TEST(Cryptomatte, HashesAsPublished) {
    // MurmurHash3_x86_32 with seed 0.
    EXPECT_EQ(murmur_hash(""), 0U);
    EXPECT_EQ(murmur_hash("a"), 0x3c2569b2U);
    EXPECT_EQ(murmur_hash("test"), 0xba6bd213U);
    EXPECT_EQ(murmur_hash("hello"), 0x248bfa47U);
    EXPECT_EQ(murmur_hash("hello, world"), 0x149bbb7fU);
    EXPECT_EQ(murmur_hash("The quick brown fox jumps over the lazy dog"), 0x2e4ff723U);
    // The examples of Cryptomatte's specification.
    EXPECT_EQ(cryptomatte_id("bunny"), 0x13851a76U);
    EXPECT_EQ(cryptomatte_id("default"), 0x42c9679fU);
    EXPECT_NEAR(std::bit_cast<float>(cryptomatte_id("bunny")), 3.3600012625093e-27F, 1e-33F);
}

TEST(Cryptomatte, EveryIdentifierIsANormalFloat) {
    EXPECT_EQ(murmur_hash("object 259"), 0x0069b367U) << "of exponent 0";
    EXPECT_EQ(cryptomatte_id("object 259"), 0x00e9b367U);
    EXPECT_EQ(murmur_hash("object 858"), 0xff868043U) << "of exponent 255";
    EXPECT_EQ(cryptomatte_id("object 858"), 0xff068043U);
    for (int i = 0; i < 20000; ++i)
        ASSERT_TRUE(
            std::isnormal(std::bit_cast<float>(cryptomatte_id("object " + std::to_string(i)))));
}

/// Two pixels of four samples: half of `a` and a quarter of `b` each of two instances; nothing.
InstanceCounts two_pixels() {
    InstanceCounts counts(2);
    for (const std::uint32_t instance : {0U, 1U, 0U, 2U})
        counts.add(std::vector<std::uint32_t>{instance, 7U, INVALID_INDEX, INVALID_INDEX});
    return counts;
}

TEST(Cryptomatte, RanksNamesByCoverage) {
    Image image;
    image.width = 2;
    image.height = 1;
    const std::vector<std::string> names{"a", "b", "c"};
    attach_cryptomatte("CryptoObject", two_pixels(), names, image);
    ASSERT_EQ(image.layers.size(), 3U);
    EXPECT_EQ(image.layers[0].name, "CryptoObject00");
    EXPECT_EQ(image.layers[2].name, "CryptoObject02");
    for (const Layer& layer : image.layers) {
        EXPECT_EQ(layer.channels, "RGBA");
        ASSERT_EQ(layer.values.size(), 8U);
        for (const std::size_t at : {1U, 3U, 5U, 7U}) EXPECT_EQ(layer.values[at], 0.0F);
    }
    EXPECT_EQ(std::bit_cast<std::uint32_t>(image.layers[0].values[0]), cryptomatte_id("a"));
    EXPECT_EQ(image.layers[0].values[2], 0.5F);
    EXPECT_EQ(image.layers[0].values[6], 0.25F);
    EXPECT_EQ(image.layers[1].values[2], 0.25F);
    EXPECT_EQ(image.layers[2].values[2], 0.0F);
}

TEST(Cryptomatte, InstancesOfOneNameAreOne) {
    Image image;
    image.width = 2;
    image.height = 1;
    const std::vector<std::string> names{"a", "b", "b"};
    attach_cryptomatte("CryptoMaterial", two_pixels(), names, image);
    EXPECT_EQ(image.layers[0].values[2], 0.5F);
    EXPECT_EQ(image.layers[0].values[6], 0.5F);
    EXPECT_EQ(image.layers[1].values[2], 0.0F);
}

TEST(Cryptomatte, TheManifestIsJsonUnderTheKeyOfTheLayer) {
    Image image;
    image.width = 2;
    image.height = 1;
    const std::vector<std::string> names{"bunny", "say \"hi\"", "caf\xc3\xa9 \xff"};
    attach_cryptomatte("CryptoObject", two_pixels(), names, image);
    // The key that compositing programs know for this layer.
    EXPECT_EQ(image.metadata.at("cryptomatte/3ae39a5/name"), "CryptoObject");
    EXPECT_EQ(image.metadata.at("cryptomatte/3ae39a5/hash"), "MurmurHash3_32");
    EXPECT_EQ(image.metadata.at("cryptomatte/3ae39a5/conversion"), "uint32_to_float32");
    const auto manifest = nlohmann::json::parse(image.metadata.at("cryptomatte/3ae39a5/manifest"));
    EXPECT_EQ(manifest.size(), 3U);
    EXPECT_EQ(manifest["bunny"], "13851a76");
    EXPECT_TRUE(manifest.contains("say \"hi\""));
    EXPECT_TRUE(is_cryptomatte("cryptomatte/3ae39a5/name"));
    EXPECT_TRUE(is_cryptomatte("CryptoObject00"));
    EXPECT_FALSE(is_cryptomatte("direct"));
}

TEST(Cryptomatte, PixelsOfManyInstancesKeepTheFirst) {
    InstanceCounts counts(1);
    for (std::uint32_t i = 0; i < 12; ++i) counts.add(std::vector<std::uint32_t>{i, 0U});
    std::uint32_t counted = 0;
    for (const InstanceCounts::Count& count : counts.of(0)) counted += count.samples;
    EXPECT_EQ(counted, InstanceCounts::most);
    EXPECT_EQ(counts.samples(), 12U);
}

}  // namespace
}  // namespace weft::cryptomatte_test
