# shellcheck shell=bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# What recipes share that start a program and may be ended themselves: sourced by bash scripts.

# run_to_end COMMAND...: runs it, passes SIGTERM and Ctrl-C on to it as SIGTERM, and returns its exit
# code once it has ended.
run_to_end() {
    "$@" &
    local process=$! code
    trap 'kill -TERM "$process"' TERM INT
    # A signal ends the first wait, not the command.
    wait "$process"
    code=$?
    while kill -0 "$process" 2>/dev/null; do
        wait "$process"
        code=$?
    done
    trap - TERM INT
    return "$code"
}
