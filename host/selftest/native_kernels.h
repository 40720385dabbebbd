// Copyright 2026 The Weft Authors
// SPDX-License-Identifier: Apache-2.0
//
// A file of kernels/ as C++ at one lane, in namespace `native`, for checks that call its functions
// one by one:
//
//   #define NATIVE_KERNELS "kernels/media/medium.h"
//   #include "selftest/native_kernels.h"
//
// NATIVE_KERNELS_TOO may name a second file. A source file can include this once, after all headers
// of the host, because macros of the kernels stay defined.
#ifndef WEFT_SELFTEST_NATIVE_KERNELS_H
#define WEFT_SELFTEST_NATIVE_KERNELS_H

#ifndef NATIVE_KERNELS
#error "NATIVE_KERNELS must name the file of kernels/ to include"
#endif

#include "device/native/native_scene.h"

#if defined(__x86_64__) || defined(__i386__)
#include <immintrin.h>
#endif

#define LANES 1
#undef WEFT_KERNELS_CORE_TYPES_H  // the host's structs are those of another namespace
#pragma GCC diagnostic push
// A check uses only some of the functions that it includes.
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
