#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# README.md can be read screen by screen (readme_screens.py). Exit code 0: passed, 1: failed, 77:
# there is no Python.
set -eu

root=$WEFT_SOURCE_DIR
command -v python3 >/dev/null || {
    echo "skipped: no python3"
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
run() { python3 -B "$root/tests/project/readme_screens.py" "$@"; }

run "$root/README.md"

# A check that cannot fail would be worthless: long sections and what lacks are found.
{
    echo '# Title'
    echo
    echo './weft is a program.'
    echo
    echo '## Long'
    seq 1 100
} >"$work/README.md"
run "$work/README.md" >"$work/log" && exit 1
for expected in '## Long: about 10[0-9] lines' 'lacks an image' 'lacks two commands' 'lacks what'; do
    grep -q "$expected" "$work/log" || {
        echo "a fault was not found, expected: $expected"
        cat "$work/log"
        exit 1
    }
done
