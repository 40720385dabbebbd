// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The error function and its inverse, for normal deviates, of the operations of maths.h only.
//
//   function         range       error                        elsewhere
//   m_erf            all         2 ulp, 3e-7 of x near 0      NaN: NaN
//   m_erf_inverse    (-1, 1)     2e-6 of the result           clamped; NaN: NaN
//
// The polynomials are fits as those of maths.h are, with errors below 2^-21.6.
#ifndef WEFT_KERNELS_CORE_ERROR_FUNCTION_H
#define WEFT_KERNELS_CORE_ERROR_FUNCTION_H

#include "kernels/core/maths.h"

/// erf(x) = 2 / sqrt(pi) times the integral of exp(-t^2) from 0 to x.
static inline float m_erf(float x) {
    float y = absolute(x);
    if (y < 1.0f) {
        float z = x * x;
        return x * (1.1283791f +
                    z * (-0.37612236f +
                         z * (0.11279379f +
                              z * (-0.026686873f + z * (0.0048874663f + z * -0.00055029604f)))));
    }
    if (y > 3.95f) return m_with_sign(1.0f, x);
    if (m_is_nan(x)) return x;
    float s = 1.0f / (1.0f + y);
    float tail = -0.00018293071f +
                 s * (0.56905496f +
                      s * (0.51151222f + s * (0.57930005f + s * (-1.1867465f + s * 0.54784703f))));
    return m_with_sign(1.0f - m_exp(-(x * x)) * tail, x);
}

/// The y with erf(y) = x, at most 3.84 away from 0: that of the float next to 1.
static inline float m_erf_inverse(float x) {
    float most = 0.99999994f;
    float y = m_clamp(x, -most, most);
    float w = -m_log((1.0f - y) * (1.0f + y));
    if (w < 5.0f)
        return y * (0.88622683f +
                    w * (0.23201697f +
                         w * (0.011530529f +
                              w * (-0.002294824f +
                                   w * (-0.00016998459f +
                                        w * (7.0021524e-05f +
                                             w * (-4.9047371e-06f +
                                                  w * (-1.7874009e-07f + w * 2.5893021e-08f))))))));
    float s = square_root(w);
    return y *
           (2.491008f +
            s * (-3.4961181f +
                 s * (3.2648628f +
                      s * (-1.3174944f +
                           s * (0.31782839f + s * (-0.045574628f +
                                                   s * (0.0035753231f + s * -0.00011749801f)))))));
}

#endif
