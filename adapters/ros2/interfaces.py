# SPDX-License-Identifier: Apache-2.0
"""Interfaces of ROS 2 as structs of C++: of every PACKAGE/{msg,srv,action}/NAME.{msg,srv,action} (or PACKAGE/NAME.msg) below the
folders a header OUT/PACKAGE/NAME.h (NAMEAction.h of an action), named as ROS 1 names it, so that what is written for one is
compiled for the other; and OUT/type_hashes.h, by which ROS 2 distinguishes definitions of one name.

    interfaces.py --out OUT [--as PACKAGE:OTHER:NAME,...] FOLDER... PACKAGE=FOLDER...

PACKAGE=FOLDER is ROS 1's layout, FOLDER/{msg,srv,action}. --as: these of a package are OTHER's on the wire."""

import argparse
import pathlib

from definitions import files, lines, owners, parts, read
from type_hashes import hashes

PRIMITIVES = {"bool": "std::uint8_t", "byte": "std::uint8_t", "char": "std::uint8_t", "float32": "float", "float64": "double",
              "string": "std::string",
              **{f"{sign}int{bits}": f"std::{sign}int{bits}_t" for sign in ("", "u") for bits in (8, 16, 32, 64)}}
STAMP = "builtin_interfaces/Time"
# What an action is on the wire, apart from its goal, result and feedback: (name, kind of the wire, fields).
OF_ACTION = [("SendGoalRequest", "SendGoal_Request_", "unique_identifier_msgs/UUID goal_id\n{0}Goal goal"),
             ("SendGoalResponse", "SendGoal_Response_", "bool accepted\nbuiltin_interfaces/Time stamp"),
             ("GetResultRequest", "GetResult_Request_", "unique_identifier_msgs/UUID goal_id"),
             ("GetResultResponse", "GetResult_Response_", "int8 status\n{0}Result result"),
             ("FeedbackMessage", "FeedbackMessage_", "unique_identifier_msgs/UUID goal_id\n{0}Feedback feedback")]


class Interface:
    """A struct to be: its fields as (type of C++, name), its constants as lines, what it includes."""

    def __init__(self, package, name, wire, text, place, of_file="/"):
        """of_file: how names begin that are in this very file"""
        self.package, self.name, self.wire, self.of_file = package, name, wire, of_file
        self.fields, self.constants, self.includes = [], [], set()
        for found in lines(text, place):
            self.add(*found)
        if not self.fields:  # ROS 2 sends one byte for nothing
            self.fields.append(("std::uint8_t", "structure_needs_at_least_one_member{}"))

    def type_of(self, kind):
        if kind in PRIMITIVES:
            return PRIMITIVES[kind]
        kind = "std_msgs/Header" if kind == "Header" else kind.replace("/msg/", "/")
        kind = kind if "/" in kind else f"{self.package}/{kind}"
        if kind == STAMP:
            self.includes.add("ros/time.h")
            return "::ros::Time"
        if not kind.startswith(f"{self.package}/{self.of_file}"):
            self.includes.add(f"{kind}.h")
        return "::" + kind.replace("/", "::")

    def add(self, kind, _, array, bound, count, name, value, default):
        of = self.type_of(kind)
        if value is not None:
            if of != "std::string":
                self.constants.append(f"static constexpr {of} {name} = {value.strip()};")
        elif not array:
            self.fields.append((of, f"{name}{{{default or ''}}}"))
        elif count and not bound:
            self.fields.append((f"std::array<{of}, {count}>", f"{name}{{}}"))
        else:
            self.fields.append((f"std::vector<{of}>", f"{name}{{}}"))

    def struct(self):
        lines = [f"struct {self.name} {{", f'    static constexpr const char* kType = "{self.wire}";']
        lines += [f"    {line}" for line in self.constants]
        lines += [f"    {of} {name};" for of, name in self.fields]
        lines += ["    template <class Self, class Visit>", "    static void visit(Self& self, Visit&& each) {"]
        lines += [f"        each(self.{name.partition('{')[0]});" for _, name in self.fields]
        return "\n".join(lines + ["    }", "};"])


def header(structs, more=""):
    package = structs[0].package
    includes = sorted(set().union(*(one.includes for one in structs)))
    return "\n".join(["#pragma once", "#include <array>", "#include <cstdint>", "#include <string>", "#include <vector>",
                      *(f"#include <{name}>" for name in includes), f"namespace {package} {{",
                      *(one.struct() for one in structs), more, "}", ""])


def action(package, name, wire, text, place):
    structs = [Interface(package, f"{name}{part}", f"{wire}_{part}_", body, place)
               for part, body in zip(("Goal", "Result", "Feedback"), parts(text))]
    structs += [Interface(package, f"{name}{part}", f"{wire}_{kind}", body.format(name), place, name)
                for part, kind, body in OF_ACTION]
    names = ("Goal", "Result", "Feedback", *(part for part, *_ in OF_ACTION))
    uses = "".join(f"    using {part} = {name}{part};\n" for part in names)
    return header(structs, f"struct {name}Action {{\n{uses}}};")


def table_of_hashes(found):
    rows = [f'    {{"{wire}", "{of}"}},' for wire, of in sorted(found.items())]
    return "\n".join(["#pragma once", "#include <string_view>", "#include <utility>", "namespace limpet::ros2 {",
                      "/// Of types on the wire, sorted.",
                      "inline constexpr std::pair<std::string_view, std::string_view> kTypeHashes[] = {", *rows, "};", "}", ""])


def write(to, text):
    to.parent.mkdir(parents=True, exist_ok=True)
    if not to.exists() or to.read_text() != text:
        to.write_text(text)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--as", dest="others", action="append", default=[])
    parser.add_argument("folders", nargs="+")
    given = parser.parse_args()
    others = owners(given.others)
    definitions = list(files(given.folders))
    for package, file in definitions:
        wire = f"{others.get((package, file.stem), package)}::{file.suffix[1:]}::dds_::{file.stem}"
        text = read(package, file)
        if file.suffix == ".msg":
            out = header([Interface(package, file.stem, f"{wire}_", text, file)])
        elif file.suffix == ".srv":
            out = header([Interface(package, f"{file.stem}{half}", f"{wire}_{half}_", part, file)
                          for half, part in zip(("Request", "Response"), parts(text))],
                         f"struct {file.stem} {{\n    using Request = {file.stem}Request;\n    using Response = "
                         f"{file.stem}Response;\n    Request request{{}};\n    Response response{{}};\n}};")
        else:
            out = action(package, file.stem, wire, text, file)
        write(given.out / package / f"{file.stem}{'Action' if file.suffix == '.action' else ''}.h", out)
    write(given.out / "type_hashes.h", table_of_hashes(hashes(definitions, others)))


if __name__ == "__main__":
    main()
