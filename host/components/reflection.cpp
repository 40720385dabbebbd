// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/view_chains.h"

namespace weft {
namespace {

constexpr const char* name = "reflection";

bool is_enabled(const FramePlan& plan) {
    return plan.reflection;
}

ComponentRequirements requirements(const FramePlan& plan) {
    return requirements_of_view_chains(plan, ViewWay::reflection);
}

std::unique_ptr<Component> make(const ComponentInputs& inputs) {
    return std::make_unique<ViewChains>(inputs, name, ViewWay::reflection);
}

}  // namespace

ComponentKind reflection_component() {
    return {name, Choice::by_default, is_enabled, requirements, make};
}

}  // namespace weft
