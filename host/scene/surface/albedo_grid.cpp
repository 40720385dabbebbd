// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface/albedo_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace weft {
namespace {

/// A place within a cell: its first node, and the weights of its four.
struct CellPlace {
    std::size_t first;
    double weights[4];
};

CellPlace place_in_cell(double column, double row, int nodes, AlbedoGrid::Rows rows) {
    const int c = std::clamp(static_cast<int>(column), 0, nodes - 2);
    const int r = std::clamp(static_cast<int>(row), rows.first, rows.last - 1);
    const double x = column - c;
    const double y = row - r;
    return {static_cast<std::size_t>(r - rows.first) * static_cast<std::size_t>(nodes) +
                static_cast<std::size_t>(c),
            {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y}};
}

}  // namespace

AlbedoGrid::AlbedoGrid(int nodes, Rows rows, const Albedo& albedo)
    : nodes_(nodes),
      rows_(rows),
      values_(static_cast<std::size_t>(nodes) *
              static_cast<std::size_t>(rows.last - rows.first + 1)) {
    tbb::parallel_for(std::size_t{0}, values_.size(), [&](std::size_t i) {
        const std::size_t row = i / static_cast<std::size_t>(nodes);
        const std::size_t column = i % static_cast<std::size_t>(nodes);
        values_[i] = albedo(cosine_of(static_cast<double>(column)),
                            alpha_of(rows.first + static_cast<double>(row)));
    });
}

double AlbedoGrid::row_of(double alpha, int nodes) {
    const double roughness = std::sqrt(std::min(alpha, 1.0));
    return (std::sqrt(1 + 8 * roughness) - 1) / 2 * (nodes - 1);
}

double AlbedoGrid::alpha_of(double row) const {
    const double x = row / (nodes_ - 1);
    const double roughness = (x + x * x) / 2;
    return roughness * roughness;
}

double AlbedoGrid::cosine_of(double column) const {
    // Functions of directions along the surface are limits: a cosine that is as good as 0.
    const double root = column / (nodes_ - 1);
    return std::max(root * root, 1e-9);
}

void AlbedoGrid::raise(const Albedo& albedo, int checks) {
    struct Check {
        CellPlace place;
        double value;
    };
    const auto across = static_cast<std::size_t>((nodes_ - 1) * checks);
    const auto up = static_cast<std::size_t>((rows_.last - rows_.first) * checks);
    std::vector<Check> all(across * up);
    tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t i) {
        const double row = rows_.first + (static_cast<double>(i / across) + 0.5) / checks;
        const double column = (static_cast<double>(i % across) + 0.5) / checks;
        all[i] = {place_in_cell(column, row, nodes_, rows_),
                  std::min(1.0, albedo(cosine_of(column), alpha_of(row)))};
    });
    const std::size_t steps[4] = {0, 1, static_cast<std::size_t>(nodes_),
                                  static_cast<std::size_t>(nodes_) + 1};
    // Each step is the least change that lifts a place (Kaczmarz); places whose nodes are all 1
    // cannot lie below, so that the steps end.
    for (bool raised = true; raised;) {
        raised = false;
        for (const auto& [place, value] : all) {
            double sum = 0.0;
            double squares = 0.0;
            for (int i = 0; i < 4; ++i) {
                const double node = values_[place.first + steps[i]];
                sum += place.weights[i] * node;
                if (node < 1.0) squares += place.weights[i] * place.weights[i];
            }
            const double lack = value - sum;
            if (!(lack > 1e-7) || squares == 0.0) continue;
            raised = true;
            for (int i = 0; i < 4; ++i) {
                double& node = values_[place.first + steps[i]];
                node = std::min(1.0, node + (lack + 1e-8) * place.weights[i] / squares);
            }
        }
    }
}

double AlbedoGrid::between(double column, double row) const {
    const CellPlace place = place_in_cell(column, row, nodes_, rows_);
    const auto next = static_cast<std::size_t>(nodes_);
    return place.weights[0] * values_[place.first] + place.weights[1] * values_[place.first + 1] +
           place.weights[2] * values_[place.first + next] +
           place.weights[3] * values_[place.first + next + 1];
}

double AlbedoGrid::at(double cosine, double alpha) const {
    return between(std::sqrt(cosine) * (nodes_ - 1), row_of(alpha, nodes_));
}

std::vector<float> AlbedoGrid::rounded_up() const {
    std::vector<float> rounded;
    for (const double value : values_) {
        auto node = static_cast<float>(value);
        if (static_cast<double>(node) < value)
            node = std::nextafter(node, std::numeric_limits<float>::infinity());
        rounded.push_back(node);
    }
    return rounded;
}

}  // namespace weft
