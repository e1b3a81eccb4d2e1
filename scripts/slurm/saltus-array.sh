#!/usr/bin/env bash
#SBATCH --job-name=saltus
#SBATCH --requeue
#SBATCH --open-mode=append
#
# One shard of a map, of basins or of a sweep with restarts, as a task of an array. `submit` beside this file sends it
# together with the job that puts the pieces together; by hand:
#
#   sbatch --array=1-64 --cpus-per-task=4 saltus-array.sh map study.toml --out results
#
# A task that was killed, preempted or requeued does only what is missing when it runs again: finished pieces lie
# beside the folder of results, which all nodes must see. To run some tasks again, give the number of all tasks:
#
#   SALTUS_SHARDS=64 sbatch --array=3,17 saltus-array.sh map study.toml --out results
#
# SALTUS is the program; by default `saltus`.
set -euo pipefail

shards=${SALTUS_SHARDS:-}
if [[ -z $shards ]]; then
    # without gaps, or shards would be left out
    if [[ $SLURM_ARRAY_TASK_MIN != 1 || $SLURM_ARRAY_TASK_MAX != "$SLURM_ARRAY_TASK_COUNT" ]]; then
        echo "saltus-array: for tasks other than 1-N set SALTUS_SHARDS to the number of all shards" >&2
        exit 2
    fi
    shards=$SLURM_ARRAY_TASK_COUNT
fi

# in place of this shell: Slurm's signal is for the program, which keeps what is finished
exec "${SALTUS:-saltus}" "$@" --quiet \
    --shard "$SLURM_ARRAY_TASK_ID/$shards" --threads "${SLURM_CPUS_PER_TASK:-1}"
