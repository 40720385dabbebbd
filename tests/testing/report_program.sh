# shellcheck shell=sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What the checks of programs that make pages of benchmarks' figures share. Sourced by them; gives
# `root`, the source folder, `work`, a folder that goes when they end, and `python`.
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
if ! command -v python3 >/dev/null 2>&1; then
    echo "skipped: python3 is not installed"
    exit 77
fi
python=python3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "$1" >&2
    exit 1
}

# refuse CODE WORDS ARGUMENT...: `program` exits with CODE and one line that holds WORDS.
refuse() {
    expected=$1 words=$2
    shift 2
    code=0
    # shellcheck disable=SC2154 # whoever sources this says which program
    "$python" -B "$program" "$@" >"$work/log" 2>&1 || code=$?
    if [ "$code" -ne "$expected" ] || [ "$(wc -l <"$work/log")" -ne 1 ] \
        || ! grep -qF -e "$words" "$work/log"; then
        fail "exit code $code, expected $expected and one line with '$words': $(cat "$work/log")"
    fi
}

# Of checks of plots: sets `python` to one that has Matplotlib. Debian's package is for Debian's
# Python, which need not be the first one.
need_matplotlib() {
    for python in python3 /usr/bin/python3; do
        if "$python" -c 'import matplotlib' >/dev/null 2>&1; then
            return 0
        fi
    done
    echo "skipped: Matplotlib is not installed (Debian: python3-matplotlib)"
    exit 77
}

# refuse_without_matplotlib PROGRAM ARGUMENT...: without it, says so in one line and writes nothing.
refuse_without_matplotlib() {
    mkdir "$work/without"
    echo 'raise ImportError("it is missing")' >"$work/without/matplotlib.py"
    before=$(ls -lR "$work")
    code=0
    error=$(PYTHONPATH=$work/without python3 -B "$@" 2>&1) || code=$?
    case $code,$(printf '%s\n' "$error" | wc -l),$error in
    69,1,*"it is missing"*python3-matplotlib*) ;;
    *) fail "without Matplotlib: exit code $code, expected 69 and one line: $error" ;;
    esac
    [ "$(ls -lR "$work")" = "$before" ] || fail "without Matplotlib something was written"
    rm -r "$work/without"
}
