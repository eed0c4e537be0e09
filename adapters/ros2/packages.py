# SPDX-License-Identifier: Apache-2.0
"""Definitions of ours as packages of ROS 2, for `ros2 topic echo` and nodes of others: of PACKAGE=FOLDER, a folder with
{msg,srv,action} below it or messages in it, OUT/PACKAGE, which colcon builds.

    packages.py --out OUT [--as PACKAGE:OTHER:NAME,...] PACKAGE=FOLDER...

rosidl takes names in lower case only: press_N is press_n there. On the wire fields have no names, so both are the same message.
--as: these are OTHER's, whose package is not ours to make."""

import argparse
import pathlib
import re
import sys

from definitions import FIELD, owners, read

# What rosidl takes as the name of a field.
NAME = re.compile(r"^(?!.*__)(?!.*_$)[a-z][a-z0-9_]*$")
CMAKE = """cmake_minimum_required(VERSION 3.8)
project({package})
find_package(ament_cmake REQUIRED)
find_package(rosidl_default_generators REQUIRED)
{finds}
rosidl_generate_interfaces(${{PROJECT_NAME}}
  {files}
  DEPENDENCIES {depends})
ament_export_dependencies(rosidl_default_runtime)
ament_package()
"""
XML = """<?xml version="1.0"?>
<package format="3">
  <name>{package}</name>
  <version>{version}</version>
  <description>Messages and actions of Limpet, a simulator of multirotors that perch on walls.</description>
  <maintainer email="limpet@example.org">Limpet</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
{depends}
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>
  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
"""


def line_of_ros2(line, place):
    """A line of a definition as rosidl takes it, and the package that it needs."""
    field, hash_, comment = line.partition("#")
    found = FIELD.match(field.strip())
    if not found:
        return line, None
    kind, bound, array, _, _, name, value, default = found.groups()
    kind = "std_msgs/Header" if kind == "Header" else kind
    if value is None:
        name = name.lower()
        if not NAME.match(name):
            sys.exit(f"{place}: {name}: rosidl takes no such name")
    text = f"{kind}{bound or ''}{array or ''} {name}"
    text += f"={value}" if value is not None else f" {default}" if default else ""
    return text + (f"  # {comment.strip()}" if hash_ else ""), kind.split("/")[0] if "/" in kind else None


def definition(text, place):
    lines, needs = [], set()
    for number, line in enumerate(text.splitlines(), 1):
        made, need = line_of_ros2(line, f"{place}:{number}")
        lines.append(made)
        needs |= {need} - {None}
    return "\n".join(lines) + "\n", needs


def package(name, folder, others, out, version):
    files, needs = [], set()
    for file in sorted(folder.rglob("*.*")):
        kind = file.suffix[1:]
        if kind in ("msg", "srv", "action") and (name, file.stem) not in others:
            text, more = definition(read(name, file), file)
            needs |= more | ({"action_msgs"} if kind == "action" else set())
            files.append(f"{kind}/{file.name}")
            to = out / name / kind / file.name
            to.parent.mkdir(parents=True, exist_ok=True)
            to.write_text(text)
    needs = sorted(needs - {name})
    (out / name / "CMakeLists.txt").write_text(CMAKE.format(
        package=name, finds="\n".join(f"find_package({need} REQUIRED)" for need in needs),
        files="\n  ".join(f'"{file}"' for file in files), depends=" ".join(needs)))
    (out / name / "package.xml").write_text(XML.format(
        package=name, version=version, depends="\n".join(f"  <depend>{need}</depend>" for need in needs)))


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--version", default="0.0.0")
    parser.add_argument("--as", dest="others", action="append", default=[])
    parser.add_argument("folders", nargs="+")
    given = parser.parse_args()
    others = owners(given.others)
    for one in given.folders:
        name, _, folder = one.partition("=")
        package(name, pathlib.Path(folder), others, given.out, given.version)


if __name__ == "__main__":
    main()
