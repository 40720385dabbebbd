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
    shared::Params params = film.params;
    const std::size_t pixels = std::size_t{params.width} * params.height;
    const std::size_t bytes = pixels * sizeof(std::uint32_t);
    if (built_.emplace(film.kernel, params.features).second)
        executor_.build(std::array{film.kernel}, params.features);
    if (!exposure_) exposure_ = executor_.allocate(4 * sizeof(float), "exposure of the display");
    if (!colours_ || colours_->bytes() != bytes)
        colours_ = executor_.allocate(bytes, "colours of the display");
    const auto factor = static_cast<float>(film.unit * std::exp2(display.exposure_ev()) /
                                           static_cast<double>(film.samples));
    write_buffer<float>(executor_, *exposure_, std::span<const float>(&factor, 1));
    params.samples = static_cast<std::uint32_t>(film.samples);
    std::vector<Buffer*> arguments = film.film;
    arguments.insert(arguments.end(), {exposure_.get(), colours_.get()});
    Launch launch{.kernel = film.kernel, .params = params, .scene = nullptr, .buffers = arguments};
    launch.items = static_cast<std::uint32_t>(pixels);
    if (!executor_.run(launch, {})) return;
    executor_.with_mapped(*colours_, Access::read, [&](std::span<std::byte> data) {
        display.show({params.width, params.height,
                      std::span(reinterpret_cast<const std::uint32_t*>(data.data()), pixels),
                      film.samples});
    });
}

}  // namespace weft
