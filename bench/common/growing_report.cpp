// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/common/growing_report.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "bench/common/machine.h"

namespace weft::bench {

GrowingReport::GrowingReport(std::filesystem::path file, nlohmann::json header, std::string list,
                             Summary summary)
    : file_(std::move(file)),
      json_(std::move(header)),
      list_(std::move(list)),
      summary_(std::move(summary)) {
    json_[list_] = nlohmann::json::array();
    json_["summary"] = summary_(json_[list_]);
}

void GrowingReport::resume(const std::vector<std::string>& keys) {
    if (file_.empty() || !std::filesystem::exists(file_)) return;
    constexpr std::size_t most_bytes = std::size_t{1} << 30;
    const std::vector<std::byte> bytes = read_file(file_, most_bytes);
    const auto* const text = reinterpret_cast<const char*>(bytes.data());
    const auto earlier = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
    if (!earlier.is_object() || !earlier.contains(list_) || !earlier[list_].is_array())
        throw input_error(file_.string(), "is no report of this benchmark, expected one");
    for (const std::string& key : keys)
        if (!earlier.contains(key) || earlier[key] != json_[key])
            throw Error(ExitCode::usage, file_.string(),
                        "is of a run with another " + key + ", expected the same as now");
    json_[list_] = earlier[list_];
    json_["summary"] = summary_(json_[list_]);
}

bool GrowingReport::has(const nlohmann::json& what) const {
    const auto fits = [&](const nlohmann::json& part) {
        for (const auto& [key, value] : what.items())
            if (!part.contains(key) || part[key] != value) return false;
        return true;
    };
    return std::any_of(parts().begin(), parts().end(), fits);
}

void GrowingReport::add(nlohmann::json part) {
    json_[list_].push_back(std::move(part));
    json_["summary"] = summary_(json_[list_]);
    if (!file_.empty()) write_json(file_, json_);
}

}  // namespace weft::bench
