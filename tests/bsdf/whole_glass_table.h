// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
#ifndef WEFT_TESTS_BSDF_WHOLE_GLASS_TABLE_H
#define WEFT_TESTS_BSDF_WHOLE_GLASS_TABLE_H

#include <vector>

#include "scene/surface/glass_table.h"

namespace weft::test {

/// All rows of a GlassTable.
inline std::vector<float> whole_glass_table(double eta) {
    std::vector<float> table(glass_table_size);
    GlassTable(eta).write_rows(0.0, 1.0, table);
    return table;
}

}  // namespace weft::test

#endif
