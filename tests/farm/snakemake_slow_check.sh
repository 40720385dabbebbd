#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Snakemake runs a part again that was killed. Exit code 0: passed, 1: failed, 77: skipped: there is
# no Snakemake, neither in the path nor in build/farm.
# shellcheck source=tests/testing/farm.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../testing/farm.sh"

PATH=$PATH:$root/build/farm/bin
command -v snakemake >/dev/null || skip "there is no Snakemake"
kill_part
(cd -- "$work" && XDG_CACHE_HOME=$work/cache snakemake -s "$root/farm/Snakefile" --cores 2 \
    --config "scene=$SCENE" "spp=$SPP" "parts=$PARTS" "folder=$FOLDER" "output=$OUTPUT" \
    "options=${options[*]}") >"$work/log" 2>&1 || fail "Snakemake fails" "$work/log"
grep -q 'restart' "$work/log" || fail "Snakemake has not run a part again" "$work/log"
check_image "$work/log"
