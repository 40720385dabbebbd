#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What pages of docs/ show of sources is what the sources say (docs_excerpts.py), the drawing of the
# folders included. Exit code 0: passed, 1: failed, 77: there is no Python.
set -eu

root=$WEFT_SOURCE_DIR
command -v python3 >/dev/null || {
    echo "skipped: no python3"
    exit 77
}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
run() { python3 -B "$root/tests/project/docs_excerpts.py" "$@"; }

fail() {
    echo "$*" >&2
    exit 1
}

run --check --build "$WEFT_BUILD_DIR"

# A source that changed is noticed, and the page written anew; what cannot be found ends the run.
mkdir "$work/docs"
printf 'int f(\n    int a) {\n    // why\n    return a;\n}\nint g();\n' >"$work/f.cpp"
page() { printf '<!-- excerpt of f.cpp: %s -->\n```cpp\nold\n```\nafter\n' "$1" >"$work/docs/page.md"; }
page 'int f('
! run --check --root "$work" 2>"$work/log" || fail "an old excerpt was not noticed"
grep -q '^docs/page.md: an excerpt is not what the source says' "$work/log" || fail "$(cat "$work/log")"
run --root "$work" >/dev/null
printf '```cpp\nint f(\n    int a) {\n    return a;\n}\n```\nafter\n' >"$work/expected"
tail -n +2 "$work/docs/page.md" | diff "$work/expected" - || fail "the excerpt is another"
run --check --root "$work" >/dev/null || fail "an excerpt just written was refused"
page 'int f( ... int g'
run --root "$work" >/dev/null
tail -n 3 "$work/docs/page.md" | head -n 1 | grep -qx 'int g();' || fail "the end was not found"
page 'int g'
run --root "$work" >/dev/null
printf '```cpp\nint g();\n```\n' >>"$work/docs/page.md"
! run --check --root "$work" 2>"$work/log" || fail "code without a mark was taken"
grep -q '^docs/page.md:6: shows code that is no excerpt' "$work/log" || fail "$(cat "$work/log")"
for start in 'int h' 'int' 'int g ... none'; do
    page "$start"
    ! run --root "$work" >/dev/null 2>"$work/log" || fail "'$start' was taken"
    grep -q '^docs/page.md:1: f.cpp: ' "$work/log" || fail "$(cat "$work/log")"
    grep -qx old "$work/docs/page.md" || fail "a page was written in spite of an error"
done
