#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Dask runs a part again that was killed. Exit code 0: passed, 1: failed, 77: skipped: there is no
# Dask, neither for python3 nor in build/farm.
# shellcheck source=tests/testing/farm.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../testing/farm.sh"

python=python3
"$python" -c 'import dask.distributed' 2>/dev/null || python=$root/build/farm/bin/python
"$python" -c 'import dask.distributed' 2>/dev/null || skip "there is no Dask"
kill_part
"$python" "$root/farm/dask_reference.py" "$SCENE" --spp "$SPP" --parts "$PARTS" \
    --folder "$FOLDER" -o "$OUTPUT" -- "${options[@]}" >"$work/log" 2>&1 ||
    fail "dask_reference.py fails" "$work/log"
check_image "$work/log"
