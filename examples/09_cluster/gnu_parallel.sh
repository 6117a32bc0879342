#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A sweep with GNU parallel on machines with SSH access.
#
#   gnu_parallel.sh SUITE DIR [N [HOST,HOST,…]]
#
# N shards (default: four per core of this machine), as many at a time as the machines have cores.
# SUITE and DIR must have the same path on all machines. If it was interrupted, start it again to resume.
set -euo pipefail
suite=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
shards=${3:-$((4 * $(nproc)))}
hosts=${4:-:}
tagfield=${TAGFIELD:-tagfield}

# An adaptive sweep has rungs: each merge closes one, after which the shards have new runs.
while :; do
  rungs=$(cksum "$folder/rungs.json" 2>/dev/null || true)
  # Exit code 3 of a shard means that some runs failed, which --merge lists; that counts as success here.
  seq "$shards" | parallel --sshlogin "$hosts" --retries 3 --joblog "$folder/parallel.log" \
    "$tagfield" sweep "$suite" --shard "{}/$shards" --out "$folder" --threads 1 '||' test '$?' = 3
  code=0
  "$tagfield" sweep --merge "$folder" || code=$?
  [[ "$rungs" != "$(cksum "$folder/rungs.json" 2>/dev/null || true)" ]] || exit "$code"
done
