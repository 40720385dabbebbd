#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Renders one part of a reference, and may be run again at any time: it goes on from its last
# checkpoint, and does nothing where the part is there.
#
#   part.sh I N SPP SCENE FOLDER [OPTION...]   part I of N to FOLDER/part-I.exr
#
# OPTIONs are those of `weft render`, without those that this script gives below; the algorithm is
# `path` unless one is given. WEFT names the program, by default the script beside this folder. The
# exit code is the program's; SIGTERM saves a checkpoint, and then it is 130.
set -u

(($# >= 5)) || {
    echo "part.sh: expected I N SPP SCENE FOLDER [OPTION...]" >&2
    exit 1
}
part=$1 parts=$2 spp=$3 scene=$4 folder=$5
shift 5
farm=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
# shellcheck source=farm/run_to_end.sh
source "$farm/run_to_end.sh"
weft=${WEFT:-$farm/../weft}
sums=$folder/part-$part.sums.exr
algorithm=(--algorithm path)
for option in "$@"; do
    [[ $option == --algorithm || $option == --algorithm=* ]] && algorithm=()
done

mkdir -p -- "$folder" || exit 5
# What one has left that was killed while it wrote; a younger one may still be at work elsewhere.
find "$folder" -maxdepth 1 -name ".part-$part.*.tmp.exr" -mmin +60 -delete
run_to_end "$weft" render "$scene" "${algorithm[@]}" "$@" --spp "$spp" --part "$part/$parts" \
    --keep-complete --resume "$sums" --progress none -o "$folder/part-$part.exr"
code=$?
((code == 0)) && rm -f -- "$sums"
exit "$code"
