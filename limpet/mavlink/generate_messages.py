#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes C++ of messages.xml: generate_messages.py messages.xml message_structs.hpp

A message becomes a struct with the fields as the XML lists them, and a list of them in the order of
the wire. There larger elements come first and equal ones keep their order; extensions follow as they
are. CRC_EXTRA is a checksum of the name and of the ordered fields' types and names, extensions left
out: two ends that disagree on a message refuse each other's.
Source: MAVLink serialization guide, "Field Reordering" and "CRC_EXTRA Calculation"
"""
import re
import sys
from xml.parsers import expat

# An element's parts, the attributes that it must have, those that it may have.
ELEMENTS = {
    "mavlink": ({"enums", "messages"}, set(), set()),
    "enums": ({"enum"}, set(), set()),
    "enum": ({"entry"}, {"name"}, set()),
    "entry": (set(), {"value", "name"}, set()),
    "messages": ({"message"}, set(), set()),
    "message": ({"description", "field", "extensions"}, {"id", "name"}, set()),
    "description": (set(), set(), set()),
    "extensions": (set(), set(), set()),
    "field": (set(), {"type", "name"}, {"enum", "units"}),
}
ELEMENT_BYTES = {"char": 1, "float": 4, "double": 8}
ELEMENT_BYTES.update({f"{sign}int{8 * n}_t": n for sign in ("", "u") for n in (1, 2, 4, 8)})
# Where the rule, HIL_GPS is HilGps, gives no good name.
STRUCT_NAMES = {"EVENT": "EventMessage", "STATUSTEXT": "StatusText", "TIMESYNC": "TimeSync"}

# Where an enumeration's entries do not begin with its name.
ENTRY_PREFIXES = {"MAV_COMPONENT": "MAV_COMP_ID_", "HIL_SENSOR_UPDATED_FLAGS": "HIL_SENSOR_UPDATED_"}


class Refused(Exception):
    """What is wrong with the XML, with file:line."""


class Node:
    """An element, where it stands and what it holds."""

    def __init__(self, tag, attributes, place):
        self.tag, self.attributes, self.place = tag, attributes, place
        self.children, self.text = [], ""

    def all(self, tag):
        return [child for child in self.children if child.tag == tag]

    def __getitem__(self, attribute):
        return self.attributes.get(attribute, "")

    def number(self, attribute, most):
        if not re.fullmatch("0|[1-9][0-9]*", self[attribute]) or int(self[attribute]) > most:
            self.refuse(f"{attribute} = '{self[attribute]}', must be a whole number up to {most}")
        return int(self[attribute])

    def refuse(self, why):
        raise Refused(f"{self.place}: {self.tag} {self['name']}: {why}")


def read(path):
    """The document's root, of known elements with the attributes they must have."""
    top = Node("", {}, path)
    open_nodes = [top]
    parser = expat.ParserCreate()

    def start(tag, attributes):
        node = Node(tag, attributes, f"{path}:{parser.CurrentLineNumber}")
        parts = ELEMENTS[open_nodes[-1].tag][0] if open_nodes[-1].tag else {"mavlink"}
        if tag not in parts:
            node.refuse("is not known here")
        _, needed, allowed = ELEMENTS[tag]
        for name in needed - attributes.keys():
            node.refuse(f"attribute {name} is missing")
        for name in attributes.keys() - needed - allowed:
            node.refuse(f"attribute {name} is not known")
        open_nodes[-1].children.append(node)
        open_nodes.append(node)

    def character_data(text):
        open_nodes[-1].text += text

    parser.StartElementHandler = start
    parser.EndElementHandler = lambda tag: open_nodes.pop()
    parser.CharacterDataHandler = character_data
    with open(path, "rb") as file:
        try:
            parser.ParseFile(file)
        except expat.ExpatError as error:
            raise Refused(f"{path}:{error.lineno}: {expat.ErrorString(error.code)}") from None
    return top.children[0]


def check_once(nodes, attribute="name"):
    seen = set()
    for node in nodes:
        if node[attribute] in seen:
            node.refuse(f"{attribute} {node[attribute]} stands twice")
        seen.add(node[attribute])


