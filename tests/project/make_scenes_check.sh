#!/bin/sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The scenes that ship are what their generator writes, and the generator's --check notices when
# they are not. Exit code 0: passed, 1: failed, 77: skipped, there is no Python 3.
set -eu

scenes=$(CDPATH='' cd -- "$(dirname -- "$0")/../../scenes" && pwd)
if ! command -v python3 >/dev/null 2>&1; then
    echo "skipped: python3 is not installed"
    exit 77
fi

python3 "$scenes/make_scenes.py" --check

# A check that cannot fail would be worthless: spoil a copy and see it refused.
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp "$scenes"/*.gltf "$scenes"/*.bin "$scenes"/*.png "$scenes"/*.vol "$scenes"/*.hdr "$copy"
printf 'X' | dd of="$copy/gallery.bin" bs=1 seek=1000 conv=notrunc 2>/dev/null
rm "$copy/gallery-tiles.png"
code=0
python3 "$scenes/make_scenes.py" --check --only gallery --out "$copy" 2>"$copy/log" || code=$?
if [ "$code" -ne 1 ] || [ "$(wc -l <"$copy/log")" -ne 2 ] \
    || ! grep -q 'gallery\.bin: differs from byte 1000 ' "$copy/log" \
    || ! grep -q 'gallery-tiles\.png: is missing' "$copy/log"; then
    echo "--check did not name the two spoilt files (exit code $code):" >&2
    cat "$copy/log" >&2
    exit 1
fi
echo "scenes match their generator; a spoilt copy is refused"
