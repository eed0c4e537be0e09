#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""packages_test.py PACKAGES TYPE_HASHES: the packages of our interfaces hold what our endpoints publish: read back, their types have
the hashes of TYPE_HASHES (type_hashes.h), and no name is one that rosidl refuses."""

import pathlib
import re
import sys

ROS2 = pathlib.Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROS2))
from definitions import files, lines, parts  # noqa: E402
from type_hashes import hashes  # noqa: E402

packages, table = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
published = dict(re.findall(r'\{"(\S+)", "(RIHS01_[0-9a-f]{64})"\}', table.read_text()))
ours = list(files(f"{package}={packages / package}" for package in ("limpet_msgs", "limpet_ros")))
of_others = [(package, file) for package, file in files(map(str, (ROS2 / "interfaces", ROS2.parents[1] / "limpet/record/msg")))
             if package != "limpet_msgs"]
read = {wire: of for wire, of in hashes(ours + of_others, {}).items() if wire.startswith("limpet_")}
wanted = {wire: of for wire, of in published.items() if wire.startswith("limpet_")}
assert read == wanted, sorted(set(read.items()) ^ set(wanted.items()))
assert {"limpet_ros::msg::dds_::PerchingStatus_", "limpet_ros::action::dds_::Perching_SendGoal_Request_",
        "limpet_msgs::msg::dds_::CupState_"} <= set(read), sorted(read)
for package, file in ours:
    for part in parts(file.read_text()):
        for *_, name, value, _ in lines(part, file):
            takes = r"[A-Z]([A-Z0-9_]*[A-Z0-9])?" if value is not None else r"[a-z](_?[a-z0-9]+)*"
            assert re.fullmatch(takes, name), f"{file}: {name}"
    assert f'"{file.parent.name}/{file.name}"' in (packages / package / "CMakeLists.txt").read_text(), file
print(f"{len(read)} types of {len(ours)} definitions")
