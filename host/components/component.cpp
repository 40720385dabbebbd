// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "components/component.h"

#include <set>

namespace weft {

std::span<const ComponentKind> components() {
    static const ComponentKind all[] = {
#define WEFT_COMPONENT(stem) stem##_component(),
#include "components/components.def"
#undef WEFT_COMPONENT
    };
    return all;
}

std::vector<std::string_view> choosable_components(Choice choice) {
    std::vector<std::string_view> names;
    for (const ComponentKind& kind : components())
        if (kind.choice == choice) names.emplace_back(kind.name);
    return names;
}

std::vector<std::string_view> choosable_components() {
    std::vector<std::string_view> names = choosable_components(Choice::by_default);
    for (const std::string_view name : choosable_components(Choice::on_request))
        names.push_back(name);
    return names;
}

ComponentRequirements requirements_of(const FramePlan& plan, std::span<const ComponentKind> kinds) {
    ComponentRequirements all;
    std::set<KernelId> kernels;
    for (const ComponentKind& kind : kinds) {
        if (!kind.is_enabled(plan)) continue;
        const ComponentRequirements requirements = kind.requirements(plan);
        kernels.insert(requirements.kernels.begin(), requirements.kernels.end());
        all.features |= requirements.features;
        all.tiles = all.tiles || requirements.tiles;
        all.own_tiles = all.own_tiles || requirements.own_tiles;
        all.all_receivers = all.all_receivers || requirements.all_receivers;
    }
    all.kernels.assign(kernels.begin(), kernels.end());
    return all;
}

std::vector<ActiveComponent> make_components(std::span<const ComponentKind> kinds,
                                             ComponentInputs inputs) {
    std::vector<ActiveComponent> made;
    for (const ComponentKind& kind : kinds) {
        if (!kind.is_enabled(inputs.plan)) continue;
        inputs.earlier = made;
        made.push_back({kind.name, kind.make(inputs)});
    }
    return made;
}

DeviceBuffer<kinds::SlotLight> dark_irradiance(Executor& executor, std::uint32_t slots,
                                               const char* what) {
    const std::vector<float> zero(std::size_t{3} * slots, 0.0F);
    return upload<kinds::SlotLight>(executor, zero, what);
}

}  // namespace weft
