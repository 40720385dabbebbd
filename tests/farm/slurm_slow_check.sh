#!/usr/bin/env bash
# Copyright 2026 The Weft Authors
# SPDX-License-Identifier: Apache-2.0
#
# Slurm, on this machine alone, queues a part again that was killed. Exit code 0: passed, 1: failed,
# 77: skipped: there is no Slurm, or this user may not start it.
# shellcheck source=tests/testing/farm.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../testing/farm.sh"

for tool in slurmctld slurmd munged sbatch; do
    command -v "$tool" >/dev/null || skip "there is no $tool"
done
((EUID == 0)) || skip "only root can start Slurm"

host=$(hostname -s)
mkdir -- "$work/munge" "$work/state" "$work/spool"
head -c 1024 /dev/urandom >"$work/munge/key"
chown -R munge: "$work/munge" && chmod 700 "$work/munge" && chmod 400 "$work/munge/key"
chmod 755 "$work"
su -s /bin/bash munge -c "munged --force --key-file='$work/munge/key' \
    --socket='$work/munge/socket' --pid-file='$work/munge/pid' --log-file='$work/munge/log' \
    --seed-file='$work/munge/seed'" >"$work/log" 2>&1 || skip "munged does not start"
cat >"$work/slurm.conf" <<END
ClusterName=weft
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$((20000 + RANDOM % 20000))
SlurmdPort=$((40000 + RANDOM % 20000))
AuthType=auth/munge
AuthInfo=socket=$work/munge/socket
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmUser=root
SlurmdUser=root
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
SlurmctldLogFile=$work/slurmctld.log
SlurmdLogFile=$work/slurmd.log
KillWait=5
NodeName=$host NodeAddr=127.0.0.1 CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
END
export SLURM_CONF=$work/slurm.conf
end_of_work() {
    local pid
    scancel --user=root 2>/dev/null
    for pid in "$work"/slurmd.pid "$work"/slurmctld.pid "$work"/munge/pid; do
        [[ -s $pid ]] && kill "$(cat "$pid")"
    done
    sleep 2
    rm -rf -- "$work"
}
slurmctld || skip "Slurm does not start"
sleep 2
slurmd || skip "Slurm does not start"
for ((tries = 0; tries < 30; ++tries)); do
    [[ $(sinfo -h -o %T 2>/dev/null) == idle ]] && break
    sleep 1
done
[[ $(sinfo -h -o %T) == idle ]] || fail "Slurm has no node that is ready" "$work/slurmctld.log"

kill_part
bash "$root/farm/slurm/submit.sh" "${options[@]}" >"$work/log" 2>&1 ||
    fail "submit.sh fails" "$work/log"
for ((tries = 0; tries < 300; ++tries)); do
    [[ -z $(squeue -h) ]] && break
    # Slurm lets a job that is queued again wait for two minutes.
    squeue -h -t PENDING -o '%i %r' | awk '$2 == "BeginTime" { print $1 }' |
        xargs -r -I '{}' scontrol update JobId='{}' StartTime=now
    sleep 1
done
cat "$FOLDER"/*.log >"$work/log"
grep -q 'queued again' "$work/log" || fail "no part was queued again" "$work/log"
check_image "$work/log"
