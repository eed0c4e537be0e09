# SPDX-License-Identifier: Apache-2.0
import ast
import subprocess
import sys
from pathlib import Path

import limpet


def names_of_stub():
    """{class or module: what it has}"""
    tree = ast.parse((Path(limpet.__file__).parent / "_core.pyi").read_text())
    names = {"": {node.name for node in tree.body if hasattr(node, "name")}}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            names[node.name] = {one.name if hasattr(one, "name") else one.target.id
                                for one in node.body if not isinstance(one, ast.Expr)}
    return names


def test_stubs_are_of_the_module():
    stub, core = names_of_stub(), limpet._core
    public = {name for name in vars(core) if not name.startswith("__")}
    assert stub.pop("") == public
    for name, members in stub.items():
        there = {member for member in vars(getattr(core, name))
                 if not member.startswith("_") or member in ("_changed", "__getitem__")}
        assert members - {"__init__"} == there or name.endswith("Error"), name


def test_the_package_is_typed(tmp_path):
    checked = subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", str(tmp_path),
                              "--ignore-missing-imports", str(Path(limpet.__file__).parent)],
                             capture_output=True, text=True, cwd=tmp_path)
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_everything_public_says_what_it_is():
    silent = [name for name in limpet.__all__ if name not in ("Changes", "__version__")
              and not (getattr(limpet, name).__doc__ or "").strip()]
    assert silent == []
