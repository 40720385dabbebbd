// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "selftest/case_registry.h"

#include <algorithm>
#include <iterator>

#include "selftest/case_groups.h"

namespace weft::selftest {

const std::vector<SelftestCase>& selftest_cases() {
    static const std::vector<SelftestCase> all = [] {
        std::vector<SelftestCase> cases;
        for (const auto group :
             {furnace_cases, form_factor_cases, area_light_cases, exact_light_cases, media_cases,
              airlight_cases, sampler_cases, ray_cases, place_cases, virtual_light_cases,
              record_cases, change_cases, interleaving_cases, degenerate_cases, metric_cases,
              parity_cases, roulette_cases, surface_cases})
            std::ranges::move(group(), std::back_inserter(cases));
        std::ranges::stable_sort(cases, {}, &SelftestCase::number);
        return cases;
    }();
    return all;
}

}  // namespace weft::selftest
