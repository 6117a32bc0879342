#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A sweep as a Slurm job array, and a job that merges the results. Run it on a machine with sbatch:
#
#   slurm.sh SUITE DIR N [sbatch's options, such as --partition=long --time=2:00:00]
#
# DIR must be on a file system shared by all nodes. N is at most MaxArraySize − 1 (`scontrol show
# config`). If it was interrupted, start it again: finished runs are not repeated.
set -euo pipefail
suite=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
shards=$3
shift 3
tagfield=$(command -v "${TAGFIELD:-tagfield}")

# The number of rungs of an adaptive sweep is not known in advance; each array works on the open one, and
# each merge closes it. RUNGS=4 submits four pairs of array and merge, one after another.
after=()
for _ in $(seq "${RUNGS:-1}"); do
  array=$(sbatch --parsable --array="1-$shards" --job-name=tagfield "${after[@]}" --requeue \
    --output="$folder/slurm-%A_%a.out" "$@" --wrap \
    "$tagfield sweep '$suite' --shard \$SLURM_ARRAY_TASK_ID/$shards --out '$folder' --threads \${SLURM_CPUS_PER_TASK:-1}")
  # Runs even if some jobs have failed: the merge reports failed and missing runs.
  merge=$(sbatch --parsable --dependency="afterany:$array" --job-name=tagfield-merge \
    --output="$folder/slurm-merge-%j.out" "$@" --wrap "$tagfield sweep --merge '$folder'")
  after=(--dependency="afterany:$merge")
done
echo "submitted array $array; its merge is job $merge"
