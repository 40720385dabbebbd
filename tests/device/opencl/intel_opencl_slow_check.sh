#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Intel's OpenCL runtime passes the self-test and makes the images of the native build. Exit code 0:
# passed, 1: failed, 77: skipped: `./weft intel-opencl` has not installed it.
# shellcheck source=tests/testing/other_driver.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../testing/other_driver.sh"

[[ -z ${WEFT_SANITIZED:-} ]] || skip "sanitizers cannot see into OpenCL drivers"
runtime=$root/build/intel-opencl
[[ -e $runtime/lib/libintelocl.so ]] || skip "Intel's OpenCL runtime is not installed"
export OCL_ICD_VENDORS=$runtime/vendors LD_LIBRARY_PATH=$runtime/lib

"$program" devices --check >"$work/devices" || fail "the runtime is not usable" "$work/devices"
grep -q 'Intel(R) OpenCL' "$work/devices" || fail "there is no device of Intel's" "$work/devices"
selftest_passes 0
images_agree 0
