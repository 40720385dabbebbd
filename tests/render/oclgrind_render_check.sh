#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Renders a small image under Oclgrind, which simulates an OpenCL device and reports every invalid
# access, data race, misuse of the interface and use of uninitialised memory, and compares it with
# the native kernels' image. Exit code 77 where Oclgrind is not installed.
set -eu

[ -z "${WEFT_SANITIZED:-}" ] || { echo "sanitizers and Oclgrind do not mix"; exit 77; }
command -v oclgrind >/dev/null || { echo "oclgrind is not installed"; exit 77; }
: "${WEFT_PROGRAM:?the built program}" "${WEFT_SOURCE_DIR:?the source tree}"
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
export WEFT_LANES=1
scene=$WEFT_SOURCE_DIR/scenes/cornell-box.gltf
# Few VPLs, each of which looks for neighbours among all others, and few samples: of simulated
# kernels every instruction counts.
preset=$folder/preset.json
echo '{"weft_preset": 1, "vpls": 16, "spp": 2, "compensation": true, "near_residual": true}' >"$preset"

# check NAME SIZE ALGORITHM OCLGRIND_OPTION...: renders; anything that Oclgrind says is an error.
# Kernels are not optimised: Oclgrind knows neither every intrinsic function that the optimiser
# leaves behind nor, where it looks for uninitialised memory, every instruction.
check() {
    name=$1 size=$2 algorithm=$3
    shift 3
    export WEFT_CACHE_DIR="$folder/$name-cache"
    oclgrind "$@" --build-options -O0 "$WEFT_PROGRAM" render "$scene" -o "$folder/$name.png" \
        --preset "$preset" --size "$size" --algorithm "$algorithm" --backend opencl \
        --progress none \
        >"$folder/$name.log" 2>&1 || { cat "$folder/$name.log"; exit 1; }
    if [ -s "$folder/$name.log" ]; then
        cat "$folder/$name.log"
        exit 1
    fi
    "$WEFT_PROGRAM" render "$scene" -o "$folder/native.png" --preset "$preset" --size "$size" \
        --backend native --algorithm "$algorithm" --progress none
    # Only the text that names nothing of the backend is in the files: equal pixels, equal bytes.
    cmp "$folder/$name.png" "$folder/native.png"
}

# `ais` runs every kernel that `igi` does. 17 x 9 pixels are six tiles, of which four are cut off by
# the image's edges.
check races 17x9 ais --data-races --check-api
check uninitialised 6x6 ais --uninitialized
echo "clean"
