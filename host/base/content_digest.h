// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BASE_CONTENT_DIGEST_H
#define WEFT_BASE_CONTENT_DIGEST_H

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace weft {

/// A 128-bit digest of content, made at several bytes a nanosecond so that it may be taken of whole
/// meshes. Any change of a few bits changes it; it is no protection against forgery. Differs
/// between machines of different byte order.
class ContentDigest {
  public:
    /// Adds a piece; ("ab", "c") and ("a", "bc") are different content.
    void add(std::span<const std::byte> piece) noexcept;
    void add(std::string_view text) noexcept { add(std::as_bytes(std::span(text))); }
    template <class T>
    void add_value(const T& value) noexcept {
        add(std::as_bytes(std::span(&value, 1)));
    }

    [[nodiscard]] std::array<std::uint64_t, 2> value() const noexcept;
    /// The same as 32 hexadecimal digits.
    [[nodiscard]] std::string text() const;

  private:
    void add_word(std::size_t lane, std::uint64_t word) noexcept;

    std::array<std::uint64_t, 4> lanes_{0x9e3779b97f4a7c15ULL, 0xc2b2ae3d27d4eb4fULL,
                                        0x165667b19e3779f9ULL, 0x27d4eb2f165667c5ULL};
};

}  // namespace weft

#endif
