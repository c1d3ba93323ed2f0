#!/bin/sh
# Runs an experiment or a study as a Slurm job array: one shard per task.
#
#   sbatch --array=1-N slurm-array.sh N OUT COMMAND…
#   sbatch --array=1-16 slurm-array.sh 16 out study monte-carlo --count 1000
#
# N is the number of shards, and OUT a folder that all nodes share; the task i writes OUT/shard-i. A task that was
# cancelled, killed or lost with its node is put into the queue again and continues with the trials that are
# missing. To run some shards again: --array=3,7 with the same N. CAPSTAN_CLI names the program where it is not in
# PATH. When all tasks are done:
#
#   capstan-cli merge results out/shard-*
#
#SBATCH --job-name=capstan
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --cpus-per-task=1
set -eu
if [ $# -lt 3 ] || [ -z "${SLURM_ARRAY_TASK_ID:-}" ]; then
  echo "usage: sbatch --array=1-N slurm-array.sh N OUT COMMAND…" >&2
  exit 2
fi
shards=$1
out=$2
shift 2
# exec: signals of Slurm reach the program, which then stores what is finished.
exec "${CAPSTAN_CLI:-capstan-cli}" "$@" --threads "${SLURM_CPUS_PER_TASK:-1}" \
  --shard "$SLURM_ARRAY_TASK_ID/$shards" --out "$out/shard-$SLURM_ARRAY_TASK_ID"
