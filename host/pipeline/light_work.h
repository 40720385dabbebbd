// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_PIPELINE_LIGHT_WORK_H
#define WEFT_PIPELINE_LIGHT_WORK_H

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/stage.h"

namespace weft {

/// How much of a component's light an image holds.
struct LightShare {
    std::string component;  ///< as stages name it
    double share = 1.0;     ///< of the pixels that it lights, in [0, 1]
};

/// Whether an image that ended early holds nothing of its light.
[[nodiscard]] bool is_dark(const std::vector<LightShare>& light);

/// "direct 100 %, indirect 38 %", rounded down.
[[nodiscard]] std::string light_text(const std::vector<LightShare>& light);

/// Counts what the stages that bring light have to do in a frame, and have done where the frame
/// ends early.
class LightWork {
  public:
    /// A stage is to run this many work-items more, or would if the frame had not ended.
    void plan(Stage stage, const char* component, std::uint32_t items);
    /// A stage has run this many of them.
    void add(Stage stage, double items);

    /// The component of the stages, empty where they have none.
    [[nodiscard]] const std::string& component() const { return component_; }
    /// Share that is done, in [0, 1]: the mean over the stages, each of which lights all pixels. 1
    /// where there is none.
    [[nodiscard]] double share() const;

  private:
    struct Part {
        Stage stage;
        double planned;
        double done;
    };

    std::string component_;
    std::vector<Part> parts_;
};

}  // namespace weft

#endif
