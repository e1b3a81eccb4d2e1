#!/usr/bin/env bash
#SBATCH --job-name=saltus-merge
#SBATCH --requeue
#SBATCH --open-mode=append
#
# Puts the pieces of saltus-array.sh together; same arguments. It computes nothing: where pieces are missing or
# damaged it names each with the shard that makes it, and ends with exit code 3.
set -euo pipefail
exec "${SALTUS:-saltus}" "$@" --merge --threads "${SLURM_CPUS_PER_TASK:-1}"
