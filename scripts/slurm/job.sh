#!/bin/bash
# One command on all ranks of a job. Usage, from the folder with the files:
#   sbatch --ntasks=64 scripts/slurm/job.sh plumbline batch jobs.yaml -o robots
# The folder must be one that all nodes share. Broken off (time limit, a node that dies), the same line goes on.
#SBATCH --job-name=plumbline
#SBATCH --ntasks=16
#SBATCH --cpus-per-task=1
#SBATCH --time=12:00:00
#SBATCH --output=plumbline-%j.log
# A minute before the time is up rank 0 is asked to end between two tasks.
#SBATCH --signal=INT@60
set -euo pipefail
export OMP_NUM_THREADS=1
# Open MPI's mpirun takes nodes and ranks from Slurm. PLUMBLINE_MPIRUN: other words for it.
exec ${PLUMBLINE_MPIRUN:-mpirun} "$@"
