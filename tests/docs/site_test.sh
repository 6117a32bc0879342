#!/usr/bin/env bash
# The site of docs/ is made without a warning, where what makes it is installed; without the gallery's pictures.
#
#   site_test.sh SOURCE_DIR TAGFIELD BUILD_DIR
set -euo pipefail
cd "$1"
tagfield=$2 python=$3/lib/python
skip() {
  echo "site: Skipped"
  echo "$1"
  exit 77
}
scripts/setup --check --python --docs || skip "what makes the site is not installed: scripts/setup --python --docs"
ls "$python"/tagfield/_core*.so >/dev/null 2>&1 || skip "the Python package is not built: tagfield_python"
out=$(mktemp --directory)
trap 'rm -rf "$out"' EXIT
docs/site/build.sh "$tagfield" "$python" "$out" no
# All pages are there, and what is drawn by script has what draws it.
for page in index first_ten_minutes commands all_keys messages cpp_field python_api methods faq; do
  [[ -s "$out/html/$page.html" ]] || { echo "site: $page.html is missing"; exit 1; }
done
[[ -s "$out/html/_static/katex.js" && -s "$out/html/_static/fonts/KaTeX_Main-Regular.woff2" ]] || {
  echo "site: KaTeX is missing"
  exit 1
}
grep --quiet 'id="run"' "$out/html/commands.html" || { echo "site: the command 'run' is not described"; exit 1; }
grep --quiet 'locate_tags' "$out/html/cpp_localization.html" || { echo "site: locate_tags() is not described"; exit 1; }
grep --quiet 'tagfield.localize' "$out/html/python_api.html" || { echo "site: localize() is not described"; exit 1; }
