// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// The functions of a file of kernels/ as C++ at one lane, in namespace `native`, for a host that
// computes what kernels do:
//
//   #define NATIVE_KERNELS "kernels/film/tone.h"
//   #include "shared/native_functions.h"
//
// NATIVE_KERNELS_TOO may name a second file. A source file can include this once, after all headers
// of the host, because macros of the kernels stay defined. Files that trace rays need what
// selftest/native_kernels.h adds.
#ifndef WEFT_SHARED_NATIVE_FUNCTIONS_H
#define WEFT_SHARED_NATIVE_FUNCTIONS_H

#ifndef NATIVE_KERNELS
#error "NATIVE_KERNELS must name the file of kernels/ to include"
#endif

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

#define LANES 1
#undef WEFT_KERNELS_CORE_TYPES_H  // the host's structs are those of another namespace
#pragma GCC diagnostic push
// A source file uses only some of the functions that it includes.
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wpsabi"
#pragma GCC diagnostic ignored "-Wpedantic"
namespace native {
#include NATIVE_KERNELS
#ifdef NATIVE_KERNELS_TOO
#include NATIVE_KERNELS_TOO
#endif
}  // namespace native
#pragma GCC diagnostic pop

#endif
