#!/bin/bash
# A batch as an array of jobs that share its folder: no MPI between them, each starts when there is room. Usage:
#   sbatch --array=1-20 scripts/slurm/array.sh jobs.yaml robots
#   sbatch --dependency=afterany:JOB --wrap "plumbline batch jobs.yaml -o robots"      # the page over all rows
# PLUMBLINE: the program, where it is not on the path.
#SBATCH --job-name=plumbline-batch
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=2
#SBATCH --time=12:00:00
#SBATCH --output=plumbline-%A-%a.log
set -euo pipefail
jobs=$1 out=$2
exec "${PLUMBLINE:-plumbline}" batch "$jobs" -o "$out" --part "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
