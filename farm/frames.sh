#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Renders some frames of an animation, so that they fit to those that other machines render.
#
#   frames.sh FIRST END SCENE FOLDER [OPTION...]   frames FIRST to END - 1, to FOLDER/frame.NNNN.EXT
#
# What ais samples densely, and what records tic keeps, depends on the frames before: LEAD_IN of
# them, by default 40, are rendered as well and dropped. With `path` and other algorithms whose
# frames do not depend on earlier ones, LEAD_IN=0 saves that. EXT, by default png, chooses the
# format; WEFT names the program. Frames that are there stay as they are: what was interrupted goes
# on with the first that is not. Only SIGKILL loses those that were made since.
set -u

(($# >= 4)) || {
    echo "frames.sh: expected FIRST END SCENE FOLDER [OPTION...]" >&2
    exit 1
}
first=$1 end=$2 scene=$3 folder=$4
shift 4
farm=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
# shellcheck source=farm/run_to_end.sh
source "$farm/run_to_end.sh"
weft=${WEFT:-$farm/../weft}
extension=${EXT:-png}
lead_in=${LEAD_IN:-40}

mkdir -p -- "$folder" || exit 5
name() { printf 'frame.%04d.%s' "$1" "$extension"; }
while ((first < end)) && [[ -e $folder/$(name "$first") ]]; do ((++first)); done
((first < end)) || exit 0
# Beside the images that are kept, so that moving them is a rename.
work=$(mktemp -d -- "$folder/frames-$first-XXXXXX") || exit 5
trap 'rm -rf -- "$work"' EXIT
from=$((first > lead_in ? first - lead_in : 0))
run_to_end "$weft" render "$scene" "$@" --frames "$from:$end" --progress none \
    -o "$work/frame.$extension"
code=$?
made=$first
while ((made < end)) && [[ -e $work/$(name "$made") ]]; do ((++made)); done
for ((i = first; i < made; ++i)); do
    [[ -e $folder/$(name "$i") ]] || mv -- "$work/$(name "$i")" "$folder/" || exit 5
done
exit "$code"
