#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What `bench other_renderers` hands to other renderers is what the glTF file holds, and without any
# renderer it says so. Needs no other renderer; run in the tests folder of a build tree. Exit code
# 0: passed, 1: failed, 77: skipped, there is no build tree or no Python 3.
set -eu

# shellcheck source=tests/testing/build_tree.sh
. "$(dirname -- "$0")/../testing/build_tree.sh"

cmake --build "$build" --target bench_export_scene >"$work/log" 2>&1 ||
    fail "bench/export_scene does not build" "$work/log"
export_scene=$build/bench/export_scene
program=$root/bench/other_renderers/other_renderers.py
"$export_scene" "$root/scenes/cornell-box.gltf" -o "$work/export" --size 64 48 2>"$work/log" ||
    fail "the Cornell box cannot be exported" "$work/log"
python3 "$root/tests/testing/exported_box.py" "$root/scenes/cornell-box.gltf" "$work/export" ||
    fail "the exported Cornell box is another one"

# A check that cannot fail would be worthless: an area light as bright as another is refused.
sed 's/"emissiveStrength": 20\.620098/"emissiveStrength": 20.7/' \
    "$root/scenes/cornell-box.gltf" >"$work/brighter.gltf"
! cmp -s "$root/scenes/cornell-box.gltf" "$work/brighter.gltf" || fail "no area light to change"
! python3 "$root/tests/testing/exported_box.py" "$work/brighter.gltf" "$work/export" 2>/dev/null ||
    fail "the export of another area light was taken for the right one"

"$export_scene" "$root/scenes/car-paint.gltf" -o "$work/surfaces" --size 8 8 2>"$work/log" ||
    fail "the car cannot be exported" "$work/log"
python3 "$root/tests/testing/exported_surfaces.py" "$root/scenes/car-paint.gltf" \
    "$work/surfaces" || fail "the exported surfaces are others"
sed 's/"clearcoatFactor": 1\.0/"clearcoatFactor": 0.9/' \
    "$root/scenes/car-paint.gltf" >"$work/other.gltf"
! python3 "$root/tests/testing/exported_surfaces.py" "$work/other.gltf" "$work/surfaces" \
    2>/dev/null || fail "the export of another coat was taken for the right one"

code=0
"$export_scene" "$work/missing.gltf" -o "$work/none" 2>"$work/log" || code=$?
[ "$code" -eq 2 ] || fail "a missing scene ended with $code, expected 2" "$work/log"

# Benchmarks keep their old names, and the variable for their Python its own.
old_name() {
    code=0
    env WEFT_WITNESS_PYTHON="$work/no-python" "$root/weft" bench "$1" 2>"$work/log" || code=$?
    if [ "$code" -ne 69 ] || ! grep -q "bench $2: no program '$work/no-python'" "$work/log"; then
        fail "bench $1 is not bench $2 any longer" "$work/log"
    fi
}
old_name peers other_renderers

# An interpreter without packages and a PATH without programs: no other renderer is there.
python=$(python3 -c 'import sys; print(sys.executable)')
mkdir "$work/bin"
code=0
PATH=$work/bin "$python" -I -S -B -c '
import runpy, sys
program = sys.argv[1]
sys.path.insert(0, program.rpartition("/")[0])
sys.argv = sys.argv[1:]
runpy.run_path(program, run_name="__main__")
' "$program" "$root/scenes/cornell-box.gltf" --only embree --quick \
    --weft "$build/weft" -o "$work/renderers" 2>"$work/log" || code=$?
[ "$code" -eq 69 ] || fail "without another renderer it ended with $code, expected 69" "$work/log"
grep -q '^bench other_renderers: .*expected at least one' "$work/log" ||
    fail "without another renderer it does not say what it needs" "$work/log"
code=0
"$python" -B "$program" scene.gltf --budgets -1 2>"$work/log" || code=$?
[ "$code" -eq 1 ] || fail "a negative budget ended with $code, expected 1" "$work/log"
code=0
"$python" -B "$program" scene.gltf --resume 2>"$work/log" || code=$?
[ "$code" -eq 1 ] || fail "--resume without --json ended with $code, expected 1" "$work/log"
"$python" -B "$root/tests/bench/equal_time_test.py" >"$work/log" 2>&1 ||
    fail "finding samples that fit a budget fails" "$work/log"
"$python" -B "$root/tests/bench/expressible_test.py" >"$work/log" 2>&1 ||
    fail "leaving out scenes that cannot be expressed fails" "$work/log"
"$python" -B "$root/tests/bench/surfaces_test.py" >"$work/log" 2>&1 ||
    fail "what other renderers are told of surfaces is wrong" "$work/log"
"$python" -B "$root/tests/bench/other_renderers_run_test.py" >"$work/log" 2>&1 ||
    fail "going on with a run, or judging its images, fails" "$work/log"
echo "the export holds what the file holds; without another renderer the benchmark says so"
