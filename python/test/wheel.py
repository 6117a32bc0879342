#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Builds a wheel from an existing build, installs it into a separate folder and uses it there.

    wheel.py SOURCE BUILD
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import zipfile

USE = """
import tagfield
run = tagfield.load(tagfield.share("scenarios/paper_warehouse.yaml")).run(seed=1)
assert len(run.errors_m) == 10 and run.errors_m.mean() < 0.02, run.errors_m
print(tagfield.__file__)
"""


def main():
    source, build = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    with tempfile.TemporaryDirectory(prefix="tagfield-wheel-") as name:
        folder = pathlib.Path(name)
        copy = folder / "source"  # setuptools writes its own files next to the sources.
        copy.mkdir()
        for item in ("CMakeLists.txt", "LICENSE", "README.md", "pyproject.toml", "python", "setup.py"):
            (copy / item).symlink_to(source / item)
        environment = {**os.environ, "TAGFIELD_BUILD": str(build)}
        environment.pop("PYTHONPATH", None)
        pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--no-cache-dir"]
        made = subprocess.run([*pip, "wheel", "--no-build-isolation", "--no-deps", "--no-index", "-w", folder,
                               copy], env=environment, capture_output=True, text=True, check=False)
        if made.returncode != 0:
            sys.exit(f"pip wheel failed:\n{made.stdout}{made.stderr}")
        wheel, = folder.glob("*.whl")
        names = zipfile.ZipFile(wheel).namelist()
        for part in ("tagfield/__init__.py", "tagfield/_core.pyi", "tagfield/py.typed",
                     "tagfield/share/scenarios/paper_warehouse.yaml"):
            assert part in names, f"{wheel.name} has no {part}: {names}"
        assert "any" not in wheel.name, f"{wheel.name} is of one machine's kind"
        place = folder / "packages"
        subprocess.run([*pip, "install", "--no-deps", "--no-index", "--quiet", "--target", place, wheel],
                       check=True, env=environment)
        used = subprocess.run([sys.executable, "-c", USE], check=False, capture_output=True, text=True,
                              env={**environment, "PYTHONPATH": str(place)}, cwd=folder)
        assert used.returncode == 0, used.stderr
        assert used.stdout.strip().startswith(str(place)), used.stdout
        print(f"{wheel.name}: {len(names)} files, {wheel.stat().st_size / 1e6:.1f} MB, installed and used")


if __name__ == "__main__":
    main()
