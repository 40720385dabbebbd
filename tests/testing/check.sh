# shellcheck shell=bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# How a check that is a bash script ends: sourced by what such scripts share.

fail() {
    echo "$1" >&2
    [[ -z ${2:-} ]] || cat "$2" >&2
    exit 1
}

skip() {
    echo "$1: skipped"
    exit 77
}
