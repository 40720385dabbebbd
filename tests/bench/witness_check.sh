#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The scenes of `bench witness` are files that Weft reads without a warning, at least thirty of them,
# and the benchmark says what it lacks. Run in the tests folder of a build tree. Exit code 0: passed,
# 1: failed, 77: skipped, there is no build tree or no Python 3.
set -eu

# shellcheck source=tests/testing/report_program.sh
. "$(dirname -- "$0")/../testing/report_program.sh"
program=$root/bench/witness/witness.py
weft=$(CDPATH='' cd -- .. && pwd)/weft
if [ ! -x "$weft" ]; then
    echo "skipped: no build tree"
    exit 77
fi

count=$("$python" -B "$program" --list | wc -l)
[ "$count" -ge 30 ] || fail "there are $count scenes, expected at least 30"
[ "$("$python" -B "$program" --list --only 'mask*')" = "mask
mask-textured" ] || fail "--only does not choose by patterns"
refuse 1 "no scene is called no-such-scene" --only no-such-scene
refuse 1 "at least a pixel and 32 samples" --spp 8

# -S and -I: a Python without packages of its own.
code=0
"$python" -I -S -B -c '
import runpy, sys
program = sys.argv[1]
sys.path.insert(0, program.rpartition("/")[0])
sys.argv = sys.argv[1:]
runpy.run_path(program, run_name="__main__")
' "$program" --only mask 2>"$work/log" || code=$?
[ "$code" -eq 69 ] || fail "without Mitsuba it ended with $code, expected 69: $(cat "$work/log")"

# One of each plug-in, and all files that scenes have beside them.
for name in conductor-gold roughconductor-ggx-anisotropic roughconductor-textured dielectric \
    roughdielectric-beckmann-0.1 thindielectric lamp-in-glass-in-glass plastic-nonlinear \
    roughplastic-ggx-0.2 mask-textured normalmap-metal onesided smooth-glass mirrors-lamp; do
    file=$("$python" -B "$root/bench/witness/witness_scenes.py" "$name" "$work")
    "$weft" info "$file" >/dev/null 2>"$work/log" || fail "$name is not read: $(cat "$work/log")"
    [ ! -s "$work/log" ] || fail "$name is read with a warning: $(cat "$work/log")"
done
for file in sphere.ply smooth_sphere.ply bumps.png waves.png colours.png sky.hdr; do
    [ -s "$work/$file" ] || fail "no scene has written $file"
done
echo "$count scenes, read without a warning"
