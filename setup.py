# SPDX-License-Identifier: Apache-2.0
"""Builds the extension by CMake, as everything else here is built; see pyproject.toml."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parent
# A tree that is configured already, or one of its own.
GIVEN = os.environ.get("LIMPET_BUILD_TREE")
TREE = Path(GIVEN) if GIVEN else ROOT / "build" / "pip"
DATA = ("campaigns", "companions", "layouts", "paper", "samples", "scenarios", "vehicles")


class Build(build_py):
    def run(self):
        if not GIVEN:
            subprocess.run(["cmake", "-S", ROOT, "-B", TREE, "-G", "Ninja", f"-DPython_EXECUTABLE={sys.executable}",
                            "-DCMAKE_BUILD_TYPE=Release", "-DLIMPET_PROGRAM=OFF", "-DLIMPET_TESTS=OFF",
                            "-DLIMPET_BENCH=OFF"], check=True)
        subprocess.run(["cmake", "--build", TREE, "--target", "limpet_python"], check=True)
        super().run()
        package = Path(self.build_lib) / "limpet"
        for module in (TREE / "python" / "limpet").glob("_core.*.so"):
            shutil.copy2(module, package)
        share = package / "share" / "limpet"
        for folder in DATA:
            shutil.copytree(ROOT / folder, share / folder, dirs_exist_ok=True)
        shutil.copy2(ROOT / "surfaces.yaml", share)


class Binary(Distribution):
    def has_ext_modules(self):
        return True


version = re.search(r'kVersion = "([\d.]+)"', (ROOT / "limpet/core/version.hpp").read_text()).group(1)
(ROOT / "build").mkdir(exist_ok=True)
setup(version=version, packages=["limpet"], package_dir={"limpet": "python/limpet"},
      package_data={"limpet": ["*.pyi", "py.typed"]}, distclass=Binary, cmdclass={"build_py": Build},
      options={"egg_info": {"egg_base": "build"}, "build": {"build_base": "build/setuptools"}})
