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

/// A part of composition's sum that a component makes by slot and filters afterwards.
enum class LightPart : std::uint8_t { direct, indirect };

/// Irradiance by slot, three planes of `stride` floats: what later components may add to before its
/// own one reconstructs it.
struct SlotIrradiance {
    LightPart part;
    BufferRef<kinds::SlotLight> irradiance;
    BufferRef<kinds::ReceiverPlanes> receivers;
    BufferRef<kinds::SlotPixels> slot_pixel;
    std::uint32_t slots;  ///< in use
    std::uint32_t stride;
    bool undersampled;  ///< what is added to a slot may be spread over pixels without samples
};

/// A part of the light, or something else to know of each pixel, that is computed and reconstructed
/// on its own. It owns its buffers and all that it keeps from frame to frame. A renderer makes one
/// instance of each component that its plan calls for.
class Component {
  public:
    Component() = default;
    Component(const Component&) = delete;
    Component& operator=(const Component&) = delete;
    virtual ~Component() = default;

    /// Everything that a frame can leave out when it must end early.
    virtual void sample(FrameContext& frame) = 0;
    /// Cheap: values by slot to values by pixel. Not called for a frame that is dropped.
    virtual void reconstruct(FrameContext& frame) = 0;

    /// Names the buffers that composition is to add up; a part belongs to one component at most.
    virtual void hand_over(ComposedIrradiance&) const {}
    /// Where others may add to what `sample` has made in this frame.
    [[nodiscard]] virtual std::optional<SlotIrradiance> slot_irradiance() const { return {}; }
    /// Where it adapts: what has decided in the last frame where it is sampled, for statistics and
    /// for the picture's layers of levels. Null where it samples every pixel in full.
    [[nodiscard]] virtual const SamplingDecision* decision() const { return nullptr; }
    /// Of records that outlast a frame: what has become of them in the last one.
    [[nodiscard]] virtual std::optional<CacheStats> cache() const { return {}; }
    /// Adds layers of its own: means over the frames of the picture.
    virtual void add_layers(Image&) const {}
};

/// An instance of a kind.
struct ActiveComponent {
    const char* name;
    std::unique_ptr<Component> component;
};

/// What a component is made from. All of it outlives the component.
struct ComponentInputs {
    Executor& executor;
    const FlatScene& scene;
    const FramePlan& plan;
    const FrameBuffers& buffers;  ///< what all components share
    const WorkList& work;         ///< the order of all receivers
    std::uint32_t width;          ///< of the picture, pixels
    std::uint32_t height;
    std::uint32_t features;  ///< FEATURE_* of the frames
    /// Those made before this one; they live as long, but the span does not.
    std::span<const ActiveComponent> earlier;

    /// Of AdaptiveSampling.
    [[nodiscard]] LevelSettings levels() const {
        return {plan.interleave, plan.threshold, plan.luminance_scale};
    }
    [[nodiscard]] std::size_t pixels() const { return std::size_t{width} * height; }
};

/// What a component needs of the frames of a plan.
struct ComponentNeeds {
    std::vector<KernelId> kernels;
    std::uint32_t features = 0;  ///< FEATURE_* that it brings to composition and other kernels
    bool tiles = false;          ///< FrameBuffers::tiles
    bool own_tiles = false;      ///< tiles of other surfaces than those of the G-buffer
    bool all_receivers = false;  ///< FrameBuffers::receivers, of every pixel
};

/// How `--components` knows a component.
enum class Choice : std::uint8_t {
    by_default,  ///< a part of the picture unless left out
    on_request,  ///< only where asked for by name
    unnamed      ///< another option decides
};

/// What is known of a component before any frame: what the list of all components holds.
struct ComponentKind {
    const char* name;
    Choice choice;
    bool (*called_for)(const FramePlan& plan);
    ComponentNeeds (*needs)(const FramePlan& plan);
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

/// What all that a plan calls for need together; each kernel once, in KernelId order.
[[nodiscard]] ComponentNeeds needs_of(const FramePlan& plan,
                                      std::span<const ComponentKind> kinds = components());

/// An instance of each kind that the plan calls for, in their order; fills in `earlier`.
[[nodiscard]] std::vector<ActiveComponent> make_components(std::span<const ComponentKind> kinds,
                                                           ComponentInputs inputs);

/// Irradiance by slot, all dark: what an interrupted frame leaves out is not undefined.
[[nodiscard]] DeviceBuffer<kinds::SlotLight> dark_irradiance(Executor& executor,
                                                             std::uint32_t slots, const char* what);

}  // namespace weft

#endif
