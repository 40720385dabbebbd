#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# `weft selftest` passes, finds a sign that is wrong in one line of a kernel header, and its ledger
# is the one in docs/hard-cases.md. Exit code 0: passed, 1: failed, 77: skipped in part: there is no
# OpenCL device, whose kernels alone can be broken without a build.
set -eu

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
program=${WEFT_PROGRAM:-$(pwd)/../weft} # ctest runs this in the tests folder of the build
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
if [ ! -x "$program" ]; then
    echo "no program $program; set WEFT_PROGRAM" >&2
    exit 1
fi

fail() {
    echo "$1" >&2
    [ -z "${2:-}" ] || cat "$2" >&2
    exit 1
}

unset WEFT_KERNELS # of whoever runs this: the program's own are meant

# The part of the page between its two comments, which lie alone on their lines.
page=$root/docs/hard-cases.md
sed -n '/^<!-- ledger: begins -->$/,/^<!-- ledger: ends -->$/p' "$page" | sed '1d;$d' >"$work/page"
"$program" selftest --ledger >"$work/ledger" || fail "weft selftest --ledger failed"
diff -u "$work/page" "$work/ledger" >"$work/difference" ||
    fail "docs/hard-cases.md does not hold what weft selftest --ledger prints" "$work/difference"

# Sanitizers are slow, and two backends of the same code show them no more than one.
only=
[ -z "${WEFT_SANITIZED:-}" ] || only='--backend native'
code=0
# shellcheck disable=SC2086 # none or two words
"$program" selftest $only --json "$work/results.json" >"$work/results" || code=$?
[ "$code" -eq 0 ] || fail "weft selftest ended with $code" "$work/results"
tail -n 1 "$work/results" | grep -qE '^[0-9]+ passed, 0 failed$' ||
    fail "the last line is not '<number> passed, 0 failed'" "$work/results"
passed=$(tail -n 1 "$work/results" | sed 's/ .*//')
[ "$passed" -ge 41 ] || fail "$passed checks are fewer than the 41 hard cases" "$work/results"
grep -q '"failed": 0' "$work/results.json" || fail "the JSON file does not say 0 failed"

if ! "$program" devices | grep -q ' opencl '; then
    echo "$passed checks passed; no OpenCL device, so no kernel was broken"
    exit 77
fi

# A check that cannot fail would be worthless: the z of every dot product gets the wrong sign.
cp -R "$root/kernels" "$work/kernels"
sed 's/a\.y \* b\.y + a\.z \* b\.z/a.y * b.y - a.z * b.z/' "$root/kernels/light/connection.h" \
    >"$work/kernels/light/connection.h"
! cmp -s "$root/kernels/light/connection.h" "$work/kernels/light/connection.h" ||
    fail "kernels/light/connection.h holds no line to break, expected a dot product"
code=0
WEFT_KERNELS="$work/kernels" WEFT_CACHE_DIR="$work/cache" \
    "$program" selftest --backend opencl --cases 3,6,10 >"$work/broken" 2>&1 || code=$?
[ "$code" -eq 3 ] || fail "with a broken kernel it ended with $code, not 3" "$work/broken"
grep -q 'FAILED$' "$work/broken" || fail "with a broken kernel no check failed" "$work/broken"
tail -n 1 "$work/broken" | grep -qE '^[0-9]+ passed, [1-9][0-9]* failed$' ||
    fail "the last line does not count what failed" "$work/broken"

# The same folder unbroken is the program's own kernels.
WEFT_KERNELS="$root/kernels" "$program" selftest --backend opencl --cases 10 >"$work/own" ||
    fail "the program's own kernels fail from their folder" "$work/own"
echo "$passed checks passed, the ledger is up to date, a broken kernel is found"
