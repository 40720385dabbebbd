// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/flat_environment.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

#include "scene/flat_scene.h"

namespace weft {
namespace {

using shared::EnvironmentRecord;

constexpr double half_turn = std::numbers::pi;

// Most cells by which directions are chosen.
constexpr std::uint32_t most_cell_columns = 512;
constexpr std::uint32_t most_cell_rows = 256;
// Cells of a texel along each axis, where the image is small.
constexpr std::uint32_t cells_per_texel = 4;
// Look-ups along each edge of a cell, at least; more where it has more texels.
constexpr std::uint32_t least_look_ups = 4;
// Share of its brightest texel that a cell is taken to have besides its mean, so that no light is
// missed between look-ups.
constexpr double share_of_brightest = 0x1p-10;

/// Writes the texels of the image and those beyond its edges.
class Padding {
  public:
    Padding(const EnvironmentImage& image, FlatEnvironment& flat) : image_(image), flat_(flat) {}

    void write(const EnvironmentRecord& record) {
        flat_.texels.reserve(std::size_t{3} * record.width * record.height);
        if (image_.rows_at_poles) {
            for (std::uint32_t row = 0; row < record.height; ++row)
                append_row(std::min(row, image_.height - 1), false);
            return;
        }
        // Over a pole the row goes on on the other side.
        append_row(0, true);
        for (std::uint32_t row = 0; row < image_.height; ++row) append_row(row, false);
        append_row(image_.height - 1, true);
    }

  private:
    void append_row(std::uint32_t row, bool turned) {
        append_texel(row, image_.width - 1, turned);
        for (std::uint32_t column = 0; column < image_.width; ++column)
            append_texel(row, column, turned);
        append_texel(row, 0, turned);
    }

    void append_texel(std::uint32_t row, std::uint32_t column, bool turned) {
        // Half of an odd width lies between two texels.
        const std::uint32_t width = image_.width;
        const std::uint32_t one = turned ? (column + width / 2) % width : column;
        const std::uint32_t other = turned ? (column + (width + 1) / 2) % width : column;
        for (std::size_t c = 0; c < 3; ++c)
            flat_.texels.push_back(0.5F * value(row, one, c) + 0.5F * value(row, other, c));
    }

    [[nodiscard]] float value(std::uint32_t row, std::uint32_t column, std::size_t channel) const {
        return image_.radiance[3 * (std::size_t{row} * image_.width + column) + channel];
    }

    const EnvironmentImage& image_;
    FlatEnvironment& flat_;
};

shared::float4 axis_vector(const glm::dvec3& v) {
    const glm::vec3 f(v);
    return {f.x, f.y, f.z, 0.0F};
}

EnvironmentRecord image_record(const EnvironmentImage& image, const glm::dmat3& to_world) {
    EnvironmentRecord record{};
    record.x_axis = axis_vector(to_world[0]);
    record.y_axis = axis_vector(to_world[1]);
    record.z_axis = axis_vector(to_world[2]);
    record.width = image.width + 2;
    record.height = image.rows_at_poles ? std::max(image.height, 2U) : image.height + 2;
    record.column_scale = static_cast<float>(image.width);
    record.row_scale = static_cast<float>(image.rows_at_poles ? image.height - 1 : image.height);
    record.row_offset = image.rows_at_poles ? 0.0F : 0.5F;
    record.columns = std::min(most_cell_columns, cells_per_texel * image.width);
    record.rows = std::min(most_cell_rows, cells_per_texel * image.height);
    return record;
}

/// The share of the sphere that row `row` of the texels stands for: half the integral of what it
/// counts at an angle from the axis times the sine of that, between the neighbours' middles.
double row_share(const EnvironmentRecord& record, std::uint32_t row) {
    const double scale = static_cast<double>(record.row_scale) / half_turn;  // rows per radian
    const double offset = static_cast<double>(record.row_offset);
    const double at = static_cast<double>(row);
    if (!(scale > 0.0)) return row == 0 ? 1.0 : 0.0;
    double sum = 0.0;
    for (const double side : {-1.0, 1.0}) {
        const double begin = std::clamp((std::min(at, at + side) - offset) / scale, 0.0, half_turn);
        const double end = std::clamp((std::max(at, at + side) - offset) / scale, 0.0, half_turn);
        // 1 - side (scale angle + offset - row) times the sine, integrated.
        const double constant = 1.0 - side * (offset - at);
        const auto integral = [&](double angle) {
            return -constant * std::cos(angle) -
                   side * scale * (std::sin(angle) - angle * std::cos(angle));
        };
        if (end > begin) sum += integral(end) - integral(begin);
    }
    return 0.5 * sum;
}

/// Measures the mean over all directions and the largest radiance.
void measure(FlatEnvironment& flat) {
    const EnvironmentRecord& record = flat.records.front();
    for (std::uint32_t row = 0; row < record.height; ++row) {
        const auto texels =
            std::span(flat.texels)
                .subspan(std::size_t{3} * row * record.width, std::size_t{3} * record.width);
        glm::dvec3 sum(0.0);
        // Those beyond the edges repeat others.
        for (std::size_t i = 3; i + 3 < texels.size(); i += 3)
            sum += glm::dvec3(texels[i], texels[i + 1], texels[i + 2]);
        flat.mean += row_share(record, row) * sum / static_cast<double>(record.width - 2);
        flat.brightest = std::max(flat.brightest, *std::max_element(texels.begin(), texels.end()));
    }
}

/// Luminances of the texels in one row of cells.
class CellRow {
  public:
    CellRow(const EnvironmentRecord& record, std::span<const double> luminances)
        : record_(record), luminances_(luminances), line_(record.width), brightest_(record.width) {}

