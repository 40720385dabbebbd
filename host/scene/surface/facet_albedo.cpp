// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/surface/facet_albedo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

struct FacetVector {
    double x, y, z;
};

double facet_dot(FacetVector a, FacetVector b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// s(w) of kernels/bsdf/microfacet.h.
double facet_stretch(FacetVector w, double alpha) {
    return std::sqrt(alpha * alpha * (w.x * w.x + w.y * w.y) + w.z * w.z);
}

FacetVector facet_direction(double cosine) {
    return {std::sqrt((1 - cosine) * (1 + cosine)), 0.0, cosine};
}

FacetVector reflected(FacetVector v, FacetVector m, double c) {
    return {2 * c * m.x - v.x, 2 * c * m.y - v.y, 2 * c * m.z - v.z};
}

/// masking_length of kernels/bsdf/microfacet.h for Beckmann's distribution.
double beckmann_masking(FacetVector w, double alpha) {
    const double height = std::abs(w.z);
    const double slope = alpha * std::sqrt(w.x * w.x + w.y * w.y);
    if (height >= 1.6 * slope) return height;
    const double a = height / slope;
    return height + 2 * slope * (1 - 1.259 * a + 0.396 * a * a) / (3.535 + 2.181 * a);
}

/// The same without that fit.
double exact_beckmann_masking(FacetVector w, double alpha) {
    const double height = std::abs(w.z);
    const double slope = alpha * std::sqrt(w.x * w.x + w.y * w.y);
    if (!(slope > 0.0)) return height;
    const double a = height / slope;
    return height * std::erf(a) + slope * std::exp(-a * a) * std::numbers::inv_sqrtpi;
}

/// What a facet of glass lets through, and where to; a direction of 0 at total reflection.
struct GlassFacet {
    double transmitted;
    FacetVector refracted;
};

GlassFacet glass_facet(FacetVector v, FacetVector m, double c, double eta) {
    const double e = (eta - 1) * (eta + 1);
    const double square = c * c + e;
    if (!(square > 0.0)) return {0.0, {0.0, 0.0, 0.0}};
    const double g = std::sqrt(square);
    const double other = eta * eta * c + g;
    const double step = e / (c + g);
    return {2 * c * g * (1 / ((c + g) * (c + g)) + eta * eta / (other * other)),
            {-(v.x + m.x * step) / eta, -(v.y + m.y * step) / eta, -(v.z + m.z * step) / eta}};
}

}  // namespace

FacetQuadrature::FacetQuadrature(int points) : rule_(gauss_legendre(points)) {
    // Half of it: the other is the mirror image.
    for (int i = 0; i < points; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / points;
        circle_.push_back({std::cos(angle), std::sin(angle)});
    }
}

/// Calls visit(m, c, weight) for facets that the direction v in the plane y = 0 sees: c is the
/// cosine between the two, and the weights sum to 1 over all facets in view (Dupuy and Benyoub
/// 2023). `k` limits the cap that normals come from (Eto and Tokuyoshi 2023), 1 for all of it.
template <class Visit>
void FacetQuadrature::for_visible_facets(double cosine, double alpha, double k,
                                         const Visit& visit) const {
    const FacetVector v = facet_direction(cosine);
    const double length = facet_stretch(v, alpha);
    const FacetVector h = {alpha * v.x / length, 0.0, v.z / length};
    for (const auto& [x, weight] : rule_) {
        const double less = (x + 1) / 2 * (1 + k * h.z);
        const double radius = std::sqrt(less * (2 - less));
        const double height = std::max(1 - less + h.z, 0.0);
        for (const auto& [c, s] : circle_) {
            const FacetVector n = {alpha * (radius * c + h.x), alpha * radius * s, height};
            const double size = std::sqrt(facet_dot(n, n));
            const FacetVector m = {n.x / size, n.y / size, n.z / size};
            visit(m, facet_dot(v, m), weight / (2 * static_cast<double>(circle_.size())));
        }
    }
}

FacetAlbedo FacetQuadrature::facet_albedo(double cosine, double alpha) const {
    if (alpha == 0.0) return {1.0, std::pow(1 - cosine, 5)};
    const FacetVector v = facet_direction(cosine);
    const double sv = facet_stretch(v, alpha);
    const double a = std::min(alpha, 1.0);
    const double t = 1 + v.x;
    const double k = (1 - a * a) * t * t / (t * t + a * a * cosine * cosine);
    FacetAlbedo sum = {0.0, 0.0};
    for_visible_facets(cosine, alpha, k, [&](FacetVector m, double c, double weight) {
        const FacetVector l = reflected(v, m, c);
        if (!(l.z > 0.0)) return;
        const double w = weight * l.z * (k * v.z + sv) / (v.z * facet_stretch(l, alpha) + l.z * sv);
        const double less = std::max(0.0, 1 - c);
        sum.all += w;
        sum.schlick += w * (less * less) * (less * less) * less;
    });
    return sum;
}

double FacetQuadrature::glass_albedo(double cosine, double alpha, double eta) const {
    if (alpha == 0.0) return 1.0;
    const FacetVector v = facet_direction(cosine);
    const double sv = facet_stretch(v, alpha);
    double sum = 0.0;
    for_visible_facets(cosine, alpha, 1.0, [&](FacetVector m, double c, double weight) {
        const GlassFacet glass = glass_facet(v, m, c, eta);
        const auto seen = [&](FacetVector l) {
            const double lz = std::abs(l.z);
            return lz * (v.z + sv) / (v.z * facet_stretch(l, alpha) + lz * sv);
        };
        if (glass.refracted.z < 0.0) sum += weight * glass.transmitted * seen(glass.refracted);
        const FacetVector l = reflected(v, m, c);
        if (l.z > 0.0) sum += weight * (1 - glass.transmitted) * seen(l);
    });
    return std::min(sum, 1.0);
}

GlassShares FacetQuadrature::separable_albedo(double cosine, double alpha, double eta,
                                              bool beckmann) const {
    const FacetVector v = facet_direction(cosine);
    const double sv = facet_stretch(v, alpha);
    GlassShares sum = {0.0, 0.0};
    for_visible_facets(cosine, alpha, 1.0, [&](FacetVector m, double c, double weight) {
        if (beckmann) {
            // Of facets that are chosen by the other distribution. Mitsuba's tables come of samples
            // of the visible ones, whose density has exact masking.
            const double e = (m.x * m.x + m.y * m.y) / (m.z * m.z * alpha * alpha);
            weight *= std::exp(-e) * (1 + e) * (1 + e) * (v.z + sv) /
                      (v.z + exact_beckmann_masking(v, alpha));
        }
        const GlassFacet glass = glass_facet(v, m, c, eta);
        const auto seen = [&](FacetVector l) {
            const double sl = beckmann ? beckmann_masking(l, alpha) : facet_stretch(l, alpha);
            return 2 * std::abs(l.z) / (std::abs(l.z) + sl);
        };
        if (glass.refracted.z < 0.0)
            sum.transmitted += weight * glass.transmitted * seen(glass.refracted);
        const FacetVector l = reflected(v, m, c);
        if (l.z > 0.0) sum.reflected += weight * (1 - glass.transmitted) * seen(l);
    });
    return sum;
}

}  // namespace weft
