#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Calls of the OpenCL driver and on files that fail end as promised, and so do signals where `path` is
# resumed: a sample of fault_sweep.py, which without --stride and --only has every call.
# Exit code 0: passed, 1: failed, 77: skipped: there is no PoCL.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
program=${WEFT_PROGRAM:-$(pwd)/../weft} # ctest runs this in the tests folder of the build
libraries=$(dirname -- "$program")/tests
if [ -n "${WEFT_SANITIZED:-}" ] || [ ! -f /etc/OpenCL/vendors/pocl.icd ] ||
    [ ! -f "$libraries/libweft_faulty_driver.so" ]; then
    echo "there is no PoCL whose calls could fail: skipped"
    exit 77
fi
# sweep STRIDE ONLY
sweep() {
    python3 -B "$root/tests/faults/fault_sweep.py" --weft "$program" --stride "$1" --only "$2" \
        --driver "$libraries/libweft_faulty_driver.so" \
        --files "$libraries/libweft_faulty_files.so" --scene "$root/scenes/cornell-box.gltf"
}
sweep 13 resume
sweep 61 'files, disk full for good'
