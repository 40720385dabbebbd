// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/view_chains.h"

namespace weft {
namespace {

constexpr const char* name = "refraction";

bool is_enabled(const FramePlan& plan) {
    return plan.refraction;
}

ComponentRequirements requirements(const FramePlan& plan) {
    return requirements_of_view_chains(plan, ViewWay::refraction);
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<ViewChains>(inputs, name, ViewWay::refraction);
}

}  // namespace

ComponentKind refraction_component() {
    return {name, Choice::by_default, is_enabled, requirements, make};
}

}  // namespace weft
