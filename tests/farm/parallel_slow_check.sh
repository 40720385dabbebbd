#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# GNU parallel runs a part again that was killed. Exit code 0: passed, 1: failed, 77: skipped: there
# is no GNU parallel.
# shellcheck source=tests/testing/farm.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../testing/farm.sh"

command -v parallel >/dev/null || skip "there is no GNU parallel"
kill_part
bash "$root/farm/parallel.sh" "${options[@]}" >"$work/log" 2>&1 || fail "parallel.sh fails" "$work/log"
check_image "$work/log"
