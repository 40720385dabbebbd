// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The list has every lobe once: ENTRY(NUMBER, name, surface). LOBE_<NUMBER> is its number in
// materials, bsdf/<name>.h has its functions <name>_flags, <name>_eval and so on (bsdf/bsdf.h), and
// `surface` is the struct of its parameters that scene readers fill in (host/scene/surface/).
// Lambert's lobe is the first, which stands for any number that is not in the list.
#ifndef WEFT_KERNELS_BSDF_LOBES_H
#define WEFT_KERNELS_BSDF_LOBES_H

#define ALL_LOBES(ENTRY) ENTRY(LAMBERT, lambert, DiffuseSurface)

#endif