class Field:
    def __init__(self, node, is_extension):
        parts = re.fullmatch(r"(\w+)(?:\[([1-9][0-9]*)\])?", node["type"])
        if not parts or parts[1] not in ELEMENT_BYTES:
            node.refuse(f"type {node['type']} is not known")
        self.name, self.element, self.is_extension = node["name"], parts[1], is_extension
        self.length = int(parts[2]) if parts[2] else None
        self.element_bytes = ELEMENT_BYTES[self.element]
        self.bytes = self.element_bytes * (self.length or 1)
        unit = f"[{node['units']}]" if node["units"] else ""
        text = " ".join([*node.text.split(), unit]).strip()
        self.comment = ", ".join(filter(None, [text, node["enum"]]))

    def member(self):
        cpp = f"std::{self.element}" if "int" in self.element else self.element
        array = f"std::array<{cpp}, {self.length}> {self.name} = {{}};"
        text = array if self.length else f"{cpp} {self.name} = 0;"
        return text + (f"  ///< {self.comment}" if self.comment else "")


def crc_extra(name, ordered):
    data = f"{name} ".encode()
    for field in ordered:
        data += f"{field.element} {field.name} ".encode()
        data += bytes([field.length] if field.length else [])
    crc = 0xFFFF  # CRC-16/MCRF4XX, as frames have it
    for byte in data:
        crc ^= byte
        for _ in range(8):
            crc = crc >> 1 ^ (0x8408 if crc & 1 else 0)
    return crc & 0xFF ^ crc >> 8


def struct_name(name):
    return STRUCT_NAMES.get(name, name.title().replace("_", ""))


def message_text(node):
    check_once(node.all("field"))
    fields, extended = [], False
    for child in node.children:
        extended = extended or child.tag == "extensions"
        if child.tag == "field":
            fields.append(Field(child, extended))
    base = sorted((f for f in fields if not f.is_extension), key=lambda f: -f.element_bytes)
    ordered = base + [f for f in fields if f.is_extension]
    size = sum(f.bytes for f in ordered)
    if not 0 < size <= 255:
        node.refuse(f"{size} bytes, must be 1 to 255")
    name, struct = node["name"], struct_name(node["name"])
    info = f"kId, kName, {crc_extra(name, base)}, {size}, {sum(f.bytes for f in base)}"
    lines = ["/// " + " ".join(line.text.split()) for line in node.all("description")]
    lines += [f"struct {struct} {{",
              f"    static constexpr std::uint32_t kId = {node['id']};",
              f'    static constexpr std::string_view kName = "{name}";',
              f"    static constexpr MessageInfo kInfo = {{{info}}};"]
    lines += [f"    {field.member()}" for field in fields]
    listed = ", ".join(f'Field{{"{f.name}", &{struct}::{f.name}}}' for f in ordered)
    lines += ["    /// In the order of the wire.",
              "    [[nodiscard]] static constexpr auto fields() {",
              f"        return std::tuple({listed});",
              "    }",
              "};"]
    return "\n".join(lines) + "\n"


def entry_name(name, prefix):
    """What follows the prefix; where that begins with a digit, the prefix's last word before it."""
    left = name[len(prefix):].lower()
    return prefix.lower().split("_")[-2] + "_" + left if left[:1].isdigit() else left


def enum_text(node):
    entries = node.all("entry")
    check_once(entries)
    check_once(entries, "value")
    prefix = ENTRY_PREFIXES.get(node["name"], node["name"] + "_")
    for entry in entries:
        if not entry["name"].startswith(prefix):
            entry.refuse(f"must begin with {prefix}")
    most = max((entry.number("value", 2**32 - 1) for entry in entries), default=0)
    bits = next(bits for bits in (8, 16, 32) if most < 2**bits)
    values = [f"{entry_name(entry['name'], prefix)} = {entry['value']}" for entry in entries]
    return (f"struct {struct_name(node['name'])} {{\n"
            f"    enum Value : std::uint{bits}_t {{ {', '.join(values)} }};\n}};\n")


def header_text(source, root):
    enums = [enum for part in root.all("enums") for enum in part.children]
    messages = [message for part in root.all("messages") for message in part.children]
    check_once(enums + messages)
    check_once(messages, "id")
    messages.sort(key=lambda message: message.number("id", 2**24 - 1))
    names = ", ".join(struct_name(message["name"]) for message in messages)
    return "\n".join([
        f"// Made of {source} by generate_messages.py; changes here are lost.",
        '#pragma once\n\n#include "limpet/mavlink/field.hpp"\n\nnamespace limpet::mavlink {\n',
        *map(enum_text, enums), *map(message_text, messages),
        f"/// By rising id.\nusing AllMessages = std::tuple<{names}>;\n",
        "}  // namespace limpet::mavlink\n"])


def main(source, header):
    try:
        text = header_text(source, read(source))
    except Refused as refused:
        sys.exit(str(refused))
    with open(header, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
