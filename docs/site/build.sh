#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the site, for scripts/docs. From the top of the checkout:
#
#   docs/site/build.sh TAGFIELD PYTHON_FOLDER OUT [yes|no]
#
# TAGFIELD is the program, PYTHON_FOLDER contains the Python package, OUT is recreated; no: without the images of the
# gallery.
set -euo pipefail
tagfield=$1 python=$2 out=$3 gallery=${4:-yes}
mkdir -p "$out"
out=$(cd "$out" && pwd)
rm -rf "$out/doxygen" "$out/source" "$out/html"
export PYTHONPATH="$python:$PWD/docs/site" PYTHONDONTWRITEBYTECODE=1 TAGFIELD_DOCS_OUT="$out"
(
  cat docs/site/Doxyfile
  echo "OUTPUT_DIRECTORY = $out/doxygen"
  echo "INPUT = $(sed -n 's/^| `\(tagfield\/[^`]*\.h\)` .*/\1/p' docs/api.md | tr '\n' ' ')"
) | doxygen -
/usr/bin/python3 docs/site/stage.py . "$tagfield" "$out/source" --gallery "$gallery"
/usr/bin/python3 -m sphinx -q -W --keep-going -j 2 -c docs/site "$out/source" "$out/html"
