// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/program_cache.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>

#include "base/error.h"
#include "base/file.h"

namespace weft {
namespace {

constexpr std::string_view magic = "weft-program-1\n";
constexpr std::size_t key_length = 32;
constexpr std::size_t max_program_bytes = std::size_t{256} << 20;

/// FNV-1a, started from `seed`.
std::uint64_t fnv1a(std::uint64_t seed, const void* data, std::size_t size) {
    std::uint64_t hash = seed;
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) {
        hash ^= bytes[i];
        hash *= 0x100000001b3ULL;
    }
    return hash;
}

constexpr std::uint64_t seed_a = 0xcbf29ce484222325ULL;
constexpr std::uint64_t seed_b = 0x9ae16a3b2f90404fULL;

/// The header before the program in a file: magic, key, and a checksum of the program.
std::string header_of(const std::string& key, std::span<const unsigned char> program) {
    return fmt::format("{}{}\n{:016x}\n", magic, key,
                       fnv1a(seed_a, program.data(), program.size()));
}

}  // namespace

std::string ProgramCache::key(std::span<const std::string_view> parts) {
    std::uint64_t a = seed_a;
    std::uint64_t b = seed_b;
    for (const std::string_view part : parts) {
        // The length keeps ("ab", "c") apart from ("a", "bc").
        const std::uint64_t size = part.size();
        a = fnv1a(fnv1a(a, &size, sizeof(size)), part.data(), part.size());
        b = fnv1a(fnv1a(b, part.data(), part.size()), &size, sizeof(size));
    }
    return fmt::format("{:016x}{:016x}", a, b);
}

std::filesystem::path ProgramCache::file_of(const std::string& key) const {
    return folder_ / (key + ".program");
}

bool ProgramCache::contains(const std::string& key) const {
    std::error_code ignored;
    return !folder_.empty() && std::filesystem::is_regular_file(file_of(key), ignored);
}

bool ProgramCache::writable() const {
    if (folder_.empty()) return false;
    try {
        make_cache_folder(folder_);
    } catch (const std::exception&) {
        return false;
    }
    return ::access(folder_.c_str(), W_OK | X_OK) == 0;
}

std::optional<std::vector<unsigned char>> ProgramCache::load(const std::string& key) const {
    if (!contains(key)) return {};
    std::vector<std::byte> bytes;
    try {
        bytes = read_file(file_of(key), max_program_bytes);
    } catch (const Error&) {
        return {};
    }
    const std::size_t header_size = magic.size() + key_length + 1 + 16 + 1;
    if (bytes.size() <= header_size) return {};
    const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
    const std::span program(data + header_size, bytes.size() - header_size);
    const std::string expected = header_of(key, program);
    if (std::memcmp(data, expected.data(), header_size) != 0) return {};
    return std::vector<unsigned char>(program.begin(), program.end());
}

void ProgramCache::store(const std::string& key, std::span<const unsigned char> program) const {
    if (folder_.empty() || program.empty()) return;
    try {
        make_cache_folder(folder_);
        const std::string header = header_of(key, program);
        std::vector<std::byte> bytes(header.size() + program.size());
        std::memcpy(bytes.data(), header.data(), header.size());
        std::memcpy(bytes.data() + header.size(), program.data(), program.size());
        write_file_atomically(file_of(key), bytes);
    } catch (const std::exception&) {
        return;
    }
}

void ProgramCache::remove(const std::string& key) const {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove(file_of(key), ignored);
}

}  // namespace weft
