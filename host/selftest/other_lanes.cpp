// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/other_lanes.h"

#include <cstdlib>
#include <optional>
#include <string>

#include "device/native/native_executor.h"

namespace weft::selftest {
namespace {

/// Sets WEFT_LANES, which executors read when they are made, for as long as it lives.
class Lanes {
  public:
    explicit Lanes(const char* lanes) {
        if (const char* const before = std::getenv(name)) before_ = before;
        setenv(name, lanes, 1);
    }
    ~Lanes() {
        if (before_)
            setenv(name, before_->c_str(), 1);
        else
            unsetenv(name);
    }
    Lanes(const Lanes&) = delete;
    Lanes& operator=(const Lanes&) = delete;

  private:
    static constexpr const char* name = "WEFT_LANES";
    std::optional<std::string> before_;
};

}  // namespace

std::unique_ptr<Executor> native_at_other_lanes(const Executor& executor) {
    const Lanes lanes(executor.lanes() == 1 ? "4" : "1");
    return make_native_executor(NativeTraversal::own_bvh, 0);
}

}  // namespace weft::selftest
