#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Joins the parts that part.sh has made.
#
#   merge.sh N SPP FOLDER OUTPUT     writes the image; exit code 2 where parts are missing
#   merge.sh N SPP FOLDER --missing  prints which are missing, as job arrays take them: 2,5-7
#
# WEFT names the program, by default the script beside this folder.
set -u

(($# == 4)) || {
    echo "merge.sh: expected N SPP FOLDER OUTPUT" >&2
    exit 1
}
weft=${WEFT:-$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/../weft}
parts=()
for ((i = 1; i <= $1; ++i)); do parts+=("$3/part-$i.exr"); done
if [[ $4 == --missing ]]; then
    exec "$weft" merge "${parts[@]}" --expect "0:$2" --missing "$1"
fi
exec "$weft" merge "${parts[@]}" --expect "0:$2" -o "$4"
