#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Renders a reference as a Slurm job array, and joins its parts.
#
#   PARTS=32 SPP=4096 SCENE=scene.gltf FOLDER=parts OUTPUT=reference.exr \
#       slurm/submit.sh [OPTION...]
#
# OPTIONs are those that part.sh takes; SBATCH_ARGS, such as "--time=2:00:00 --cpus-per-task=8",
# those of sbatch for a part, and MERGE_ARGS for the job that joins them. A part that is killed is
# queued again; parts that are missing after all have ended are submitted once more, twice at most.
# Prints the numbers of the two jobs.
set -u

: "${PARTS:?}" "${SPP:?}" "${SCENE:?}" "${FOLDER:?}" "${OUTPUT:?}"
WEFT_FARM=${WEFT_FARM:-$(dirname -- "$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")")}
SCENE=$(readlink -f -- "$SCENE") FOLDER=$(readlink -m -- "$FOLDER")
OUTPUT=$(readlink -m -- "$OUTPUT")
export PARTS SPP SCENE FOLDER OUTPUT WEFT_FARM
mkdir -p -- "$FOLDER" || exit 5

rm -f -- "$FOLDER"/part-*.failed

# shellcheck disable=SC2086 # SBATCH_ARGS holds several
parts=$(sbatch --parsable --array="${MISSING:-1-$PARTS}" --output="$FOLDER/part-%a.log" \
    ${SBATCH_ARGS:-} "$WEFT_FARM/slurm/part.sbatch" "$@") || exit $?
# shellcheck disable=SC2086 # MERGE_ARGS as well
merge=$(sbatch --parsable --dependency="afterany:$parts" --output="$FOLDER/merge.log" \
    ${MERGE_ARGS:-} "$WEFT_FARM/slurm/merge.sbatch" "$@") || exit $?
echo "$parts $merge"
