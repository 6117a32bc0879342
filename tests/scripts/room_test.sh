#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests that scripts/room runs the tests of a room or of a file, and lists the rooms for an unknown one.
#
#   room_test.sh SOURCE_DIR
set -euo pipefail
cd "$1"
said=$(scripts/room poses --gtest_filter='Trajectory.*' 2>&1)
grep -q 'PASSED' <<<"$said" || { echo "no tests were run: $said"; exit 1; }

said=$(scripts/room tagfield/poses/trajectory.cc 2>&1)
grep -q 'PASSED' <<<"$said" || { echo "no tests of a file were run: $said"; exit 1; }
whole=$(scripts/room poses 2>&1)
count() { sed -nE 's/.*\] ([0-9]+) tests? from.*ran.*/\1/p' <<<"$1" | awk "{ sum += \$1 } END { print sum + 0 }"; }
[[ $(count "$said") -gt 0 && $(count "$said") -lt $(count "$whole") ]] ||
  { echo "a file's tests are not fewer than its room's: $said $whole"; exit 1; }

code=0
said=$(scripts/room no_such_room 2>&1) || code=$?
[[ $code -eq 2 ]] || { echo "exit code $code of an unknown room, expected 2"; exit 1; }
grep -q 'or one of: .*poses' <<<"$said" || { echo "does not name the rooms: $said"; exit 1; }
