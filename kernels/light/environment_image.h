// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// An image of the environment in equirectangular projection: its radiance by direction, and choice
// of directions by its brightness. Along a row of the image u grows with the turn about the axis y
// from -x over -z, x and z; along a column v grows with the angle from y. Directions are chosen by
// cells that all have the same solid angle (equal steps of u and of the cosine of v), so that the
// pdf is that of the cell times a constant, at the poles as well (host/scene/flat_environment.h
// gives cells their probabilities).
#ifndef WEFT_KERNELS_LIGHT_ENVIRONMENT_IMAGE_H
#define WEFT_KERNELS_LIGHT_ENVIRONMENT_IMAGE_H

#include "kernels/core/sampling.h"

#define SPHERE_SOLID_ANGLE 12.5663706f  // 4 pi

#define ENVIRONMENT_MAKE(name)        \
    EnvironmentImage name;            \
    name.record = environment_record; \
    name.texels = environment_texels; \
    name.sums = environment_sums

// Of scenes without FEATURE_IMAGE_ENVIRONMENT nothing here is ever read.
typedef struct {
    GLOBAL const EnvironmentRecord* record;
    GLOBAL const float* texels;
    // Inclusive sums of the probabilities of rows of cells, then by row of the cells in it.
    GLOBAL const float* sums;
} EnvironmentImage;

// A direction towards the image, and what comes from there.
typedef struct {
    float3 direction;  // unit
    float3 radiance;
    float pdf;  // 1/sr
} EnvironmentSample;

// Where a direction lies on the image.
typedef struct {
    float u, v;    // in [0, 1]
    float height;  // cosine with the axis y
} ImagePlace;

/// The coordinate v of a direction of which `height` is along the axis y and `across` off it.
static inline float image_v(float across, float height) {
    return m_clamp(m_atan2(across, height) * M_INV_PI, 0.0f, 1.0f);
}

/// The place of a direction of any length.
static inline ImagePlace image_place(const EnvironmentImage* image, float3 direction) {
    GLOBAL const EnvironmentRecord* record = image->record;
    float x = dot3(direction, xyz(record->x_axis));
    float y = dot3(direction, xyz(record->y_axis));
    float z = dot3(direction, xyz(record->z_axis));
    float square = x * x + z * z;
    ImagePlace place;
    place.u = m_clamp(0.5f + m_atan2(z, x) * M_INV_TWO_PI, 0.0f, 1.0f);
    place.v = image_v(square_root(square), y);
    place.height = y / square_root(square + y * y);
    return place;
}

/// Index of the cell that `x` lies in, of `count` cells of width 1 from 0 on.
static inline uint cell_index(float x, uint count) {
    uint cell = (uint)m_max(x, 0.0f);
    return cell < count ? cell : count - 1u;
}

static inline float3 image_texel(GLOBAL const float* texel) {
    return f3(texel[0], texel[1], texel[2]);
}

/// A value between two texels; never below both, whatever they are.
static inline float3 between_texels(float3 a, float3 b, float share) {
    return a * (1.0f - share) + b * share;
}

/// Radiance from a place, between the four texels about it.
static inline float3 radiance_at_place(const EnvironmentImage* image, ImagePlace place) {
    GLOBAL const EnvironmentRecord* record = image->record;
    // The first column is that beyond the left edge, half of which is left of the middle of u = 0.
    float x = place.u * record->column_scale + 0.5f;
    float y = place.v * record->row_scale + record->row_offset;
    uint column = cell_index(x, record->width - 1u);
    uint row = cell_index(y, record->height - 1u);
    float s = m_clamp(x - (float)column, 0.0f, 1.0f);
    float t = m_clamp(y - (float)row, 0.0f, 1.0f);
    GLOBAL const float* upper = image->texels + 3u * ((size_t)row * record->width + column);
    GLOBAL const float* lower = upper + 3u * (size_t)record->width;
    float3 above = between_texels(image_texel(upper), image_texel(upper + 3), s);
    float3 below = between_texels(image_texel(lower), image_texel(lower + 3), s);
    return between_texels(above, below, t);
}

/// Radiance from that direction, of any length.
static inline float3 image_radiance(const EnvironmentImage* image, float3 direction) {
    return radiance_at_place(image, image_place(image, direction));
}

/// The probability of entry `i` by inclusive sums.
static inline float entry_probability(GLOBAL const float* sums, uint i) {
    return i == 0u ? sums[0] : sums[i] - sums[i - 1u];
}

/// Pdf, 1/sr, of cells with a probability of 1: their number over the sphere.
static inline float cell_pdf(GLOBAL const EnvironmentRecord* record) {
    return (float)record->columns * (float)record->rows * (1.0f / SPHERE_SOLID_ANGLE);
}

/// Pdf, 1/sr, with which sample_image chooses the direction of a place.
static inline float pdf_at_place(const EnvironmentImage* image, ImagePlace place) {
    GLOBAL const EnvironmentRecord* record = image->record;
    uint row = cell_index((0.5f - 0.5f * place.height) * (float)record->rows, record->rows);
    uint column = cell_index(place.u * (float)record->columns, record->columns);
    float of_row = entry_probability(image->sums, row);
    GLOBAL const float* cells = image->sums + record->rows + row * record->columns;
    return of_row * entry_probability(cells, column) * cell_pdf(record);
}

/// Chooses a direction by the cells of the image, and in a cell evenly.
static inline EnvironmentSample sample_image(const EnvironmentImage* image, float u, float v) {
    GLOBAL const EnvironmentRecord* record = image->record;
    uint row = find_entry(image->sums, 1u, record->rows, v);
    float of_row = entry_probability(image->sums, row);
    float down = rescale_number(v, image->sums[row] - of_row, of_row);
    GLOBAL const float* cells = image->sums + record->rows + row * record->columns;
    uint column = find_entry(cells, 1u, record->columns, u);
    float of_cell = entry_probability(cells, column);
    float along = rescale_number(u, cells[column] - of_cell, of_cell);
    ImagePlace place;
    place.height = 1.0f - 2.0f * (((float)row + down) / (float)record->rows);
    place.u = m_min(((float)column + along) / (float)record->columns, 1.0f);
    float sine, cosine;
    m_sincos(M_TWO_PI * (place.u - 0.5f), &sine, &cosine);
    float across = square_root(m_max(0.0f, (1.0f - place.height) * (1.0f + place.height)));
    place.v = image_v(across, place.height);
    EnvironmentSample sample;
    sample.direction = xyz(record->x_axis) * (across * cosine) +
                       xyz(record->y_axis) * place.height + xyz(record->z_axis) * (across * sine);
    sample.radiance = radiance_at_place(image, place);
    sample.pdf = of_row * of_cell * cell_pdf(record);
    return sample;
}

#endif
