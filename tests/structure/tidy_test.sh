#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs tidy_test.py if clang-tidy is the version of Debian 12: the checks differ between versions, and .clang-tidy
# selects from those of this one.
#
#   tidy_test.sh SOURCE_DIR BUILD_DIR [OPTION…]   options of tidy_test.py
set -euo pipefail
version=$(clang-tidy --version 2>/dev/null | sed -nE 's/.*version ([0-9]+).*/\1/p' || true)
if [[ -n "$version" && "$version" != 14 ]]; then
  echo "skipped: sources are kept clean by clang-tidy 14, and here is $version"
  exit 77
fi
exec /usr/bin/python3 -B "$(dirname "$0")/tidy_test.py" "$@"
