#!/bin/bash
# Runs a batch under a real Slurm on this machine, which has two nodes then: as one job over both (scripts/slurm/job.sh), and as an
# array of jobs (scripts/slurm/array.sh). Compares every byte with a run without Slurm, also after a job that was cancelled.
# Starts its own munged, slurmctld and two slurmd in a folder of its own, and ends them. 77: they are not installed.
# Usage: slurm_test.sh PROGRAM SOURCE_FOLDER
set -euo pipefail
program=$1 source=$2
export PATH=$PATH:/usr/sbin
for tool in munged slurmctld slurmd sbatch mpirun; do
  command -v $tool >/dev/null || { echo "$tool is not installed"; exit 77; }
done

work=$(mktemp -d /tmp/plumbline-slurm-XXXXXX)
daemons=()
end() {
  status=$?
  set +e
  if ((status != 0)); then tail -n 40 "$work"/*.log "$work"/batch/*.log 2>/dev/null; fi
  for ((i = ${#daemons[@]} - 1; i >= 0; --i)); do kill "${daemons[i]}"; wait "${daemons[i]}"; done 2>/dev/null
  rm -rf "$work"
  exit $status
}
trap end EXIT

# A daemon in the foreground of its own background process, so that its id is known.
start() {
  local name=$1
  shift
  "$@" >"$work/$name.log" 2>&1 &
  daemons+=($!)
}

wait_until() {
  for ((i = 0; i < 300; ++i)); do
    if "$@" >/dev/null 2>&1; then return 0; fi
    sleep 0.1
  done
  echo "gave up waiting for: $*"
  return 1
}

user=$(id -un)
dd if=/dev/urandom of="$work/munge.key" bs=128 count=1 status=none
chmod 600 "$work/munge.key"
chmod 755 "$work"
start munge munged --foreground --force --key-file="$work/munge.key" --socket="$work/munge.socket" \
  --pid-file="$work/munge.pid" --seed-file="$work/munge.seed" --log-file="$work/munged.log"
wait_until test -S "$work/munge.socket"

port=$((20000 + RANDOM % 20000))
mkdir "$work/state" "$work/spooln1" "$work/spooln2"
cat >"$work/slurm.conf" <<CONF
ClusterName=test
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
SlurmctldPort=$port
AuthType=auth/munge
AuthInfo=socket=$work/munge.socket
CredType=cred/munge
StateSaveLocation=$work/state
SlurmdSpoolDir=$work/spool%n
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd-%n.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=1,batch_sched_delay=0
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$((port + 1)) CPUs=2
NodeName=n2 NodeHostname=$(hostname -s) NodeAddr=127.0.0.1 Port=$((port + 2)) CPUs=2
PartitionName=all Nodes=n1,n2 Default=YES MaxTime=INFINITE State=UP
CONF
export SLURM_CONF=$work/slurm.conf
start slurmctld slurmctld -D -i
start slurmd1 slurmd -D -N n1
start slurmd2 slurmd -D -N n2
both_idle() { [[ $(sinfo -h -N -o %t | grep -c '^idle$') == 2 ]]; }
wait_until both_idle

# Recordings of a pendulum, and a batch over them.
batch=$work/batch
mkdir -p "$batch/experiments"
cp -r "$source/tests/robots/pendulum" "$batch/robot"
cd "$batch"
write_experiment() {
  printf 'plumbline: experiment/1\ntitle: A motion\nrole: %s\nduration: {value: 2, unit: s}\nsample_period: {value: 0.002, unit: s}\nstart:\n  shoulder: {value: 0, unit: deg}\ncommands:\n  drive:\n    - %s\n' "$2" "$3" >"experiments/$1.yaml"
}
write_experiment chirp train '{kind: stepped_chirp, from: 0.5 Hz, to: 8 Hz, steps: 5, first_amplitude: 0.4, last_amplitude: 1.5, unit: A}'
write_experiment swing held-out '{kind: multisine, frequencies: [0.7 Hz, 2.3 Hz], amplitudes: [0.4, 0.6], phases: [0 deg, 130 deg], unit: A}'
"$program" twin --model robot/model.yaml --with coulomb@drive:level=0.008 --experiment experiments/chirp.yaml experiments/swing.yaml \
  --out trials >/dev/null
{
  printf 'plumbline: batch/1\ntitle: Under Slurm\nmodel: robot/model.yaml\nrows:\n'
  for day in 1 2 3 4; do
    printf "  - {robot: A, day: %s, mode: fit, free: ['viscous@*:damping'], trials: [trials/chirp, trials/swing]}\n" $day
  done
  printf '  - {label: all, mode: compare, trials: [trials/chirp, trials/swing]}\n'
} >jobs.yaml
"$program" batch jobs.yaml -o alone >/dev/null

same() {
  if ! diff -r -x durations.csv -x '.*' alone "$1"; then
    echo "$2: not the same bytes"
    return 1
  fi
  echo "$2: the same bytes"
}

export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# Two nodes on one machine: their shared memory has one name, as on no cluster.
export OMPI_MCA_btl=tcp,self OMPI_MCA_btl_tcp_if_include=lo
export PLUMBLINE=$program
sbatch -W -N 2 -n 4 --ntasks-per-node=2 -o job.log "$source/scripts/slurm/job.sh" "$program" batch jobs.yaml -o ranks >/dev/null
same ranks "one job of 4 ranks on 2 nodes"

# Cancelled in the middle, the same line goes on.
id=$(sbatch --parsable -N 2 -n 4 --ntasks-per-node=2 -o cancelled.log "$source/scripts/slurm/job.sh" "$program" batch jobs.yaml -o broken)
one_row() { ls broken/rows/*.json; }
wait_until one_row
scancel "$id"
is_gone() { [[ -z $(squeue -h -j "$id") ]]; }
wait_until is_gone
sbatch -W -N 2 -n 4 --ntasks-per-node=2 -o again.log "$source/scripts/slurm/job.sh" "$program" batch jobs.yaml -o broken >/dev/null
same broken "a job that was cancelled, and again"

sbatch -W --array=1-2 -o array-%a.log "$source/scripts/slurm/array.sh" jobs.yaml array >/dev/null
"$program" batch jobs.yaml -o array >/dev/null
same array "an array of 2 jobs"
