# SPDX-License-Identifier: Apache-2.0
"""Builds the Python package's C++ extension with CMake, for `pip install .` and `pip wheel .`.

TAGFIELD_BUILD names a build folder that contains it already; it is then installed from there.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

SOURCE = pathlib.Path(__file__).resolve().parent


def version():
    text = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
    return re.search(r"project\(tagfield VERSION (\S+)", text).group(1)


class CMakeBuild(build_ext):
    """Installs the extension and its accompanying files from CMake's component `python`."""

    def build_extension(self, ext):
        target = pathlib.Path(self.get_ext_fullpath(ext.name)).resolve().parent
        build = pathlib.Path(os.environ.get("TAGFIELD_BUILD", SOURCE / "build" / "python"))
        if "TAGFIELD_BUILD" not in os.environ:
            subprocess.run(["cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            "-DCMAKE_UNITY_BUILD=ON", "-DTAGFIELD_COMPONENTS=planning;experiment",
                            "-DTAGFIELD_PYTHON=ON", f"-DPython3_EXECUTABLE={sys.executable}"], check=True)
            subprocess.run(["cmake", "--build", build, "--target", "tagfield_python"], check=True)
        prefix = target.parent / "tagfield.installed"
        subprocess.run(["cmake", "--install", build, "--component", "python", "--prefix", prefix], check=True)
        for core in prefix.rglob("_core*.so"):
            shutil.copytree(core.parent, target, dirs_exist_ok=True)
        shutil.rmtree(prefix)


setup(version=version(), ext_modules=[Extension("tagfield._core", [])], cmdclass={"build_ext": CMakeBuild})
