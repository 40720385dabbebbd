#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# `bench identity` says that a build makes the same images as itself, and that one which makes
# others does not. Run in the tests folder of a build tree. Exit code 0: passed, 1: failed,
# 77: skipped, there is no build tree or no Python 3.
set -eu

# shellcheck source=tests/testing/build_tree.sh
. "$(dirname -- "$0")/../testing/build_tree.sh"

# identity EXPECTED_CODE PROGRAM_BEFORE ARGUMENT...
identity() {
    expected=$1 before=$2 code=0
    shift 2
    python3 -B "$root/bench/identity/identity.py" --before "$before" --weft "$build/weft" \
        --only cornell-box --backends native --size 32 --cache "$work/cache" \
        "$@" >"$work/log" 2>&1 || code=$?
    [ "$code" -eq "$expected" ] ||
        fail "bench identity $* ended with $code, expected $expected" "$work/log"
}

# says TEXT: a line of the table or below it.
says() {
    grep -qF -- "$1" "$work/log" || fail "expected to read '$1'" "$work/log"
}

python3 -B "$root/tests/bench/identity_test.py" >"$work/log" 2>&1 ||
    fail "telling images or times apart fails" "$work/log"

identity 0 "$build/weft" --algorithms igi path -o "$work/same"
says '2 of 2 images are the same, 0 differ'

# A build that makes other images: another seed takes the place of another kernel.
cat >"$work/other" <<END
#!/bin/sh
[ "\$1" = render ] || exec "$build/weft" "\$@"
exec "$build/weft" "\$@" --seed 7
END
chmod +x "$work/other"
identity 1 "$work/other" --algorithms igi -o "$work/differ"
says 'cornell-box igi native: picture.exr: '
says '0 of 1 images are the same, 1 differ'
[ -f "$work/differ/cornell-box-igi-native/picture.exr" ] || fail "the other image is not kept"
identity 1 "$work/other" --algorithms igi path -o "$work/differ" --resume
says '0 of 2 images are the same, 2 differ'

# One that fails is another, too; the same images of the first build lie in the cache.
# shellcheck disable=SC2016 # the program's own arguments
printf '#!/bin/sh\n[ "$1" != render ] && exec "%s" "$@"\necho broken >&2\nexit 3\n' \
    "$build/weft" >"$work/broken"
chmod +x "$work/broken"
identity 1 "$work/broken" --algorithms igi -o "$work/broken-report"
says 'cornell-box igi native: before: broken (exit code 3); after: renders it'

identity 1 "$work/missing" -o "$work/none"
says 'expected a program'
echo "the same build makes the same images, and another seed, or a failure, does not"
