#!/usr/bin/env bash
# clang-tidy has nothing to say of any source that is built, tests excepted.
#
#   tidy_test.sh SOURCE_DIR BUILD_DIR
set -euo pipefail
source_dir=$(realpath "$1")
build_dir=$(realpath "$2")
command -v clang-tidy >/dev/null || { echo "skipped: clang-tidy is not installed"; exit 77; }
database=$build_dir/compile_commands.json
[[ -e $database ]] || { echo "$database is not there: configure first"; exit 1; }
said=$(mktemp --directory --tmpdir tidy_test-XXXXXX)
trap 'rm -rf "$said"' EXIT

# It must be able to fail.
printf 'int f(int a) { int b; if (a) b = a; return b; }\n' >"$said/planted.cc"
if clang-tidy --quiet --config-file="$source_dir/.clang-tidy" "$said/planted.cc" -- -std=c++20 \
  >/dev/null 2>&1; then
  echo "clang-tidy takes anything: is .clang-tidy there?"
  exit 1
fi

# The files of the project that are compiled, each once.
/usr/bin/python3 -B - "$database" "$source_dir" >"$said/files" <<'END'
import json, os, sys
database, top = sys.argv[1:]
paths = {os.path.join(entry["directory"], entry["file"]) for entry in json.load(open(database))}
for path in sorted(map(os.path.realpath, paths)):
    name = os.path.relpath(path, top)
    if not name.startswith(("..", "build/", "tests/")) and "/test/" not in name and \
            os.path.exists(path):
        print(path, end="\0")
END
count=$(tr -cd '\0' <"$said/files" | wc -c)
[[ $count -ge 50 ]] || { echo "only $count files in $database: looked in the wrong place?"; exit 1; }

# What it says goes to a file for each source, so that two at a time don't mix; on stderr it only
# counts warnings of other people's headers.
look_at() {
  clang-tidy -p "$build_dir" --quiet "$1" >"$said/$(echo "$1" | tr / _).out" 2>"$said/stderr.$$" ||
    { [[ -s "$said/$(echo "$1" | tr / _).out" ]] || cp "$said/stderr.$$" \
        "$said/$(echo "$1" | tr / _).out"; exit 1; }
}
export -f look_at
export build_dir said
code=0
xargs -0 -n 1 -P "$(nproc)" bash -c 'look_at "$1"' look_at <"$said/files" || code=1
cat "$said"/*.out
echo "clang-tidy: $count files, exit code $code"
exit "$code"
