# SPDX-License-Identifier: Apache-2.0
"""Definitions of interfaces (.msg, .srv, .action) as interfaces.py, packages.py and type_hashes.py read them."""

import pathlib
import re
import sys

# (type, bound of its string, array, "<=" of it, count, name, value of a constant, default)
FIELD = re.compile(r"^([\w/]+)(<=\d+)?(\[(<=)?(\d*)\])?\s+(\w+)\s*(?:=\s*(.+)|\s(.+))?$")


def lines(text, place):
    """The match of FIELD in each line with a definition."""
    for number, line in enumerate(text.splitlines(), 1):
        line = line.split("#")[0].strip()
        found = FIELD.match(line)
        if line and not found:
            sys.exit(f"{place}:{number}: {line}: must be TYPE NAME, with =VALUE or a default")
        if line:
            yield found.groups()


def read(package, file):
    """A file's text. A recording has as many rotors as its vehicle has (float64[4] stands for them), a type of ROS 2 a sequence."""
    text = file.read_text()
    return text.replace("float64[4]", "float64[]") if package == "limpet_msgs" else text


def parts(text):
    """Request and response; goal, result and feedback."""
    return re.split(r"^---$", text, flags=re.M)


def files(folders):
    """(package, file) of all below the folders; one given as PACKAGE=FOLDER has ROS 1's layout, FOLDER/{msg,srv,action}."""
    for folder in folders:
        package, equals, path = folder.partition("=")
        for file in sorted(pathlib.Path(path if equals else folder).rglob("*.*")):
            if file.suffix in (".msg", ".srv", ".action"):
                of = next(part for part in reversed(file.parent.parts) if part not in ("msg", "srv", "action"))
                yield package if equals else of, file


def owners(given):
    """Of PACKAGE:OTHER:NAME,...: {(package, name): other}"""
    return {(package, name): other for package, other, names in (one.split(":") for one in given) for name in names.split(",")}
