# shellcheck shell=sh
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What the checks of programs that make pages of benchmarks' figures share. Sourced by them; gives
# `root`, the source folder, and `work`, a folder that goes when they end.
root=$(CDPATH='' cd -- "$(dirname -- "$0")/../.." && pwd)
if ! command -v python3 >/dev/null 2>&1; then
    echo "skipped: python3 is not installed"
    exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    echo "$1" >&2
    exit 1
}
