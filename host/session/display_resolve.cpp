// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "session/display_resolve.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

void DisplayResolve::show(const FilmView& film, DisplayDriver& display) {
    const shared::CameraParams& camera = film.params.camera;
    const std::uint32_t pixels = camera.width * camera.height;
    const KernelId kernel = film.sums ? KernelId::resolve_display_sums : KernelId::resolve_display;
    if (built_.emplace(kernel, film.params.features).second)
        executor_.build(std::array{kernel}, film.params.features);
    if (!colours_ || colours_->bytes() != pixels * sizeof(std::uint32_t))
        colours_ = allocate<kinds::DisplayColours>(executor_, pixels, "colours of the display");
    const auto exposure = static_cast<float>(film.unit * std::exp2(display.exposure_ev()) /
                                             static_cast<double>(film.samples));
    if (!resolve(film, exposure, display.tone(), pixels)) return;
    executor_.with_mapped(*colours_, Access::read, [&](std::span<std::byte> data) {
        display.show({camera.width, camera.height,
                      std::span(reinterpret_cast<const std::uint32_t*>(data.data()), pixels),
                      film.samples});
    });
}

bool DisplayResolve::resolve(const FilmView& film, float exposure, ToneCurve tone,
                             std::uint32_t pixels) {
    const auto curve = static_cast<std::uint32_t>(tone);
    if (film.sums)
        return run_kernel(
            executor_, film.params,
            kernels::resolve_display_sums{
                .exposure = exposure, .tone = curve, .film_sums = film.sums, .colours = colours_},
            pixels);
    return run_kernel(executor_, film.params,
                      kernels::resolve_display{.samples = static_cast<std::uint32_t>(film.samples),
                                               .exposure = exposure,
                                               .tone = curve,
                                               .film_high = film.high,
                                               .film_low = film.low,
                                               .colours = colours_},
                      pixels);
}

}  // namespace weft
