#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Renders a reference in parts with GNU parallel, which runs again what fails, and joins them.
#
#   PARTS=32 SPP=4096 SCENE=scene.gltf FOLDER=parts OUTPUT=reference.exr parallel.sh [OPTION...]
#
# OPTIONs are those that part.sh takes. PARALLEL_ARGS are those of parallel, such as
# "--sshloginfile hosts", for machines that share the folders; by default one part runs at a time.
set -u

: "${PARTS:?}" "${SPP:?}" "${SCENE:?}" "${FOLDER:?}" "${OUTPUT:?}"
farm=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
SCENE=$(readlink -f -- "$SCENE") FOLDER=$(readlink -m -- "$FOLDER")
# Other machines have an environment of their own.
if [[ -n ${WEFT:-} ]]; then
    program=$(command -v -- "$WEFT") || {
        echo "parallel.sh: there is no program $WEFT" >&2
        exit 1
    }
    WEFT=$(readlink -f -- "$program")
fi
# shellcheck disable=SC2086 # PARALLEL_ARGS holds several
parallel --will-cite --jobs 1 --retries 3 ${PARALLEL_ARGS:-} \
    ${WEFT:+env WEFT="${WEFT@Q}"} bash "${farm@Q}/part.sh" {} "$PARTS" "$SPP" "${SCENE@Q}" "${FOLDER@Q}" "${@@Q}" \
    ::: $(seq "$PARTS") ||
    exit $?
exec bash "$farm/merge.sh" "$PARTS" "$SPP" "$FOLDER" "$OUTPUT"
