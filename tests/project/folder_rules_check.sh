#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Checks that a folder that includes what it may not use does not build, and that declared circles
# are refused.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "$1" >&2
    exit 1
}

mkdir "$work/source"
for part in CMakeLists.txt CMakePresets.json LICENSE cmake host kernels bench scenes tests; do
    cp -R "$root/$part" "$work/source"
done

configure() {
    cmake -S "$work/source" -B "$work/build" -DWEFT_TESTS=OFF >"$work/log" 2>&1
}

# refused TARGET WHAT: building the target ends with that text in its output.
refused() {
    ! cmake --build "$work/build" --target "$1" >"$work/log" 2>&1 || fail "$1 was built"
    tr -s ' \n' '  ' <"$work/log" | grep -qF -- "$2" || {
        cat "$work/log" >&2
        fail "$1 failed without saying: $2"
    }
}

# includes FILE HEADER: adds that line at the end of a file.
includes() {
    cp "$work/source/$1" "$work/original"
    printf '#include "%s"\n' "$2" >>"$work/source/$1"
}
mended() { cp "$work/original" "$work/source/$1"; }

configure || { cat "$work/log" >&2; fail "the copy is not configured"; }
cmake --build "$work/build" --target weft_bvh_includes >"$work/log" 2>&1 || {
    cat "$work/log" >&2
    fail "host/bvh does not keep its rule as it is"
}

includes host/bvh/box.h scene/scene.h
refused weft_bvh 'host/bvh/box.h includes "scene/scene.h", but host/bvh may use only bvh, base, shared'
mended host/bvh/box.h

includes host/plan/halton.h ../base/error.h
refused weft_plan 'host/plan/halton.h includes "../base/error.h": files are named from the root'
mended host/plan/halton.h

includes kernels/bsdf/lambert.h kernels/light/light.h
refused weft_kernels_bsdf_includes \
    'kernels/bsdf/lambert.h includes "kernels/light/light.h", but kernels/bsdf may use only bsdf, core, bvh'
mended kernels/bsdf/lambert.h

# A circle: bvh would use what is declared after it.
sed 's/^weft_folder(bvh USES /&device /' "$root/host/CMakeLists.txt" >"$work/source/host/CMakeLists.txt"
! configure || fail "a circle of folders was configured"
grep -q 'host/bvh uses device, which is not declared before it' "$work/log" || {
    cat "$work/log" >&2
    fail "the circle was refused for another reason"
}
