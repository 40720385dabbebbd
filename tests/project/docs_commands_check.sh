#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# README.md and docs/ against the program: every command of a ```sh block runs, as written, in a
# folder where ./weft is the built program; every option that is shown exists, every option that
# exists is in docs/options.md; every link within the documentation leads somewhere, and source files
# that it names exist. A block below a comment <!-- not run: REASON --> is left out, and one that
# needs an OpenCL device where there is none. Exit code 0: passed, 1: failed.
set -u

root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
tools=$root/tests/testing/docs_commands.awk
program=${WEFT_PROGRAM:-$(pwd)/../weft} # ctest runs this in the tests folder of the build
if [ ! -x "$program" ]; then
    echo "no program $program; set WEFT_PROGRAM" >&2
    exit 1
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
: "${POCL_CACHE_DIR:=$work}" "${WEFT_CACHE_DIR:=$work}"
export POCL_CACHE_DIR WEFT_CACHE_DIR

# has_opencl: whether a block that names an OpenCL device can run.
has_opencl() { "$program" devices | grep -q ' opencl '; }

# run_blocks ROOT: runs the blocks of all pages; prints those that fail.
run_blocks() {
    blocks=$work/blocks
    rm -rf "$blocks" "$work/run"
    mkdir "$blocks" "$work/run"
    ln -s "$program" "$work/run/weft"
    cp -R "$1/scenes" "$work/run/scenes"
    [ ! -d "$1/farm" ] || ln -s "$1/farm" "$work/run/farm"
    (cd "$1" && awk -v mode=blocks -v out="$blocks" -f "$tools" README.md docs/*.md)
    for block in "$blocks"/*; do
        [ -e "$block" ] || continue
        place=$(sed -n '1s/^# //p' "$block")
        if grep -qE -e '--device|--backend[ =]opencl' "$block" && ! has_opencl; then
            echo "skipped, no OpenCL device: $place" >&2
        elif ! (cd "$work/run" && sh -e "$block") >"$work/log" 2>&1 </dev/null; then
            echo "$place: a command fails: $(tail -n 1 "$work/log")"
        fi
        ran=$((ran + 1))
    done
}

# help_options: the options of all commands, one a line, as --help lists them.
help_options() {
    for command in '' $commands; do
        # shellcheck disable=SC2086 # the empty word is no argument
        "$program" $command --help
    done | sed -nE 's/^  +(-[^ ]+).*/\1/p' | tr ',' '\n' | sort -u
}

# check_options ROOT: documented options exist, existing options and commands are documented.
check_options() {
    (cd "$1" && awk -v mode=options -f "$tools" README.md docs/*.md) >"$work/documented"
    while IFS=' ' read -r option place; do
        grep -qxF -e "$option" "$work/help" || echo "$place: $option is not in --help"
    done <"$work/documented"
    while read -r option; do
        grep -qE -e "(^|[^-[:alnum:]])$option($|[^-[:alnum:]])" "$1/docs/options.md" ||
            echo "docs/options.md: $option of --help is not documented"
    done <"$work/help"
    for command in $commands; do
        grep -qF "weft $command" "$1/docs/options.md" ||
            echo "docs/options.md: the command $command is not documented"
    done
}

# check_links ROOT: files and headings that pages link to exist.
check_links() {
    (cd "$1" && awk -v mode=links -f "$tools" README.md docs/*.md scenes/README.md) >"$work/links"
    while IFS=' ' read -r target anchor place; do
        if [ ! -e "$1/$target" ]; then
            echo "$place: links to $target, which does not exist"
        elif [ "$anchor" != - ] &&
            ! awk -v mode=headings -f "$tools" "$1/$target" | grep -qxF -e "$anchor"; then
            echo "$place: links to $target#$anchor, which has no such heading"
        fi
    done <"$work/links"
}

check_all() {
    run_blocks "$1"
    check_options "$1"
    check_links "$1"
}

commands=$("$program" --help | sed -n '/^Commands:/,$s/^  *\([a-z]*\) .*/\1/p')
help_options >"$work/help"
if [ -z "$commands" ] || [ "$(wc -l <"$work/help")" -lt 5 ]; then
    echo "--help of $program lists no commands or options" >&2
    exit 1
fi
ran=0
check_all "$root" >"$work/problems"
if [ -s "$work/problems" ] || [ "$ran" -lt 5 ]; then
    cat "$work/problems" >&2
    echo "$ran blocks ran" >&2
    exit 1
fi
blocks_run=$ran

# A check that cannot fail would be worthless: each kind of fault in a small copy is found.
bad=$work/bad
mkdir -p "$bad/docs" "$bad/scenes"
grep -v -e '--tile' "$root/docs/options.md" >"$bad/docs/options.md"
cat >"$bad/README.md" <<'END'
# Title
[gone](docs/gone.md) ![gone](docs/gone.png) [no heading](#subtitle) [good](#title)
Use `--nonsense`, see `host/gone.cpp`.
```sh
true
./weft info missing.gltf
```
<!-- not run: would fail -->
```sh
false
```
END
echo '[out](https://example.org/gone.md)' >"$bad/scenes/README.md"
check_all "$bad" >"$work/found"
for expected in \
    'README\.md:4: a command fails: weft: .*missing\.gltf' \
    'README\.md:3: --nonsense is not in --help' \
    'docs/options\.md: --tile of --help is not documented' \
    'README\.md:2: links to docs/gone\.md, ' \
    'README\.md:2: links to docs/gone\.png, ' \
    'README\.md:2: links to README\.md#subtitle, ' \
    'README\.md:3: links to host/gone\.cpp, '; do
    if ! grep -q "^$expected" "$work/found"; then
        echo "a fault was not found, expected: $expected" >&2
        cat "$work/found" >&2
        exit 1
    fi
done
if grep -qE 'README\.md:9:|example|#title' "$work/found"; then
    echo "something right was taken for a fault:" >&2
    cat "$work/found" >&2
    exit 1
fi
echo "$blocks_run blocks of commands ran; options and links are right; planted faults are found"