    /// Fills in the brightnesses of the cells between two cosines of the angle from the axis.
    void weigh(double top, double bottom, std::span<double> weights) {
        const double first = row_at(top);
        const double last = row_at(bottom);
        const auto steps = std::max<std::uint32_t>(
            least_look_ups, static_cast<std::uint32_t>(std::ceil(last - first)));
        std::fill(weights.begin(), weights.end(), 0.0);
        for (std::uint32_t i = 0; i < steps; ++i)
            add_line(row_at(top + (bottom - top) * (i + 0.5) / steps), 1.0 / steps, weights);
        find_brightest(first, last);
        for (std::uint32_t column = 0; column < record_.columns; ++column)
            weights[column] += share_of_brightest * brightest_in(column);
    }

  private:
    /// The row of texels, with its fraction, at a cosine of the angle from the axis.
    [[nodiscard]] double row_at(double cosine) const {
        return std::acos(std::clamp(cosine, -1.0, 1.0)) / half_turn *
                   static_cast<double>(record_.row_scale) +
               static_cast<double>(record_.row_offset);
    }
    [[nodiscard]] std::size_t index(double x, std::uint32_t count) const {
        return std::min(static_cast<std::size_t>(std::max(x, 0.0)), std::size_t{count} - 2);
    }
    [[nodiscard]] double column_at(double u) const {
        return u * static_cast<double>(record_.column_scale) + 0.5;
    }

    void add_line(double y, double share, std::span<double> weights) {
        const std::size_t row = index(y, record_.height);
        const double t = std::clamp(y - static_cast<double>(row), 0.0, 1.0);
        const auto upper = luminances_.subspan(row * record_.width, 2 * std::size_t{record_.width});
        for (std::size_t x = 0; x < record_.width; ++x)
            line_[x] = upper[x] * (1.0 - t) + upper[record_.width + x] * t;
        const std::uint32_t steps =
            std::max(least_look_ups, (record_.width + record_.columns - 1) / record_.columns);
        for (std::uint32_t column = 0; column < record_.columns; ++column) {
            double sum = 0.0;
            for (std::uint32_t i = 0; i < steps; ++i) {
                const double x = column_at((column + (i + 0.5) / steps) / record_.columns);
                const std::size_t at = index(x, record_.width);
                const double s = x - static_cast<double>(at);
                sum += line_[at] * (1.0 - s) + line_[at + 1] * s;
            }
            weights[column] += share / steps * sum;
        }
    }

