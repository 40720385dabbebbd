# shellcheck shell=bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What tests of an OpenCL driver share: sourced by bash scripts, which set variables of the
# environment so that the program uses that driver. `work` is a folder that goes at the end.
set -u -o pipefail

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=tests/testing/check.sh
source "$root/tests/testing/check.sh"
program=${WEFT_PROGRAM:-$(pwd)/../weft} # ctest runs this in the tests folder of the build
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# selftest_passes DEVICE: every check on that OpenCL device.
selftest_passes() {
    "$program" selftest --backend opencl --device "$1" >"$work/selftest" ||
        fail "weft selftest fails on $1" "$work/selftest"
    tail -n 1 "$work/selftest" | grep -qE '^[0-9]+ passed, 0 failed$' ||
        fail "the last line is not '<number> passed, 0 failed'" "$work/selftest"
    echo "$1: selftest: $(tail -n 1 "$work/selftest")"
}

# image_agrees DEVICE SCENE OPTION...: the image is equal to that of the native build, to the last bit.
image_agrees() {
    local device=$1 scene=$2 image place
    shift 2
    for image in native opencl; do
        place=(--backend "$image")
        [[ $image == opencl ]] && place+=(--device "$device")
        "$program" render "$scene" "$@" "${place[@]}" --progress none -o "$work/$image.exr" \
            >"$work/log" 2>&1 || fail "$scene does not render on $device" "$work/log"
    done
    "$program" compare "$work/native.exr" "$work/opencl.exr" --metric mape --json \
        >"$work/difference" || fail "the images of $scene cannot be compared"
    grep -qE '"mape": 0(\.0)?[,} ]*$' "$work/difference" ||
        fail "$device and the native build disagree about $scene" "$work/difference"
    echo "$device: $(basename -- "$scene"), $*: equal to the last bit"
}

# images_agree DEVICE: previews by ais agree in Cornell, OfficePM and, where the folder of shared
# scenes is there, Sibenik.
images_agree() {
    local scene
    local scenes=("$root/scenes/cornell-box.gltf" "$root/scenes/office-pm.gltf")
    local sibenik=$root/../shared/data/scenes/sibenik/sibenik.xml
    [[ -f $sibenik ]] && scenes+=("$sibenik")
    for scene in "${scenes[@]}"; do
        image_agrees "$1" "$scene" --size 96x72 --spp 2 --algorithm ais
    done
}
