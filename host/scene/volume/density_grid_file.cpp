// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#include "scene/volume/density_grid_file.h"

#include <cstddef>
#include <vector>

#include "base/error.h"
#include "base/file.h"
#include "base/limits.h"
#include "scene/volume/nanovdb_file.h"
#include "scene/volume/nanovdb_reader.h"
#include "scene/volume/vol_reader.h"

namespace weft {

DensityGrid read_density_grid(const std::filesystem::path& path, const std::string& name,
                              const std::string& place, Diagnostics& diagnostics) {
    const std::vector<std::byte> bytes = read_file(path, limits::max_binary_file_bytes, place);
    const std::string file = path.string();
    if (is_nanovdb(bytes)) return decode_nanovdb(bytes, name, file, diagnostics);
    if (is_vol(bytes)) return decode_vol(bytes, file, diagnostics);
    throw input_error(file,
                      "not a density grid, expected a Mitsuba grid volume (VOL) or a NanoVDB "
                      "file (NanoVDB0)");
}

}  // namespace weft
