// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <random>

#define NATIVE_KERNELS "kernels/cache/cache_records.cl"
#include "tests/testing/native_kernels.h"

// What a VPL adds to the derivatives of a record, against central differences of the geometry term
// in double precision. Their own error is of the order of (h / d)^2 of the derivative; the step h
// is 1e-4 of the distance d, so 1e-4 of the derivatives' sizes, f / d and f / d^2, leaves room for
// the rounding of the kernel's floats alone.
namespace weft::cache_records_test {
namespace {

constexpr double tolerance = 1e-4;

struct Connection {
    glm::dvec3 place, normal, vpl, vpl_normal;
};

double geometry_term(const Connection& c) {
    const glm::dvec3 v = c.vpl - c.place;
    const double s = glm::dot(v, v);
    return glm::dot(c.normal, v) * -glm::dot(c.vpl_normal, v) / (s * s);
}

/// Exactly what floats hold, so that both sides see the same numbers.
glm::dvec3 rounded(const glm::dvec3& v) {
    return glm::dvec3(glm::vec3(v));
}

native::float3 three(const glm::dvec3& v) {
    return native::f3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z));
}

glm::dvec3 vector_of(const native::WFloat3& v) {
    return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

/// Places on both lit sides, by rejection.
Connection random_connection(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto point = [&] {
        return glm::dvec3(uniform(random), uniform(random), uniform(random));
    };
    while (true) {
        Connection c{rounded(point()), rounded(glm::normalize(point())), rounded(point()),
                     rounded(glm::normalize(point()))};
        const glm::dvec3 v = c.vpl - c.place;
        const double d = glm::length(v);
        if (d > 0.2 && glm::dot(c.normal, v) > 0.05 * d && glm::dot(c.vpl_normal, v) < -0.05 * d)
            return c;
    }
}

/// The kernel's derivatives for light of luminance 1 and channels 0.5, 1, 1.4.
struct Derivatives {
    native::WideChange change;
    glm::dvec3 tangent, bitangent;
};

constexpr float channels[] = {0.5F, 1.0F, 1.4F};
const double bright = 0.2126 * 0.5 + 0.7152 * 1.0 + 0.0722 * 1.4;

Derivatives derivatives_of(const Connection& c) {
    native::ReceiverPacket packet;
    packet.position = native::wide_vector(three(c.place).x, three(c.place).y, three(c.place).z);
    packet.shading = native::wide_vector(three(c.normal).x, three(c.normal).y, three(c.normal).z);
    packet.normal = packet.shading;
    packet.valid = true;
    native::float3 t;
    native::float3 b;
    native::make_basis(three(c.normal), &t, &b);
    native::WideLight light;
    light.red = channels[0];
    light.green = channels[1];
    light.blue = channels[2];
    const native::float3 d = three(c.place - c.vpl);
    Derivatives found{native::no_change(), {t.x, t.y, t.z}, {b.x, b.y, b.z}};
    native::add_change(&packet, three(c.vpl_normal), native::wide_vector(d.x, d.y, d.z),
                       native::wide_vector(t.x, t.y, t.z), native::wide_vector(b.x, b.y, b.z),
                       &light, &found.change);
    return found;
}

TEST(CacheRecords, GradientsOverPlacesAreThoseOfTheGeometryTerm) {
    std::mt19937 random(1);
    for (int i = 0; i < 2000; ++i) {
        const Connection c = random_connection(random);
        const double d = glm::distance(c.place, c.vpl);
        const double h = 1e-4 * d;
        glm::dvec3 expected;
        for (int axis = 0; axis < 3; ++axis) {
            Connection more = c;
            Connection less = c;
            more.place[axis] += h;
            less.place[axis] -= h;
            expected[axis] = (geometry_term(more) - geometry_term(less)) / (2.0 * h);
        }
        const Derivatives found = derivatives_of(c);
        const double size = 1.0 / (d * d * d);
        const native::WFloat3* const moves[] = {&found.change.move_red, &found.change.move_green,
                                                &found.change.move_blue};
        for (int k = 0; k < 3; ++k)
            EXPECT_LE(
                glm::distance(vector_of(*moves[k]), expected * static_cast<double>(channels[k])),
                tolerance * size * 1.4);
    }
}

TEST(CacheRecords, GradientsOverTurnsAreThoseOfTheGeometryTerm) {
    std::mt19937 random(2);
    for (int i = 0; i < 2000; ++i) {
        const Connection c = random_connection(random);
        const double d = glm::distance(c.place, c.vpl);
        const Derivatives found = derivatives_of(c);
        for (const glm::dvec3& way : {found.tangent, found.bitangent}) {
            const double h = 1e-4;
            Connection more = c;
            Connection less = c;
            more.normal = c.normal + h * way;
            less.normal = c.normal - h * way;
            const double expected = (geometry_term(more) - geometry_term(less)) / (2.0 * h);
            const glm::dvec3 turn = glm::cross(c.normal, way);
            EXPECT_NEAR(glm::dot(vector_of(found.change.turn_green), turn), expected,
                        tolerance / (d * d));
            EXPECT_NEAR(glm::dot(vector_of(found.change.turn_red), turn), 0.5 * expected,
                        tolerance / (d * d));
        }
    }
}

TEST(CacheRecords, CurvatureInTheTangentPlaneIsThatOfTheGeometryTerm) {
    std::mt19937 random(3);
    for (int i = 0; i < 2000; ++i) {
        const Connection c = random_connection(random);
        const double d = glm::distance(c.place, c.vpl);
        const double h = 1e-3 * d;
        const Derivatives found = derivatives_of(c);
        const auto at = [&](double u, double v) {
            Connection moved = c;
            moved.place += u * found.tangent + v * found.bitangent;
            return geometry_term(moved);
        };
        const double along = (at(h, 0.0) - 2.0 * at(0.0, 0.0) + at(-h, 0.0)) / (h * h);
        const double across = (at(0.0, h) - 2.0 * at(0.0, 0.0) + at(0.0, -h)) / (h * h);
        const double mixed = (at(h, h) - at(h, -h) - at(-h, h) + at(-h, -h)) / (4.0 * h * h);
        // The fourth derivative is within 1000 f / d^4: differences are off by 1e-4 as well.
        const double size = 2.0 * tolerance / (d * d * d * d);
        EXPECT_NEAR(static_cast<double>(found.change.along), along * bright, size);
        EXPECT_NEAR(static_cast<double>(found.change.across), across * bright, size);
        EXPECT_NEAR(static_cast<double>(found.change.mixed), mixed * bright, size);
    }
}

TEST(CacheRecords, RadiiFollowTheErrorAndTheShareOfLightThatIsSeen) {
    native::RenderParams params{};
    params.sampling.record_error = 0.1F;
    native::WideChange change = native::no_change();
    change.along = 3.0F;
    change.across = -1.0F;
    change.mixed = 0.75F;
    change.seen = 1.0F;
    change.all = 1.0F;
    const native::WFloat3 t = native::wide_vector(1.0F, 0.0F, 0.0F);
    const native::WFloat3 b = native::wide_vector(0.0F, 1.0F, 0.0F);
    // Eigenvalues 1 +- sqrt(4 + 0.5625): their sizes add up to twice the root.
    const double bend = 2.0 * std::sqrt(4.5625);
    const float open = native::error_radius(&params, &change, t, b, 2.0F);
    EXPECT_NEAR(open, std::sqrt(8.0 * 0.1 * 2.0 / bend), 1e-6);
    // A record that sees half of its light serves less far, one that sees none as far.
    change.seen = 0.5F;
    EXPECT_LT(native::error_radius(&params, &change, t, b, 2.0F), 0.7F * open);
    change.seen = 0.0F;
    EXPECT_EQ(native::error_radius(&params, &change, t, b, 2.0F), open);
    // Steep light ends what a record serves, whatever its curvature.
    change.move_green = native::wide_vector(0.0F, 1e4F, 0.0F);
    EXPECT_LT(native::error_radius(&params, &change, t, b, 2.0F), 2e-4F);
    // In the dark all is alike.
    EXPECT_GE(native::error_radius(&params, &change, t, b, 0.0F), 0.0F);
    const native::WideChange none = native::no_change();
    EXPECT_EQ(native::error_radius(&params, &none, t, b, 0.0F), MEDIA_EVERYWHERE);
}

}  // namespace
}  // namespace weft::cache_records_test
