# SPDX-License-Identifier: Apache-2.0
"""Builds the extension and the program by CMake, as everything else here is built; see pyproject.toml."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

from setuptools import Distribution, setup
from setuptools.command.build_py import build_py

ROOT = Path(__file__).resolve().parents[2]
# A tree that is configured already, or one of its own.
GIVEN = os.environ.get("LIMPET_BUILD_TREE")
TREE = Path(GIVEN) if GIVEN else ROOT / "build" / "pip"


class Build(build_py):
    def run(self):
        if not GIVEN:
            subprocess.run(["cmake", "-S", ROOT, "-B", TREE, "-G", "Ninja", f"-DPython_EXECUTABLE={sys.executable}",
                            "-DCMAKE_BUILD_TYPE=Release", "-DLIMPET_TESTS=OFF", "-DLIMPET_BENCH=OFF",
                            "-DLIMPET_ROS2=OFF"], check=True)
        subprocess.run(["cmake", "--build", TREE, "--parallel", str(len(os.sched_getaffinity(0))),
                        "--target", "limpet_python", "limpet", "limpet_manual"], check=True)
        super().run()
        package = Path(self.build_lib) / "limpet"
        for module in (TREE / "python" / "limpet").glob("_core.*.so"):
            shutil.copy2(module, package)
        for component in ("program", "data"):
            subprocess.run(["cmake", "--install", TREE, "--strip", "--component", component, "--prefix",
                            package.resolve()], check=True, stdout=subprocess.DEVNULL)
        for others in ("lib/systemd", "share/doc"):  # a system's, not a package's
            shutil.rmtree(package / others, ignore_errors=True)


class Binary(Distribution):
    def has_ext_modules(self):
        return True


version = re.search(r'kVersion = "([\d.]+)"', (ROOT / "limpet/core/version.hpp").read_text()).group(1)
(ROOT / "build").mkdir(exist_ok=True)
setup(version=version, packages=["limpet"], package_dir={"limpet": "adapters/python/limpet"},
      scripts=["adapters/python/command/limpet"],
      package_data={"limpet": ["*.pyi", "py.typed"]}, distclass=Binary, cmdclass={"build_py": Build},
      options={"egg_info": {"egg_base": "build"}, "build": {"build_base": "build/setuptools"}})
