#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Benchmarks that compare with Mitsuba take its best variant, and say so where there is no Mitsuba;
# a scene that they write is a file. Exit code 0: passed, 1: failed, 77: skipped, there is no Python 3.
set -eu

# shellcheck source=tests/testing/report_program.sh
. "$(dirname -- "$0")/../testing/report_program.sh"

"$python" -B "$root/tests/bench/mitsuba_variant_test.py" >"$work/log" 2>&1 ||
    fail "choosing a variant fails: $(cat "$work/log")"

# -S and -I: a Python without packages of its own.
"$python" -I -S -B "$root/bench/common/mitsuba_variant.py" --prove llvm_ad_rgb >"$work/answer"
grep -q '"problem": ".* has no module mitsuba"' "$work/answer" ||
    fail "a Python without Mitsuba is not told apart: $(cat "$work/answer")"

file=$("$python" -B "$root/bench/cross_validation/media_scenes.py" slab "$work")
for part in "$file" "$work/slab.xml" "$work/slab.vol"; do
    [ -s "$part" ] || fail "the scene with a grid is not where '$file' says: no $part"
done
code=0
"$python" -B "$root/bench/cross_validation/media_scenes.py" cube "$work" 2>"$work/log" || code=$?
[ "$code" -eq 1 ] || fail "an unknown scene ended with $code, expected 1"
echo "the newest library that works is taken, and a Python without Mitsuba is told apart"
