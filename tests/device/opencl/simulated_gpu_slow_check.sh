#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# A device with the limits of a small GPU passes the self-test and makes the images of the native
# build: single rays in place of packets, memory that the host has to copy, buffers of at most
# 128 MiB, launches of at most 2 s. Exit code 0: passed, 1: failed, 77: skipped: there is no OpenCL
# device.
# shellcheck source=tests/testing/other_driver.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../testing/other_driver.sh"

export WEFT_SIMULATE_GPU=1
"$program" devices | grep -q ' opencl ' || skip "there is no OpenCL device"
selftest_passes 0
images_agree 0
