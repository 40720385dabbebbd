// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/selftest_ledger.h"

#include <fmt/format.h>

#include "selftest/selftest_report.h"

namespace weft::selftest {
namespace {

std::string tolerance_of(const Check& check) {
    std::string text = to_string(check.tolerance);
    if (check.with_embree) text += "; with Embree " + to_string(*check.with_embree);
    return text;
}

const char* backends_of(const SelftestCase& listed, const Check& check) {
    if (listed.runs_on == RunsOn::host) return "host";
    return check.own_traversal ? "all but Embree" : "all";
}

}  // namespace

std::string selftest_ledger(std::span<const SelftestCase> cases) {
    std::string text =
        "| # | Case | Expected | Tolerance | Why that much | Backends "
        "|\n|--:|---|---|---|---|---|\n";
    for (const SelftestCase& listed : cases)
        for (const Check& check : listed.checks)
            text += fmt::format("| {} | {} | {} | {} | {} | {} |\n", listed.number,
                                title_of(listed.name, check.what), number_text(check.expected),
                                tolerance_of(check), check.reason, backends_of(listed, check));
    return text;
}

}  // namespace weft::selftest
