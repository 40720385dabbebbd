# shellcheck shell=sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What checks share that run Python on a built tree. Sourced by them, in the tests folder of that
# tree; gives `root`, the source folder, `build`, the tree, and `work`, a folder that goes when they
# end. Exits with 77 where there is no tree or no Python 3.
# shellcheck disable=SC2034 # whoever sources this uses it
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
build=$(CDPATH='' cd -- .. && pwd)
if [ ! -x "$build/weft" ] || ! command -v python3 >/dev/null 2>&1; then
    echo "skipped: $build holds no program, or python3 is not installed"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# fail MESSAGE [FILE]: ends the check, with a file that tells more.
fail() {
    echo "$1" >&2
    [ -z "${2:-}" ] || cat "$2" >&2
    exit 1
}
