# SPDX-License-Identifier: Apache-2.0
"""The nose meets the wall again and again, and where it is level with the centre of mass its spring calms the pitch."""
import sys

sys.path.insert(0, sys.argv[1] + "/docs/examples/python")
import touch_and_go as example

rows = example.compare(1)
print(rows)
assert all(touches[0] >= 1 for row in rows for touches in row[3:])
assert rows[1][1] < 0.9 * rows[1][2], "a spring does not calm it"
