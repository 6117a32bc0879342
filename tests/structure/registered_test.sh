#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests that each test script in tests/ and fuzz/ is registered with ctest; otherwise it would never run.
#
#   registered_test.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
cd "$1"
code=0
for script in tests/*/*_test.{py,sh} fuzz/*_test.py; do
  name=$(basename "$script")
  # The tests in Gazebo and gz-sim are registered only where these are built.
  case "$script" in tests/gazebo/* | tests/gz/*) continue ;; esac
  # A script may also be run by another test script in its folder.
  grep --recursive --quiet --fixed-strings --include=CTestTestfile.cmake "/$name\"" "$2" ||
    grep --quiet --fixed-strings "$name" "$(dirname "$script")"/*_test.sh 2>/dev/null || {
    echo "$script: no test runs it (tests/CMakeLists.txt)"
    code=1
  }
done
exit "$code"
