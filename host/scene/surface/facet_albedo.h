// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_SCENE_SURFACE_FACET_ALBEDO_H
#define WEFT_SCENE_SURFACE_FACET_ALBEDO_H

#include <vector>

#include "scene/surface/gauss_legendre.h"

namespace weft {

/// Albedos of a surface of mirrors with the GGX distribution (Walter et al. 2007) and
/// height-correlated Smith masking (Heitz 2014), for light that is reflected once: the shares that
/// reflect all light, and that reflect the weight (1 - c)^5 of Schlick (1994).
struct FacetAlbedo {
    double all;
    double schlick;
};

/// Shares of light that facets of clear glass reflect and refract, to the sides where they belong.
struct GlassShares {
    double reflected;
    double transmitted;
};

/// Albedos by quadrature over the facets that a direction sees.
class FacetQuadrature {
  public:
    /// Uses points x points facets. 128 give facet_albedo to 5e-5 and glass_albedo to 2e-3, 64 to
    /// 1e-4 and 3e-3.
    explicit FacetQuadrature(int points);

    /// Albedos of a direction with that cosine, above 0.
    [[nodiscard]] FacetAlbedo facet_albedo(double cosine, double alpha) const;

    /// The share of light that facets of clear glass reflect or refract in one step, to the sides
    /// where it belongs. `eta` is the index beyond the surface over that on the side of the
    /// direction.
    [[nodiscard]] double glass_albedo(double cosine, double alpha, double eta) const;

    /// The shares apart, for facets with independent masking of both directions, of GGX or of
    /// Beckmann's distribution. Of the latter the direction has exact masking, those of what is
    /// reflected and refracted the fit of Walter et al. 2007, as in Mitsuba's tables.
    [[nodiscard]] GlassShares separable_albedo(double cosine, double alpha, double eta,
                                               bool beckmann) const;

  private:
    template <class Visit>
    void for_visible_facets(double cosine, double alpha, double k, const Visit& visit) const;

    struct CirclePoint {
        double cosine, sine;
    };
    std::vector<QuadraturePoint> rule_;
    std::vector<CirclePoint> circle_;
};

}  // namespace weft

#endif