    /// The brightest texels of each column that look-ups between two rows reach.
    void find_brightest(double first, double last) {
        const std::size_t begin = index(first, record_.height);
        const std::size_t end = index(last, record_.height) + 1;
        std::fill(brightest_.begin(), brightest_.end(), 0.0);
        for (std::size_t row = begin; row <= end; ++row)
            for (std::size_t x = 0; x < record_.width; ++x)
                brightest_[x] = std::max(brightest_[x], luminances_[row * record_.width + x]);
    }
    [[nodiscard]] double brightest_in(std::uint32_t column) const {
        const double columns = record_.columns;
        const std::size_t begin = index(column_at(column / columns), record_.width);
        const std::size_t end = index(column_at((column + 1) / columns), record_.width) + 1;
        return *std::max_element(brightest_.begin() + static_cast<std::ptrdiff_t>(begin),
                                 brightest_.begin() + static_cast<std::ptrdiff_t>(end) + 1);
    }

    const EnvironmentRecord& record_;
    std::span<const double> luminances_;
    std::vector<double> line_, brightest_;
};

/// Appends inclusive sums of probabilities in proportion to weights, as multiples of 2^-24. All are
/// 0 where all weights are.
void append_sums(std::span<const double> weights, std::vector<float>& sums) {
    constexpr double units = 0x1p24;
    double total = 0.0;
    for (const double weight : weights) total += weight;
    std::vector<std::int64_t> counts(weights.size(), 0);
    std::int64_t left = total > 0.0 ? static_cast<std::int64_t>(units) : 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        if (!(weights[i] > 0.0)) continue;
        counts[i] = std::max<std::int64_t>(1, std::llround(weights[i] / total * units));
        left -= counts[i];
    }
    // The largest is much larger than what rounding leaves.
    *std::max_element(counts.begin(), counts.end()) += left;
    std::int64_t sum = 0;
    for (const std::int64_t count : counts) {
        sum += count;
        sums.push_back(static_cast<float>(static_cast<double>(sum) / units));
    }
}

/// Luminances of texels over the largest one.
std::vector<double> luminances_of(const FlatEnvironment& flat) {
    std::vector<double> luminances;
    luminances.reserve(flat.texels.size() / 3);
    const double scale = flat.brightest > 0.0F ? 1.0 / static_cast<double>(flat.brightest) : 0.0;
    for (std::size_t i = 0; i < flat.texels.size(); i += 3)
        luminances.push_back(scale *
                             luminance({flat.texels[i], flat.texels[i + 1], flat.texels[i + 2]}));
    return luminances;
}

/// Gives cells their probabilities, and finds where light comes from, in the frame of the image.
glm::dvec3 weigh_cells(FlatEnvironment& flat) {
    const EnvironmentRecord& record = flat.records.front();
    const std::vector<double> luminances = luminances_of(flat);
    CellRow row(record, luminances);
    std::vector<double> weights(record.columns);
    std::vector<double> of_rows;
    std::vector<float> cells;
    glm::dvec3 moment(0.0);
    double sum = 0.0;
    for (std::uint32_t r = 0; r < record.rows; ++r) {
        const double top = 1.0 - 2.0 * r / record.rows;
        const double bottom = 1.0 - 2.0 * (r + 1) / record.rows;
        row.weigh(top, bottom, weights);
        append_sums(weights, cells);
        of_rows.push_back(0.0);
        const double height = 0.5 * (top + bottom);
        const double across = std::sqrt(1.0 - height * height);
        for (std::uint32_t column = 0; column < record.columns; ++column) {
            const double turn = 2.0 * half_turn * ((column + 0.5) / record.columns - 0.5);
            of_rows.back() += weights[column];
            moment += weights[column] *
                      glm::dvec3(across * std::cos(turn), height, across * std::sin(turn));
        }
        sum += of_rows.back();
    }
    append_sums(of_rows, flat.sums);
    flat.sums.insert(flat.sums.end(), cells.begin(), cells.end());
    return sum > 0.0 ? 2.0 * moment / sum : glm::dvec3(0.0);
}

}  // namespace

FlatEnvironment flatten_environment(const EnvironmentImage& image, const glm::dmat3& to_world) {
    FlatEnvironment flat;
    flat.records.push_back(image_record(image, to_world));
    Padding(image, flat).write(flat.records.front());
    measure(flat);
    flat.trend = to_world * weigh_cells(flat);
    return flat;
}

}  // namespace weft
