#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# The recipes' decisions that need neither an engine nor an image: which command a part gets, which
# frames are rendered after an interruption, and when Slurm's jobs give up. Stand-ins for the
# program and for sbatch write down how they are called. Exit code 0: passed, 1: failed.
set -u -o pipefail

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd)
# shellcheck source=tests/testing/check.sh
source "$root/tests/testing/check.sh"
work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT

# The program: frames A:B make a file each, of which a run may be interrupted at INTERRUPT_AT; a part
# ends with PART_CODE; parts count as missing where there is no file.
cat >"$work/weft" <<'END'
#!/usr/bin/env bash
printf '%s\n' "$*" >>"$CALLS"
command=$1
frames='' output='' missing=''
while (($# > 0)); do
    case $1 in
    --frames) frames=$2 ;;
    --missing) missing=$2 ;;
    -o) output=$2 ;;
    esac
    shift
done
if [[ $command == merge && -n $missing ]]; then
    for ((i = 1; i <= missing; ++i)); do
        [[ -e $FOLDER/part-$i.exr ]] && continue
        printf '%s' "${separator:-}$i"
        separator=,
    done
    echo
    exit 0
fi
if [[ -n ${WAITS:-} ]]; then
    trap 'exit 130' TERM
    touch "$WAITS"
    for ((i = 0; i < 200; ++i)); do sleep 0.1; done
fi
[[ -n $frames ]] || exit "${PART_CODE:-0}"
for ((i = ${frames%:*}; i < ${frames#*:}; ++i)); do
    [[ $i != "${INTERRUPT_AT:-}" ]] || exit 130
    printf 'run %s' "$RUN" >"${output%.*}.$(printf '%04d' "$i").${output##*.}"
done
END
printf '#!/usr/bin/env bash\nprintf "%%s\\n" "$*" >>"$CALLS"\necho 7\n' >"$work/sbatch"
chmod +x "$work/weft" "$work/sbatch"
export WEFT=$work/weft CALLS=$work/calls RUN=1 FOLDER=$work/parts PATH=$work:$PATH
last_call() { tail -n 1 "$CALLS"; }
expect() { [[ $1 == "$2" ]] || fail "expected '$2', got '$1'"; }

# A part is by path unless an algorithm is given.
mkdir -- "$FOLDER"
touch -d '2 hours ago' "$FOLDER/.part-1.sums.123.tmp.exr" "$FOLDER/.part-12.45.tmp.exr"
touch "$FOLDER/.part-1.45.tmp.exr"
bash "$root/farm/part.sh" 1 2 8 box.gltf "$FOLDER" --size 8x8 || fail "part.sh fails"
# What a killed run of this part has left is gone.
expect "$(ls -A "$FOLDER")" $'.part-1.45.tmp.exr\n.part-12.45.tmp.exr'
[[ $(last_call) == "render box.gltf --algorithm path --size 8x8 --spp 8 --part 1/2 "* ]] ||
    fail "a part is not by path" "$CALLS"
for given in '--algorithm reference' --algorithm=reference; do
    # shellcheck disable=SC2086 # two words
    bash "$root/farm/part.sh" 1 2 8 box.gltf "$FOLDER" $given || fail "part.sh fails"
    [[ $(last_call) == "render box.gltf $given --spp 8 "* ]] ||
        fail "a part ignores the algorithm" "$CALLS"
done

# SIGTERM reaches the program, whose exit code is the part's.
WAITS=$work/waits bash "$root/farm/part.sh" 1 2 8 box.gltf "$FOLDER" &
part=$!
for ((i = 0; i < 200; ++i)); do
    [[ -e $work/waits ]] && break
    sleep 0.1
done
kill -TERM "$part"
wait "$part"
expect $? 130

# Frames: with a lead-in, which is dropped; interrupted in frame 6, and on from there.
frames() { LEAD_IN=2 bash "$root/farm/frames.sh" 4 8 box.gltf "$work/frames"; }
INTERRUPT_AT=6 frames
expect $? 130
expect "$(last_call | grep -o -e '--frames [0-9:]*')" '--frames 2:8'
expect "$(ls "$work/frames")" $'frame.0004.png\nframe.0005.png'
RUN=2 frames || fail "frames.sh fails"
expect "$(last_call | grep -o -e '--frames [0-9:]*')" '--frames 4:8'
expect "$(ls -A "$work/frames")" \
    $'frame.0004.png\nframe.0005.png\nframe.0006.png\nframe.0007.png'
expect "$(cat "$work"/frames/*)" 'run 1run 1run 2run 2'
calls=$(wc -l <"$CALLS")
frames || fail "frames.sh fails where all is there"
expect "$(wc -l <"$CALLS")" "$calls"

# Slurm: a part that failed for want of memory is submitted again, one with wrong options is not.
export PARTS=2 SPP=8 SCENE=$root/scenes/cornell-box.gltf OUTPUT=$work/image.exr
export WEFT_FARM=$root/farm SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=2
touch "$FOLDER/part-1.exr"
part_of_slurm() { TRIES=0 PART_CODE=$1 bash "$root/farm/slurm/part.sbatch"; }
part_of_slurm 4
expect $? 4
SBATCH_ARGS='--time=9' MERGE_ARGS='--time=3' bash "$root/farm/slurm/merge.sbatch" --size 8x8 \
    >"$work/log" 2>&1 || fail "merge.sbatch fails" "$work/log"
grep -q -e "--array=2 .* --time=9 .*part.sbatch --size 8x8" "$CALLS" ||
    fail "the missing part was not submitted again" "$CALLS"
grep -q -e '--dependency=afterany:7 .* --time=3 .*merge.sbatch --size 8x8' "$CALLS" ||
    fail "merging was not submitted again" "$CALLS"
part_of_slurm 127
expect $? 127
expect "$(cat "$FOLDER/part-2.failed")" 127
part_of_slurm 1
expect $? 1
calls=$(grep -c array "$CALLS")
bash "$root/farm/slurm/merge.sbatch" >"$work/log" 2>&1
expect $? 2
grep -q '^part-2.failed: exit code 1' "$work/log" || fail "the failure is not named" "$work/log"
expect "$(grep -c array "$CALLS")" "$calls"
echo "recipes decide as they should"
