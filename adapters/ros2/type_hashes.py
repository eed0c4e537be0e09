# SPDX-License-Identifier: Apache-2.0
"""Hashes of types as REP 2011 has them (RIHS01): SHA-256 of a type's description, names of fields in it, comments, constants and
defaults not. By them ROS 2 distinguishes definitions of one name (`ros2 topic info --verbose`, a bag's metadata)."""

import hashlib
import json

from definitions import lines, parts, read

# The numbers of type_description_interfaces/FieldType; of arrays and sequences by an offset.
KINDS = {"int8": 2, "uint8": 3, "int16": 4, "uint16": 5, "int32": 6, "uint32": 7, "int64": 8, "uint64": 9, "float32": 10,
         "float64": 11, "char": 3, "bool": 15, "byte": 16, "string": 17}
NESTED, BOUNDED_STRING = 1, 21
ARRAY, BOUNDED_SEQUENCE, SEQUENCE = 48, 96, 144
# Here under another name.
SAME = {"EntityToSpawn": "SpawnEntity"}
UUID, TIME, EVENT_INFO = ("unique_identifier_msgs/msg/UUID", "builtin_interfaces/msg/Time", "service_msgs/msg/ServiceEventInfo")


def description(kind, name, capacity=0, offset=0, string_capacity=0):
    number = KINDS.get(kind, NESTED)
    number = BOUNDED_STRING if string_capacity else number
    nested = "" if kind in KINDS else kind
    return {"name": name, "type": {"type_id": number + offset, "capacity": capacity, "string_capacity": string_capacity,
                                   "nested_type_name": nested}}


def fields(package, text, place):
    """Descriptions of what a text defines. Names in lower case, as rosidl takes them."""
    found = []
    for kind, string_bound, array, bound, count, name, value, _ in lines(text, place):
        if value is None:
            if kind not in KINDS:
                kind = "std_msgs/Header" if kind == "Header" else SAME.get(kind, kind).replace("/msg/", "/")
                of, _, kind = kind.rpartition("/")
                kind = f"{of or package}/msg/{kind}"
            offset = 0 if not array else SEQUENCE if not count else BOUNDED_SEQUENCE if bound else ARRAY
            found.append(description(kind, name.lower(), int(count or 0), offset, int((string_bound or "<=0")[2:])))
    return found


class Types:
    """Descriptions of types by their names (package/msg/Name)."""

    def __init__(self):
        self.fields = {}

    def add(self, name, fields):
        """fields: of description(); ROS 2 sends one byte for none"""
        self.fields[name] = fields or [description("uint8", "structure_needs_at_least_one_member")]

    def add_service(self, name, request, response):
        self.add(f"{name}_Request", request)
        self.add(f"{name}_Response", response)
        self.add(f"{name}_Event", [description(EVENT_INFO, "info"),
                                   description(f"{name}_Request", "request", 1, BOUNDED_SEQUENCE),
                                   description(f"{name}_Response", "response", 1, BOUNDED_SEQUENCE)])
        self.add(name, [description(f"{name}_{half.title()}", f"{half}_message") for half in ("request", "response", "event")])

    def add_action(self, name, goal, result, feedback):
        for part, fields in (("Goal", goal), ("Result", result), ("Feedback", feedback)):
            self.add(f"{name}_{part}", fields)
        goal_id = description(UUID, "goal_id")
        self.add_service(f"{name}_SendGoal", [goal_id, description(f"{name}_Goal", "goal")],
                         [description("bool", "accepted"), description(TIME, "stamp")])
        self.add_service(f"{name}_GetResult", [goal_id],
                         [description("int8", "status"), description(f"{name}_Result", "result")])
        self.add(f"{name}_FeedbackMessage", [goal_id, description(f"{name}_Feedback", "feedback")])

    def hash(self, name):
        """What `name` is made of is known, else KeyError."""
        used, left = set(), [name]
        while left:
            for field in self.fields[left.pop()]:
                nested = field["type"]["nested_type_name"]
                if nested and nested not in used:
                    used.add(nested)
                    left.append(nested)
        descriptions = [{"type_name": one, "fields": self.fields[one]} for one in [name, *sorted(used)]]
        whole = json.dumps({"type_description": descriptions[0], "referenced_type_descriptions": descriptions[1:]})
        return "RIHS01_" + hashlib.sha256(whole.encode()).hexdigest()


def hashes(files, others):
    """Of (package, file)s by the names of their types on the wire: {"std_msgs::msg::dds_::String_": "RIHS01_..."}. Both halves of a
    service have the service's."""
    types, on_wire = Types(), {}
    for package, file in files:
        kind, stem = file.suffix[1:], file.stem
        text = read(package, file)
        package = others.get((package, stem), package)
        made = [fields(package, part, file) for part in parts(text)]
        name, wire = f"{package}/{kind}/{SAME.get(stem, stem)}", f"{package}::{kind}::dds_::{stem}"
        halves = {"srv": [""], "action": ["_SendGoal", "_GetResult"]}.get(kind, [])
        if kind == "msg":
            types.add(name, made[0])
            on_wire[f"{wire}_"] = name
        elif kind == "srv":
            types.add_service(name, *made)
        else:
            types.add_action(name, *made)
            on_wire[f"{wire}_FeedbackMessage_"] = f"{name}_FeedbackMessage"
        on_wire.update({f"{wire}{part}_{half}_": f"{name}{part}" for part in halves for half in ("Request", "Response")})
    return {wire: types.hash(name) for wire, name in on_wire.items()}
