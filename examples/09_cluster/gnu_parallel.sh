#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A sweep on the machines that one can log in to, by GNU parallel.
#
#   gnu_parallel.sh SUITE DIR [N [HOST,HOST,…]]
#
# N shards (default: four for each core of this machine), as many at a time as the machines have cores.
# SUITE and DIR must be seen by all machines under the same path. Start it again after whatever ended it.
set -euo pipefail
suite=$(realpath "$1")
mkdir -p "$2"
folder=$(realpath "$2")
shards=${3:-$((4 * $(nproc)))}
hosts=${4:-:}
tagfield=${TAGFIELD:-tagfield}

# A sweep that is adaptive has rungs: each merge closes one, and the shards then have more to do.
while :; do
  rungs=$(cksum "$folder/rungs.json" 2>/dev/null || true)
  # Exit code 3 says that runs failed, which the merge lists; parallel ends with how many shards did.
  seq "$shards" | parallel --sshlogin "$hosts" --retries 3 --joblog "$folder/parallel.log" \
    "$tagfield" sweep "$suite" --shard "{}/$shards" --out "$folder" --threads 1 '||' test '$?' = 3
  code=0
  "$tagfield" sweep --merge "$folder" || code=$?
  [[ "$rungs" != "$(cksum "$folder/rungs.json" 2>/dev/null || true)" ]] || exit "$code"
done
