// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "base/content_digest.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

namespace weft {
namespace {

// The multipliers of xxHash64, whose rounds these are.
constexpr std::uint64_t prime_a = 0x9e3779b185ebca87ULL;
constexpr std::uint64_t prime_b = 0xc2b2ae3d27d4eb4fULL;
constexpr std::uint64_t prime_c = 0x165667b19e3779f9ULL;
constexpr std::size_t word_bytes = sizeof(std::uint64_t);

std::uint64_t scattered(std::uint64_t word) noexcept {
    word = (word ^ (word >> 33)) * prime_b;
    word = (word ^ (word >> 29)) * prime_c;
    return word ^ (word >> 32);
}

std::uint64_t word_at(const std::byte* bytes, std::size_t count) noexcept {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes, count);
    return word;
}

}  // namespace

// Each round is a bijection of the lane and of the word, so that a change is never lost.
void ContentDigest::add_word(std::size_t lane, std::uint64_t word) noexcept {
    lanes_[lane] = std::rotl(lanes_[lane] + word * prime_b, 31) * prime_a;
}

void ContentDigest::add(std::span<const std::byte> piece) noexcept {
    const std::byte* at = piece.data();
    std::size_t left = piece.size();
    // Four independent lanes, because each round waits for the one before it.
    for (; left >= lanes_.size() * word_bytes; left -= lanes_.size() * word_bytes)
        for (std::size_t lane = 0; lane < lanes_.size(); ++lane, at += word_bytes)
            add_word(lane, word_at(at, word_bytes));
    for (std::size_t lane = 0; left > 0; ++lane) {
        const std::size_t count = std::min(left, word_bytes);
        add_word(lane, word_at(at, count));
        at += count;
        left -= count;
    }
    add_word(0, piece.size());
}

std::array<std::uint64_t, 2> ContentDigest::value() const noexcept {
    std::array<std::uint64_t, 2> sums{prime_a, prime_b};
    for (std::size_t lane = 0; lane < lanes_.size(); ++lane) {
        sums[0] = scattered(sums[0] ^ lanes_[lane]) + prime_a;
        sums[1] = scattered(sums[1] + lanes_[lanes_.size() - 1 - lane] * prime_c) ^ prime_b;
    }
    return sums;
}

std::string ContentDigest::text() const {
    const std::array<std::uint64_t, 2> sums = value();
    return fmt::format("{:016x}{:016x}", sums[0], sums[1]);
}

}  // namespace weft
