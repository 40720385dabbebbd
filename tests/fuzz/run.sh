#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Runs a fuzz target on its corpus, its regressions, and what libFuzzer makes of them:
#   tests/fuzz/run.sh NAME [SECONDS] [LIBFUZZER_OPTION...]
#
# The programs are those of the preset fuzz, in build/fuzz or where WEFT_FUZZ_DIR says. Exit codes:
# 0 nothing found, 77 the program has not been built, any other an input that should not exist; it
# is kept in the folder crashes beside the program, and its path printed.
set -u -o pipefail

here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
name=${1:?expected the name of a fuzz target}
seconds=${2:-60}
shift $(($# < 2 ? $# : 2))
root=$(dirname -- "$(dirname -- "$here")")
folder=${WEFT_FUZZ_DIR:-$root/build/fuzz}
program=$folder/${name}_fuzz

if [[ ! -x $program ]]; then
    echo "fuzz: there is no $program (cmake --preset fuzz; cmake --build --preset fuzz): skipped"
    exit 77
fi

# Inputs are written to files: where there is memory to hold them, no disk is needed.
temporary=/tmp
[[ -d /dev/shm && -w /dev/shm ]] && temporary=/dev/shm
TMPDIR=$(TMPDIR=$temporary mktemp -d) || exit 1
export TMPDIR
trap 'rm -rf -- "$TMPDIR"' EXIT
mkdir -p -- "$TMPDIR/found" "$folder/crashes"

options=(-seed=1 -max_total_time="$seconds" -max_len=65536 -timeout=5 -rss_limit_mb=1024
    -malloc_limit_mb=512 -print_final_stats=1 -verbosity=0
    -error_exitcode=1 # not its usual 77, which says skipped here
    -artifact_prefix="$folder/crashes/$name-")
[[ -f $here/$name.dict ]] && options+=(-dict="$here/$name.dict")
inputs=("$TMPDIR/found")
for kind in corpus regressions; do
    [[ -d $here/$kind/$name ]] && inputs+=("$here/$kind/$name")
done

# Memory that libraries keep to the end is not a leak of Weft's.
export LSAN_OPTIONS=suppressions="$root/cmake/lsan_suppressions.txt":print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1
"$program" "${options[@]}" "$@" "${inputs[@]}" 2>&1 | tee "$folder/$name.log"
status=${PIPESTATUS[0]}
if ((status != 0)); then
    path=$(sed -n 's/^.*Test unit written to //p' "$folder/$name.log" | tail -n 1)
    echo "fuzz: $name failed; the input is in ${path:-(not written)}"
    echo "fuzz: again with: $program ${path:-}"
    exit 1
fi
