// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_VIEW_VIEW_FRONT_H
#define WEFT_VIEW_VIEW_FRONT_H

#include <cstddef>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "view/view_recipe.h"

namespace weft {

/// Settings whose time and error are measured in a view, and what has been found.
class ViewFront {
  public:
    /// One image to be made of some settings.
    struct Step {
        std::size_t point = 0;
        bool counts = true;   ///< its time does; false: it warms up
        bool judged = false;  ///< its error is wanted
    };

    explicit ViewFront(std::vector<ViewCandidate> candidates);

    [[nodiscard]] const ViewCandidate& candidate(std::size_t point) const {
        return points_.at(point).candidate;
    }
    [[nodiscard]] std::size_t points() const { return points_.size(); }
    /// What comes next; empty once all is measured. Rounds visit every setting once, so that what
    /// slows the machine for a while slows all of them.
    [[nodiscard]] std::optional<Step> next() const;
    /// Takes what the next step has found: milliseconds, and where asked for, the error.
    void took(double ms, double error = std::numeric_limits<double>::quiet_NaN());
    /// Sets what the error of a perfect image would be.
    void set_floor(double floor) { floor_ = floor; }
    /// Share of the steps that is done.
    [[nodiscard]] double done() const;

    /// What pages are told. `shown`: the point whose settings the view has, if any.
    [[nodiscard]] nlohmann::json json(bool running, std::optional<std::size_t> shown) const;

  private:
    struct Point {
        ViewCandidate candidate;
        std::vector<double> ms{};
        double error = std::numeric_limits<double>::quiet_NaN();
    };

    [[nodiscard]] std::size_t steps() const;

    std::vector<Point> points_;
    std::size_t step_ = 0;
    double floor_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace weft

#endif
