#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Launches that are wrong do not compile: swapped or missing buffers, a kernel that is not defined as
# it is declared, and arguments that take more than 1024 bytes. Each case is a copy of the sources
# with one change; the same copy without it has to compile.
set -u
compiler=${WEFT_CXX:?names the compiler}
sources=${WEFT_SOURCE_DIR:?names the source folder}
generated=${WEFT_BUILD_DIR:?names the build folder}/generated
folder=$(mktemp -d) || exit 1
trap 'rm -rf -- "$folder"' EXIT
failures=0

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# compile FILE [OPTION...]: the syntax and the types alone.
compile() {
    file=$1
    shift
    "$compiler" -std=c++20 -fsyntax-only -Wno-psabi -I"$folder/host" -I"$folder" -I"$generated" "$@" \
        "$folder/$file" >"$folder/log" 2>&1
}

# compiles FILE [OPTION...]
compiles() {
    compile "$@" || { fail "$1 does not compile"; cat "$folder/log" >&2; }
}

# refuses WHAT TEXT FILE [OPTION...]: it does not compile, and the message has TEXT.
refuses() {
    what=$1
    text=$2
    shift 2
    if compile "$@"; then
        fail "$what compiles"
    elif ! grep -q -- "$text" "$folder/log"; then
        fail "$what is refused for another reason than \"$text\""
        cat "$folder/log" >&2
    fi
}

# renew: the sources as they are.
renew() {
    rm -rf -- "$folder/host" "$folder/kernels"
    cp -R -- "$sources/host" "$sources/kernels" "$folder"
}

# change FILE SED-EXPRESSION: fails where that changes nothing.
change() {
    sed "$2" "$folder/$1" >"$folder/changed"
    cmp -s "$folder/changed" "$folder/$1" && fail "nothing in $1 matches $2"
    mv -- "$folder/changed" "$folder/$1"
}

# launch FIELDS: a launch of shadow_edges.
launch() {
    cat >"$folder/launch.cpp" <<END
#include "device/launch.h"
bool launch(weft::Executor& executor, const weft::DeviceBuffer<weft::kinds::PixelShadows>& shadows,
            const weft::DeviceBuffer<weft::kinds::ShadowEdges>& edges) {
    return weft::run_kernel(executor, {}, weft::kernels::shadow_edges{$1}, 1);
}
END
}

native=host/device/native/kernels_native.cpp
native_options="-DWEFT_LANES=1 -DWEFT_NATIVE_WORK=ITEMS -DWEFT_NATIVE_KERNELS=native_items.def \
-DWEFT_NATIVE_NAMESPACE=test_part -DWEFT_NATIVE_TABLE=test_table"

renew
launch '.pixel_shadows = shadows, .shadow_edges = edges'
compiles launch.cpp
launch '.pixel_shadows = edges, .shadow_edges = shadows'
refuses "a launch with two buffers swapped" "Required<weft::kinds::PixelShadows>" launch.cpp
launch '.pixel_shadows = shadows'
refuses "a launch without one of its buffers" "shadow_edges" launch.cpp

# shellcheck disable=SC2086 # options are words
compiles $native $native_options
change kernels/bvh/query_any.cl \
    's/^WEFT_KERNEL(query_any)/KERNEL_ENTRY void query_any(VALUE_ARGUMENT(RenderParams, params), VALUE_ARGUMENT(LaunchRange, range), SCENE_ARGUMENTS, GLOBAL const float4* ray_origin, GLOBAL int* blocked, GLOBAL const float4* ray_direction)/'
# shellcheck disable=SC2086
refuses "a kernel with arguments in another order than declared" \
    "query_any is not defined as signatures.h declares it" $native $native_options
renew
change kernels/core/signatures.h '/define ARGUMENTS_query_closest(X)/,/hits/ s/X(READS, RayDirections, ray_direction)//'
# shellcheck disable=SC2086
refuses "a kernel that uses an argument it does not declare" "ray_direction" $native $native_options

renew
compiles host/device/kernel_signature.cpp
change kernels/core/signatures.h '/define ARGUMENTS_query_any(X)/,/blocked/ s/X(TRACES, Scene, scene)/& X(VALUE, MediaRecord, space)/'
refuses "a kernel with more than 1024 bytes of arguments" \
    "arguments of kernel query_any take more than 1024 bytes" host/device/kernel_signature.cpp

[ "$failures" -eq 0 ] && echo "launches that are wrong do not compile"
exit "$((failures > 0))"
