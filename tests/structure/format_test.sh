#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tests that every C++ file is formatted by clang-format.
#
#   format_test.sh SOURCE_DIR
set -euo pipefail
cd "$1"
command -v clang-format >/dev/null || { echo "skipped: clang-format is not installed"; exit 77; }
# Versions of clang-format differ in some lines, even with the same .clang-format.
version=$(clang-format --version | sed -E 's/.*version ([0-9]+).*/\1/')
[[ "$version" == 14 ]] || { echo "skipped: the form is that of clang-format 14, and here is $version"; exit 77; }
files=$(mktemp)
trap 'rm -f "$files"' EXIT

if git ls-files -z -- '*.h' '*.cc' >"$files" 2>/dev/null && [[ -s "$files" ]]; then
  # Files that are deleted but not committed yet are still listed.
  while IFS= read -r -d '' file; do
    [[ ! -e "$file" ]] || printf '%s\0' "$file"
  done <"$files" >"$files.there"
  mv "$files.there" "$files"
else
  find . -path ./build -prune -o \( -name '*.h' -o -name '*.cc' \) -type f -print0 >"$files"
fi
count=$(tr -cd '\0' <"$files" | wc -c)
[[ $count -ge 50 ]] || { echo "only $count files: looked in the wrong place?"; exit 1; }

# Makes sure that the check can fail.
if echo 'int  main( ){ }' | clang-format --style=file --assume-filename=a.cc --dry-run --Werror \
  2>/dev/null; then
  echo "clang-format takes anything: is .clang-format there?"
  exit 1
fi
xargs -0 -n 40 -P "$(nproc)" clang-format --style=file --dry-run --Werror <"$files"
echo "$count files are in form"
