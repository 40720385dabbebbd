// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "device/opencl/compile_request.h"

#include <cmath>
#include <cstring>
#include <string_view>

namespace weft {
namespace {

constexpr std::uint32_t max_programs = 4096;
constexpr std::uint32_t max_items = 1U << 30;
constexpr double not_compiled = -1.0;

class Writer {
  public:
    void number(std::uint64_t value) { append(&value, sizeof(value)); }
    void real(double value) { append(&value, sizeof(value)); }
    void text(std::string_view value) {
        number(value.size());
        append(value.data(), value.size());
    }
    [[nodiscard]] std::vector<std::byte> take() { return std::move(bytes_); }

  private:
    void append(const void* data, std::size_t size) {
        const auto* const first = static_cast<const std::byte*>(data);
        bytes_.insert(bytes_.end(), first, first + size);
    }
    std::vector<std::byte> bytes_;
};

/// Reads numbers and texts; once bytes are missing it returns zeros and empty texts.
class Reader {
  public:
    explicit Reader(std::span<const std::byte> bytes) : left_(bytes) {}

    std::uint64_t number() { return plain<std::uint64_t>(); }
    double real() { return plain<double>(); }
    std::string text() {
        const std::uint64_t size = number();
        if (size > left_.size()) good_ = false;
        if (!good_) return {};
        const auto bytes = take(static_cast<std::size_t>(size));
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    /// A number that is at most `most`.
    std::uint32_t number_up_to(std::uint32_t most) {
        const std::uint64_t value = number();
        if (value > most) good_ = false;
        return good_ ? static_cast<std::uint32_t>(value) : 0;
    }
    /// Whether the bytes sufficed and none remain.
    [[nodiscard]] bool finished() const { return good_ && left_.empty(); }
    [[nodiscard]] bool good() const { return good_; }

  private:
    template <class T>
    T plain() {
        T value{};
        if (left_.size() < sizeof(T)) good_ = false;
        if (good_) std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }
    std::span<const std::byte> take(std::size_t size) {
        const auto taken = left_.first(size);
        left_ = left_.subspan(size);
        return taken;
    }
    std::span<const std::byte> left_;
    bool good_ = true;
};

}  // namespace

std::vector<std::byte> encode(const CompileRequest& request) {
    Writer writer;
    writer.number(request.device);
    writer.number(request.workers);
    writer.text(request.cache_folder);
    writer.number(request.programs.size());
    for (const ProgramRecipe& program : request.programs) {
        for (const std::string* const text :
             {&program.name, &program.source, &program.options, &program.key})
            writer.text(*text);
        writer.number(program.global_size);
        writer.number(program.local_size);
    }
    return writer.take();
}

std::vector<std::byte> encode(const CompileTimes& times) {
    Writer writer;
    for (const std::optional<double>& time : times) writer.real(time.value_or(not_compiled));
    return writer.take();
}

std::optional<CompileRequest> decode_request(std::span<const std::byte> bytes) {
    Reader reader(bytes);
    CompileRequest request;
    request.device = reader.number_up_to(max_programs);
    request.workers = reader.number_up_to(max_programs);
    request.cache_folder = reader.text();
    const std::uint32_t count = reader.number_up_to(max_programs);
    for (std::uint32_t i = 0; i < count && reader.good(); ++i) {
        ProgramRecipe& program = request.programs.emplace_back();
        for (std::string* const text :
             {&program.name, &program.source, &program.options, &program.key})
            *text = reader.text();
        program.global_size = reader.number_up_to(max_items);
        program.local_size = reader.number_up_to(max_items);
    }
    if (!reader.finished()) return {};
    return request;
}

std::optional<CompileTimes> decode_times(std::span<const std::byte> bytes, std::size_t programs) {
    if (bytes.size() != programs * sizeof(double)) return {};
    Reader reader(bytes);
    CompileTimes times(programs);
    for (std::optional<double>& time : times) {
        const double value = reader.real();
        if (std::isfinite(value) && value >= 0.0) time = value;
    }
    return times;
}

}  // namespace weft
