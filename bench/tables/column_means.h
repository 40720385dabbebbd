// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_BENCH_TABLES_COLUMN_MEANS_H
#define WEFT_BENCH_TABLES_COLUMN_MEANS_H

#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace weft::bench {

/// Plain means of the columns of a table, each over the rows that have a number there; null for a
/// column of which none has. `rows` is a list, or an object by name, of objects by column.
[[nodiscard]] inline nlohmann::json column_means(const nlohmann::json& rows) {
    struct Sum {
        double total = 0.0;
        int count = 0;
    };
    std::map<std::string, Sum> sums;
    for (const nlohmann::json& row : rows)
        for (const auto& [column, value] : row.items()) {
            Sum& sum = sums[column];
            if (!value.is_number()) continue;
            sum.total += value.get<double>();
            ++sum.count;
        }
    nlohmann::json means = nlohmann::json::object();
    for (const auto& [column, sum] : sums)
        means[column] = sum.count > 0 ? nlohmann::json(sum.total / sum.count) : nlohmann::json();
    return means;
}

/// The rows of `rows` that `published` has, too, by name, with those columns in which both have a
/// number. Both are objects by row name.
[[nodiscard]] inline nlohmann::json common_cells(const nlohmann::json& rows,
                                                 const nlohmann::json& published) {
    nlohmann::json common = nlohmann::json::object();
    if (!published.is_object()) return common;
    for (const auto& [name, row] : rows.items()) {
        const auto other = published.find(name);
        if (other == published.end() || !other->is_object()) continue;
        for (const auto& [column, value] : row.items())
            if (value.is_number() && other->contains(column) && (*other)[column].is_number())
                common[name][column] = value;
    }
    return common;
}

}  // namespace weft::bench

#endif
