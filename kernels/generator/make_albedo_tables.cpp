// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// Writes kernels/bsdf/albedo_values.h, the tables of facet_albedo, to standard output. Takes about
// half a minute:
//
//   cmake --build build/release --target make_albedo_tables
//   build/release/make_albedo_tables > kernels/bsdf/albedo_values.h
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "scene/surface/albedo_grid.h"
#include "scene/surface/facet_albedo.h"

namespace {

constexpr int nodes = 48;
constexpr int values_per_line = 8;

/// A table of constants. Values have six decimals and are rounded up, so that they stay above what
/// they stand for.
void print_table(const char* comment, const char* name, const std::vector<float>& values) {
    std::printf("\n// %s\nCONSTANT_TABLE float %s[%zu] = {\n", comment, name, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double rounded = std::ceil(static_cast<double>(values[i]) * 1e6 - 1e-3) * 1e-6;
        const bool ends = i + 1 == values.size() || (i + 1) % values_per_line == 0;
        std::printf("%s%.6ff%s", i % values_per_line == 0 ? "    " : "", std::min(rounded, 1.0),
                    i + 1 == values.size() ? "};\n" : (ends ? ",\n" : ", "));
    }
}

/// The mean over all directions of a row of a table, weighted by their cosines.
std::vector<float> means(const weft::AlbedoGrid& grid, const weft::AlbedoGrid::Albedo& albedo) {
    std::vector<float> values;
    for (int row = 0; row < nodes; ++row) {
        double sum = 0.0;
        for (const auto& [x, weight] : weft::gauss_legendre(64)) {
            const double cosine = (x + 1) / 2;
            sum += weight * cosine * albedo(cosine, grid.alpha_of(row));
        }
        values.push_back(static_cast<float>(sum));
    }
    return values;
}

}  // namespace

int main() {
    std::printf(
        "// Copyright 2026 The Weft Authors\n"
        "// SPDX-License-Identifier: Apache-2.0\n"
        "//\n"
        "// The tables of albedo_tables.h, written by kernels/generator/make_albedo_tables.cpp.\n"
        "#ifndef WEFT_KERNELS_BSDF_ALBEDO_VALUES_H\n"
        "#define WEFT_KERNELS_BSDF_ALBEDO_VALUES_H\n"
        "\n"
        "#include \"kernels/core/port.h\"\n"
        "\n"
        "#define ALBEDO_NODES %d\n"
        "\n"
        "// clang-format off\n",
        nodes);
    const weft::FacetQuadrature quadrature(128);
    const auto all = [&](double cosine, double alpha) {
        return quadrature.facet_albedo(cosine, alpha).all;
    };
    const auto schlick = [&](double cosine, double alpha) {
        return quadrature.facet_albedo(cosine, alpha).schlick;
    };
    weft::AlbedoGrid whole(nodes, all);
    weft::AlbedoGrid edge(nodes, schlick);
    const std::vector<float> whole_means = means(whole, all);
    const std::vector<float> edge_means = means(edge, schlick);
    whole.raise(all, 4);
    edge.raise(schlick, 4);
    print_table("Albedo of facets that reflect all light: rows of alpha, columns of cosines.",
                "facet_albedos", whole.rounded_up());
    print_table("The same of facets that reflect Schlick's weight.", "schlick_albedos",
                edge.rounded_up());
    print_table("Means of facet_albedos over all directions, one for each alpha.",
                "mean_facet_albedos", whole_means);
    print_table("The same of schlick_albedos.", "mean_schlick_albedos", edge_means);
    std::printf("// clang-format on\n\n#endif\n");
    return 0;
}
