# shellcheck shell=bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What tests of the recipes in farm/ share: sourced by bash scripts. Recipes render four parts of a
# reference; one of them is killed, which the engine has to notice; and the sums have to be those of
# one run.
set -u -o pipefail

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=tests/testing/check.sh
source "$root/tests/testing/check.sh"
program=${WEFT_PROGRAM:-$(pwd)/../weft} # ctest runs this in the tests folder of the build
program=$(readlink -f -- "$program")
work=$(mktemp -d)
# Scripts add to this what they have started.
end_of_work() { rm -rf -- "$work"; }
trap end_of_work EXIT

PARTS=4 SPP=64 SCENE="$work/a scene.gltf" FOLDER="$work/the parts" OUTPUT="$work/image.exr"
options=(--size 192x192)
export PARTS SPP SCENE FOLDER OUTPUT
cp -- "$root/scenes/cornell-box.gltf" "$SCENE"

# Runs on native code, so that no kernel has to be compiled first.
cat >"$work/weft" <<END
#!/usr/bin/env bash
command=\$1
shift
[[ \$command == render ]] && set -- "\$@" --backend native --threads 1
exec "$program" "\$command" "\$@"
END
chmod +x "$work/weft"
export WEFT=$work/weft

# Kills the program that renders part 2, once, while the script goes on.
kill_part() {
    kill_part_once &
    killer=$!
}
kill_part_once() {
    local process tries
    for ((tries = 0; tries < 1200; ++tries)); do
        process=$(pgrep -f -- "^$program render .*--part 2/$PARTS .*$work" | head -n 1)
        if [[ -n $process ]] && kill -KILL "$process"; then
            echo "part 2 was process $process, and has been killed" >"$work/killed"
            return
        fi
        sleep 0.05
    done
}

# The image holds, bit for bit, the sums of one run.
check_image() {
    wait "$killer"
    [[ -s $work/killed ]] || fail "part 2 has never been seen, and so not been killed"
    [[ -s $OUTPUT ]] || fail "there is no image" "${1:-}"
    "$WEFT" render "$SCENE" --algorithm path "${options[@]}" --samples "0:$SPP" --progress none \
        -o "$work/samples.exr" || fail "the one run fails"
    "$WEFT" merge "$work/samples.exr" -o "$work/whole.exr" || fail "merge fails"
    cmp "$work/whole.exr" "$OUTPUT" || fail "parts and one run do not have the same sums"
    cat "$work/killed"
    echo "$PARTS parts have the sums of one run"
}
