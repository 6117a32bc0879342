#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A sweep as an array of Slurm jobs, and a job that merges what they left. Run it where sbatch is:
#
#   slurm.sh SUITE DIR N [sbatch's options, such as --partition=long --time=2:00:00]
#
# DIR must be on a file system that all nodes see. N is at most what `scontrol show config` says of
# MaxArraySize, less 1. Start it again after whatever ended it: what is done is not done twice.
set -euo pipefail
suite=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
shards=$3
shift 3
tagfield=$(command -v "${TAGFIELD:-tagfield}")

# Which rungs a sweep has that is adaptive can't be asked beforehand; each array works on the one that is
# open, and each merge closes it. RUNGS=4 submits four of both, one after another.
after=()
for _ in $(seq "${RUNGS:-1}"); do
  array=$(sbatch --parsable --array="1-$shards" --job-name=tagfield "${after[@]}" --requeue \
    --output="$folder/slurm-%A_%a.out" "$@" --wrap \
    "$tagfield sweep '$suite' --shard \$SLURM_ARRAY_TASK_ID/$shards --out '$folder' --threads \${SLURM_CPUS_PER_TASK:-1}")
  # Also where some have failed: the merge says which, and what is missing.
  merge=$(sbatch --parsable --dependency="afterany:$array" --job-name=tagfield-merge \
    --output="$folder/slurm-merge-%j.out" "$@" --wrap "$tagfield sweep --merge '$folder'")
  after=(--dependency="afterany:$merge")
done
echo "submitted array $array; its merge is job $merge"
