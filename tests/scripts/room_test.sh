#!/usr/bin/env bash
# scripts/room runs the tests of a room, and says which rooms there are.
#
#   room_test.sh SOURCE_DIR
set -euo pipefail
cd "$1"
said=$(scripts/room poses --gtest_filter='Trajectory.*' 2>&1)
grep -q 'PASSED' <<<"$said" || { echo "no tests were run: $said"; exit 1; }

code=0
said=$(scripts/room no_such_room 2>&1) || code=$?
[[ $code -eq 2 ]] || { echo "exit code $code of an unknown room, expected 2"; exit 1; }
grep -q 'expected one of: .*poses' <<<"$said" || { echo "does not name the rooms: $said"; exit 1; }
