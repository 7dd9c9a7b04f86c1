#!/usr/bin/env bash
# A Slurm of one machine in a scratch place, and a study in shards on it: tasks are killed and
# requeued, asked to end, cancelled and submitted again. The merged ledger must be the ledger of an
# unsharded run, bit for bit. Then the same study on the ranks of mpirun inside a job.
# usage: scripts/cluster-test.sh BOLTER   (root: it starts munged, slurmctld and slurmd)
set -euo pipefail
shopt -s inherit_errexit
bolter=$(realpath "$1")
cd "$(dirname "$0")/.."
[ "$(id -u)" -eq 0 ] || { echo "cluster-test: needs root, to start Slurm's daemons" >&2; exit 2; }

scratch=$(mktemp -d "${TMPDIR:-/tmp}/bolter-cluster-XXXXXX")
chmod 711 "$scratch"
export SLURM_CONF=$scratch/slurm.conf
daemons=()
end() {
    local code=$?
    [ $code -eq 0 ] || tail -n 20 "$scratch"/jobs/*.log "$scratch"/log/* >&2 || true
    for name in slurmd slurmctld munged; do
        [ -s "$scratch/$name.pid" ] && kill "$(cat "$scratch/$name.pid")" 2>/dev/null || true
    done
    sleep 1
    rm -rf "$scratch"
    exit $code
}
trap end EXIT

# --- the cluster ------------------------------------------------------------------------------
mkdir -p "$scratch"/{state,spool,log,munge}
chmod 700 "$scratch/munge"
(umask 077 && head -c 1024 /dev/urandom >"$scratch/munge/key")
munged --force --key-file="$scratch/munge/key" --socket="$scratch/munge/socket" \
    --pid-file="$scratch/munged.pid" --log-file="$scratch/log/munged" \
    --seed-file="$scratch/munge/seed"
host=$(hostname -s)
cat >"$SLURM_CONF" <<CONF
ClusterName=bolter
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$scratch/munge/socket,cred_expire=5
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$scratch/state
SlurmdSpoolDir=$scratch/spool
SlurmctldPidFile=$scratch/slurmctld.pid
SlurmdPidFile=$scratch/slurmd.pid
SlurmctldLogFile=$scratch/log/slurmctld
SlurmdLogFile=$scratch/log/slurmd
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
MpiDefault=none
ReturnToService=2
MinJobAge=3600
SchedulerParameters=sched_interval=1,batch_sched_delay=0,requeue_delay=1,bf_interval=1
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=$host Default=YES MaxTime=INFINITE State=UP
CONF
slurmctld -c
slurmd -c
# wait_for SECONDS COMMAND...
wait_for() {
    local left=$((10 * $1))
    shift
    until "$@" >/dev/null 2>&1; do
        [ $((left -= 1)) -gt 0 ] || { echo "cluster-test: waited too long for: $*" >&2; squeue >&2; return 1; }
        sleep 0.1
    done
}
is_idle() { sinfo -h -o %T | grep -q idle; }
wait_for 60 is_idle
echo "cluster-test: Slurm $(sinfo --version | cut -d' ' -f2) is up"

# --- the study --------------------------------------------------------------------------------
# A coarse cable: ten milliseconds a landing.
study=(studies/reference/study.yaml --set campaign.samples=1600 --set campaign.unsure=0
    --set "deck.cable.mesh.fine_length=0.2 m" --set "deck.cable.mesh.medium_length=0.3 m"
    --set "deck.cable.mesh.coarse_length=0.6 m" --set reliability.samples=1000
    --set reliability.high_fidelity_runs=0)
content() {
    "$bolter" campaign status "${study[@]}" -o "$1" --json | sed -n 's/.*"content": "\(.*\)".*/\1/p'
}
"$bolter" campaign "${study[@]}" -o "$scratch/alone" --quiet >/dev/null
alone=$(content "$scratch/alone")
[ -n "$alone" ]
jobs=$scratch/jobs
"$bolter" campaign "${study[@]}" --slurm "$jobs" --parts 4

# --- submitted, requeued, asked to end, cancelled ---------------------------------------------
is_running() { [ "$(squeue -h -t R -j "$1" -o %i)" ]; }
has_started() { is_running "$1" && [ -s "$jobs/part-${1#*_}/campaign.sqlite" ]; }
is_over() { [ -z "$(squeue -h -j "$1" -t PD,R,CG,S -o %i)" ]; }
"$jobs/submit.sh" >"$scratch/submitted"
cat "$scratch/submitted"
array=$(sed -n 's/landings: job \([0-9]*\);.*/\1/p' "$scratch/submitted")
results=$(sed -n 's/.*results: job \([0-9]*\),.*/\1/p' "$scratch/submitted")
wait_for 60 has_started "${array}_1"
scontrol requeue "${array}_1" # killed by the scheduler, and started again
wait_for 60 has_started "${array}_2"
scancel --signal=USR1 --batch "${array}_2" # what comes before the end of the time
wait_for 60 has_started "${array}_3"
scancel "${array}_3" # by a person: it stays away
wait_for 300 is_over "$array"
grep -q "" "$jobs"/part-3/campaign.sqlite
! is_over "$results" || { echo "cluster-test: results ran without part 3" >&2; exit 1; }
scancel "$results"
echo "cluster-test: requeued task 1, ended task 2, cancelled task 3; submitting again"
"$jobs/submit.sh" >"$scratch/submitted"
results=$(sed -n 's/.*results: job \([0-9]*\),.*/\1/p' "$scratch/submitted")
wait_for 600 is_over "$results"
test -s "$jobs/results/reliability.json"
[ "$alone" = "$(content "$jobs/results")" ] ||
    { echo "cluster-test: the merged ledger is not that of an unsharded run" >&2; exit 1; }
echo "cluster-test: the merged ledger is the unsharded one: $alone"

# --- the ranks of mpirun in a job -------------------------------------------------------------
if "$bolter" --version --verbose | grep -q '^mpi  *Open'; then
    export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
    job=$(sbatch --parsable --ntasks="$(nproc)" --chdir="$PWD" --output="$jobs/mpi.log" <<JOB
#!/bin/sh
exec mpirun --mca plm ^slurm --mca ras ^slurm -n $(nproc) '$bolter' campaign $(printf "'%s' " "${study[@]}") -o '$scratch/ranks' --quiet
JOB
    )
    wait_for 300 is_over "$job"
    [ "$alone" = "$(content "$scratch/ranks")" ] ||
        { echo "cluster-test: the ledger of the ranks is not that of one process" >&2; exit 1; }
    echo "cluster-test: $(nproc) ranks of mpirun in a job give the same ledger"
fi
