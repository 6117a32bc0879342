#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tidy_test.py where clang-tidy is Debian 12's: each version has checks of its own, and .clang-tidy chooses among those
# of one.
#
#   tidy_test.sh SOURCE_DIR BUILD_DIR [OPTION…]   those of tidy_test.py
set -euo pipefail
version=$(clang-tidy --version 2>/dev/null | sed -nE 's/.*version ([0-9]+).*/\1/p' || true)
if [[ -n "$version" && "$version" != 14 ]]; then
  echo "skipped: sources are kept clean by clang-tidy 14, and here is $version"
  exit 77
fi
exec /usr/bin/python3 -B "$(dirname "$0")/tidy_test.py" "$@"
