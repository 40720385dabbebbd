// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_COMPONENTS_COMPONENT_H
#define WEFT_COMPONENTS_COMPONENT_H

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "adaptive/level_scheduler.h"
#include "adaptive/sampling_decision.h"
#include "image/image.h"
#include "pipeline/frame_context.h"
#include "pipeline/frame_renderer.h"

namespace weft {

/// The summand of composition to which irradiance by slot belongs once it is filtered.
enum class LightPart : std::uint8_t { direct, indirect };

/// Irradiance by slot, three planes of `stride` floats. Later components may add to it before the
/// component that owns it reconstructs it.
struct SlotIrradiance {
    LightPart part;
    BufferRef<kinds::SlotLight> irradiance;
    BufferRef<kinds::ReceiverPlanes> receivers;
    BufferRef<kinds::SlotPixels> slot_pixel;
    std::uint32_t slots;  ///< in use
    std::uint32_t stride;
    bool undersampled;  ///< what is added to a slot may be spread over pixels without samples
};

/// A part of the light, or another quantity of each pixel, that is sampled and reconstructed on its
/// own. It owns its buffers and all that it keeps from frame to frame. A renderer makes one
/// instance of each component that its plan enables.
class Component {
  public:
    Component() = default;
    Component(const Component&) = delete;
    Component& operator=(const Component&) = delete;
    virtual ~Component() = default;

    /// Makes the samples: everything that a frame can leave out when it must end early.
    virtual void sample(FrameContext& frame) = 0;
    /// Makes values by pixel from values by slot, which is cheap. Not called for a frame that is
    /// dropped.
    virtual void reconstruct(FrameContext& frame) = 0;

    /// Binds the buffers that composition adds up; a part belongs to one component at most.
    virtual void bind_outputs(ComposedIrradiance&) const {}
    /// The irradiance of this frame's samples, where other components may add to it.
    [[nodiscard]] virtual std::optional<SlotIrradiance> slot_irradiance() const { return {}; }
    /// Where the component was sampled in the last frame, for statistics and for the image's layers
    /// of levels. Null where it samples every pixel in full.
    [[nodiscard]] virtual const SamplingDecision* decision() const { return nullptr; }
    /// How much of its light the samples of a frame have that ended early, in [0, 1].
    [[nodiscard]] virtual double light_share(FrameContext& frame) const {
        return frame.light().share();
    }
    /// Statistics of records that outlast a frame, for the last frame; none without such records.
    [[nodiscard]] virtual std::optional<CacheStats> cache() const { return {}; }
    /// Adds layers of its own: means over the frames of the image.
    virtual void add_layers(Image&) const {}
};

/// A component that a renderer runs.
struct ActiveComponent {
    const char* name;
    std::unique_ptr<Component> component;
};

/// What a component is constructed from. All of it outlives the component.
struct ComponentInputs {
    Executor& executor;
    const FlatScene& scene;
    const FramePlan& plan;
    const FrameBuffers& buffers;  ///< those that all components share
    const WorkList& work;         ///< the order of all receivers
    std::uint32_t width;          ///< of the image, pixels
    std::uint32_t height;
    std::uint32_t features;  ///< FEATURE_* of the frames
    /// Components made before this one; they live as long as it, but the span does not.
    std::span<const ActiveComponent> earlier;

    /// Settings for AdaptiveSampling.
    [[nodiscard]] LevelSettings levels() const {
        return {plan.interleave, plan.threshold, plan.luminance_scale};
    }
    [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
};

/// What a component needs of the frames of a plan.
struct ComponentRequirements {
    std::vector<KernelId> kernels;
    std::uint32_t features = 0;  ///< FEATURE_* that it brings to composition and other kernels
    bool tiles = false;          ///< FrameBuffers::tiles
    bool own_tiles = false;      ///< tiles of surfaces that are not those of the G-buffer
    bool all_receivers = false;  ///< FrameBuffers::receivers, of every pixel
};

/// How `--components` chooses a component.
enum class Choice : std::uint8_t {
    by_default,  ///< a part of the image unless left out
    on_request,  ///< only where named
    unnamed      ///< another option decides
};

/// An entry of the list of all components: what is known of a component before any frame.
struct ComponentKind {
    const char* name;
    Choice choice;
    bool (*is_enabled)(const FramePlan& plan);
    ComponentRequirements (*requirements)(const FramePlan& plan);
    std::unique_ptr<Component> (*make)(const ComponentInputs& inputs);
};

#define WEFT_COMPONENT(stem) [[nodiscard]] ComponentKind stem##_component();
#include "components/components.def"
#undef WEFT_COMPONENT

/// All components (components.def), in the order in which a frame runs them.
[[nodiscard]] std::span<const ComponentKind> components();

/// Names of the components of this choice.
[[nodiscard]] std::vector<std::string_view> choosable_components(Choice choice);
/// Names of all components that `--components` chooses from, those by default first.
[[nodiscard]] std::vector<std::string_view> choosable_components();

/// What all kinds that a plan enables require together; each kernel once, in KernelId order.
[[nodiscard]] ComponentRequirements requirements_of(
    const FramePlan& plan, std::span<const ComponentKind> kinds = components());

/// Makes an instance of each kind that the plan enables, in their order; fills in `earlier`.
[[nodiscard]] std::vector<ActiveComponent> make_components(std::span<const ComponentKind> kinds,
                                                           ComponentInputs inputs);

/// Allocates irradiance by slot and sets it to 0, so that what an interrupted frame leaves out is
/// defined.
[[nodiscard]] DeviceBuffer<kinds::SlotLight> dark_irradiance(Executor& executor,
                                                             std::uint32_t slots, const char* what);

}  // namespace weft

#endif
