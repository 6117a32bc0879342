#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests what scripts that use another Debian say when there is none, and what a command in its root gets of this
# environment.
#
#   roots_test.sh SOURCE_DIR
set -euo pipefail
cd "$1"

# refuses CODE PATTERN COMMAND…
refuses() {
  local expected=$1 pattern=$2 code=0 said
  shift 2
  said=$("$@" 2>&1) || code=$?
  [[ $code -eq $expected ]] || { echo "exit code $code of '$*', expected $expected: $said"; exit 1; }
  grep -q -- "$pattern" <<<"$said" || { echo "'$*' says nothing of '$pattern': $said"; exit 1; }
}
refuses 2 'expected the folder' scripts/test-in
refuses 2 'expected the folder' scripts/test-in -R localization
refuses 77 'debootstrap' scripts/test-in /no/such/root
refuses 77 'debootstrap' scripts/package --try /no/such/root

if [[ $EUID -ne 0 ]] || ! unshare --mount true 2>/dev/null; then
  echo "skipped: a command in a root needs root, and mounts in a namespace of its own"
  exit 0
fi
source scripts/roots.sh
mounts=$(cat /proc/self/mounts)
# This system as the root: its environment must be that of a first log-in, with proxies alone.
said=$(PYTHONPATH=/of/this/user https_proxy=http://proxy.example:3128 in_root / bash -c 'env; echo "$1, $2"' name "two words" '*')
[[ "$said" != *PYTHONPATH* ]] || { echo "PYTHONPATH is taken into the root: $said"; exit 1; }
for line in https_proxy=http://proxy.example:3128 HOME=/root 'two words, \*'; do
  grep -qx -- "$line" <<<"$said" || { echo "no '$line' in the root: $said"; exit 1; }
done
[[ "$(cat /proc/self/mounts)" == "$mounts" ]] || { echo "mounts are left"; exit 1; }
code=0
in_root / sh -c 'exit 3' || code=$?
[[ $code -eq 3 ]] || { echo "exit code $code of a command in the root, expected 3"; exit 1; }
