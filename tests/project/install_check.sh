#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What `cmake --install` puts down runs from any folder and needs nothing of the build: run in the
# tests folder of a build tree. Exit code 0: passed, 1: failed, 77: skipped, there is no build tree.
set -eu

build=$(CDPATH='' cd -- .. && pwd)
if [ ! -f "$build/cmake_install.cmake" ] || [ ! -x "$build/weft" ]; then
    echo "skipped: $build holds no finished build"
    exit 77
fi

prefix=$(mktemp -d)
trap 'rm -rf "$prefix"' EXIT
DESTDIR='' cmake --install "$build" --prefix "$prefix/installed" >"$prefix/log" || {
    cat "$prefix/log" >&2
    exit 1
}
mv "$prefix/installed" "$prefix/moved elsewhere"
installed="$prefix/moved elsewhere"

fail() {
    echo "$1" >&2
    exit 1
}

mkdir "$prefix/work"
cd "$prefix/work"
program="$installed/bin/weft"
[ -x "$program" ] || fail "bin/weft was not installed"
"$program" devices >device-list || fail "weft devices failed"
grep -q embree device-list || fail "weft devices does not list the Embree backend"
scene=$(find "$installed" -name cornell-box.gltf)
[ -n "$scene" ] || fail "no scenes were installed"
"$program" render "$scene" -o box.png --size 32x32 --progress none 2>messages || {
    cat messages >&2
    fail "the installed program renders nothing"
}
[ -s box.png ] || fail "no image was written"
[ -n "$(find "$installed" -name LICENSE)" ] || fail "no licence was installed"
extra=$(find "$installed" -name '*.py' -o -name '__pycache__' -o -name '*.a' -o -name '*.cl')
[ -z "$extra" ] || fail "was installed without being needed: $extra"
echo "the installed program lists devices and renders from any folder"
