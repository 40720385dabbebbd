#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Mesa's rusticl on the processor either makes the images of the native build, or is known not to
# work: then it costs one line, and all else renders as without it. It compiles a kernel anew at every
# launch, so that the self-test would take an hour. Exit code 0: passed, 1: failed, 77: skipped: there
# is no rusticl.
# shellcheck source=tests/testing/other_driver.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../testing/other_driver.sh"

[[ -z ${WEFT_SANITIZED:-} ]] || skip "sanitizers cannot see into OpenCL drivers"
[[ -f /etc/OpenCL/vendors/rusticl.icd ]] || skip "there is no rusticl (Debian: mesa-opencl-icd)"
# Its compiler is slow.
export RUSTICL_ENABLE=llvmpipe WEFT_DRIVER_SECONDS=120
"$program" devices --check >"$work/devices"
grep -q llvmpipe "$work/devices" || fail "rusticl has no device" "$work/devices"
scene=$root/scenes/cornell-box.gltf
if ! grep -A 1 llvmpipe "$work/devices" | grep -q 'not usable'; then
    for algorithm in path igi; do
        image_agrees llvmpipe "$scene" --size 32x24 --spp 2 --algorithm "$algorithm"
    done
    exit 0
fi
code=0
timeout 30 "$program" render "$scene" --size 16x16 --device llvmpipe --progress none \
    -o "$work/a.png" 2>"$work/refusal" || code=$?
[[ $code == 3 && $(wc -l <"$work/refusal") == 1 ]] ||
    fail "a device that does not work ends with $code, expected one line and 3" "$work/refusal"
timeout 120 "$program" render "$scene" --size 16x16 --spp 1 --algorithm path --progress none \
    -o "$work/a.png" 2>"$work/refusal" || fail "the default device does not render" "$work/refusal"
[[ ! -s $work/refusal ]] || fail "the default device renders with a warning" "$work/refusal"
cat "$work/devices"
