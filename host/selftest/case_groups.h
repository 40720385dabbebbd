// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SELFTEST_CASE_GROUPS_H
#define WEFT_SELFTEST_CASE_GROUPS_H

#include <vector>

#include "selftest/selftest_case.h"

// The hard cases by subject. Numbers are those of docs/hard-cases.md.
namespace weft::selftest {

[[nodiscard]] std::vector<SelftestCase> furnace_cases();        ///< 1, 2, 3, 11
[[nodiscard]] std::vector<SelftestCase> form_factor_cases();    ///< 4, 5
[[nodiscard]] std::vector<SelftestCase> area_light_cases();     ///< 6 to 9
[[nodiscard]] std::vector<SelftestCase> exact_light_cases();    ///< 10, 20
[[nodiscard]] std::vector<SelftestCase> media_cases();          ///< 12, 34
[[nodiscard]] std::vector<SelftestCase> airlight_cases();       ///< 13, 14
[[nodiscard]] std::vector<SelftestCase> sampler_cases();        ///< 15, 31
[[nodiscard]] std::vector<SelftestCase> ray_cases();            ///< 16 to 18
[[nodiscard]] std::vector<SelftestCase> place_cases();          ///< 19
[[nodiscard]] std::vector<SelftestCase> virtual_light_cases();  ///< 21
[[nodiscard]] std::vector<SelftestCase> record_cases();         ///< 22, 23
[[nodiscard]] std::vector<SelftestCase> change_cases();         ///< 24, 25
[[nodiscard]] std::vector<SelftestCase> interleaving_cases();   ///< 26 to 28
[[nodiscard]] std::vector<SelftestCase> degenerate_cases();     ///< 29, 30
[[nodiscard]] std::vector<SelftestCase> metric_cases();         ///< 32
[[nodiscard]] std::vector<SelftestCase> parity_cases();         ///< 33
[[nodiscard]] std::vector<SelftestCase> roulette_cases();       ///< 35
[[nodiscard]] std::vector<SelftestCase> surface_cases();        ///< 36 to 41

}  // namespace weft::selftest

#endif
