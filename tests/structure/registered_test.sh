#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Whether ctest knows each script of tests/ and fuzz/: one that it doesn't know is never run.
#
#   registered_test.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
cd "$1"
code=0
for script in tests/*/*_test.{py,sh} fuzz/*_test.py; do
  name=$(basename "$script")
  # Gazebo's and gz-sim's are only where those are built.
  case "$script" in tests/gazebo/* | tests/gz/*) continue ;; esac
  # By another script, which stands beside it, at least.
  grep --recursive --quiet --fixed-strings --include=CTestTestfile.cmake "/$name\"" "$2" ||
    grep --quiet --fixed-strings "$name" "$(dirname "$script")"/*_test.sh 2>/dev/null || {
    echo "$script: no test runs it (tests/CMakeLists.txt)"
    code=1
  }
done
exit "$code"
