// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_COMMON_GROWING_REPORT_H
#define WEFT_BENCH_COMMON_GROWING_REPORT_H

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace weft::bench {

/// The JSON of a long run: a list of parts that grows, written whole after each, so that a run that
/// is interrupted loses nothing that was done.
class GrowingReport {
  public:
    using Summary = std::function<nlohmann::json(const nlohmann::json& parts)>;

    /// `header`: what holds for all parts; `list`: the key of the parts; `file` may be empty.
    GrowingReport(std::filesystem::path file, nlohmann::json header, std::string list,
                  Summary summary);

    /// Takes over the parts of an earlier run from the file, where there is one. Throws Error (exit
    /// code 1) unless its header says the same under `keys`; exit code 2 where it is no report.
    void resume(const std::vector<std::string>& keys);

    /// Whether there is a part that says the same under the keys of `what`.
    [[nodiscard]] bool has(const nlohmann::json& what) const;
    /// Adds a part and writes the file. Throws Error (exit code 5).
    void add(nlohmann::json part);

    [[nodiscard]] const nlohmann::json& parts() const { return json_[list_]; }
    [[nodiscard]] const nlohmann::json& summary() const { return json_["summary"]; }

  private:
    std::filesystem::path file_;
    nlohmann::json json_;
    std::string list_;
    Summary summary_;
};

}  // namespace weft::bench

#endif
