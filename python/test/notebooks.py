#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs all notebooks of a folder with nbconvert, one after another in one kernel.

    notebooks.py FOLDER [OUT]

With OUT, each is written there as HTML with its figures, for inspection.
"""

import pathlib
import sys

try:
    import nbformat
    from nbconvert import HTMLExporter
    from nbconvert.preprocessors import CellExecutionError, ExecutePreprocessor
except ImportError as missing:
    print(f"skipped: {missing} (jupyter-nbconvert, python3-ipykernel)")
    sys.exit(77)


def main():
    folder = pathlib.Path(sys.argv[1])
    out = pathlib.Path(sys.argv[2]) if len(sys.argv) > 2 else None
    paths = sorted(folder.glob("*.ipynb"))
    failures = 0 if paths else 1
    # One kernel for all: starting one and loading matplotlib takes longer than most notebooks.
    together = nbformat.v4.new_notebook()
    counts = []
    for path in paths:
        notebook = nbformat.read(path, as_version=4)
        if any(cell.get("outputs") for cell in notebook.cells):
            print(f"{path.name}: has outputs: they are made by running it, and not kept")
            failures += 1
        fresh = nbformat.v4.new_code_cell("%reset -f")
        together.cells += [fresh, *notebook.cells]
        counts.append(len(notebook.cells))
    try:
        ExecutePreprocessor(timeout=120, kernel_name="python3").preprocess(
            together, {"metadata": {"path": str(folder)}})
    except CellExecutionError as error:
        print(error)
        failures += 1
    begin = 0
    for path, count in zip(paths, counts):
        cells = together.cells[begin + 1:begin + 1 + count]
        begin += 1 + count
        drawn = sum("image/png" in output.get("data", {}) for cell in cells for output in cell.get("outputs", []))
        print(f"{path.name}: {count} cells, {drawn} figures")
        failures += drawn == 0
        if out is not None:
            done = nbformat.v4.new_notebook(cells=cells)
            out.mkdir(parents=True, exist_ok=True)
            (out / f"{path.stem}.html").write_text(HTMLExporter().from_notebook_node(done)[0], encoding="utf-8")
    print(f"{len(paths)} notebooks, {failures} failures")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
