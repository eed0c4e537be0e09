# SPDX-License-Identifier: Apache-2.0
"""What docs/design.md promises of the modules: a page each, a size, arrows that run down."""

import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODULES = {folder.name: folder for folder in sorted((ROOT / "limpet").iterdir()) if folder.is_dir()}
MOST_LINES = 4000
PAGE_LINES = 20
# A header of core's kind that lies with the bodies it speaks of: plant.hpp needs core alone.
GRANTED = {("sensors", "plant/plant.hpp")}


def sources(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".cpp", ".hpp"))


def links(module):
    """The modules that its CMakeLists.txt names."""
    text = re.sub(r"#.*", "", (MODULES[module] / "CMakeLists.txt").read_text())
    return set(re.findall(r"limpet::(\w+)", text)) & set(MODULES) - {module}


def below(module, seen=None):
    seen = set() if seen is None else seen
    for other in links(module) - seen:
        seen.add(other)
        below(other, seen)
    return seen


class Architecture(unittest.TestCase):
    def test_every_module_opens_with_a_page(self):
        for folder in [*MODULES.values(), ROOT / "adapters/cli", ROOT / "adapters/gazebo", ROOT / "adapters/ros", ROOT / "adapters/ros2"]:
            with self.subTest(folder.name):
                page = (folder / "README.md").read_text()
                if folder.parent == ROOT / "limpet":
                    self.assertLess(page.count("\n"), PAGE_LINES)
                    self.assertIn("**Uses:**", page)
                    self.assertIn("**Start reading:**", page)
                for name in re.findall(r"`([\w/]+\.[ch]pp)`", page) + re.findall(r"\]\(([^)#:]+)\)", page):
                    self.assertTrue((folder / name).exists(), f"{name} is not there")

    def test_no_module_is_two(self):
        for name, folder in MODULES.items():
            with self.subTest(name):
                lines = sum(len(path.read_text().splitlines()) for path in sources(folder))
                self.assertLess(lines, MOST_LINES)

    def test_every_arrow_runs_down(self):
        for module, folder in MODULES.items():
            self.assertNotIn(module, below(module), "a circle")
            may = below(module) | {module}
            for path in sources(folder):
                for header in re.findall(r'#include "limpet/(\w+/[\w/]+\.hpp)"', path.read_text()):
                    if (module, header) not in GRANTED:
                        with self.subTest(path.relative_to(ROOT)):
                            self.assertIn(header.split("/")[0], may, f"{header}: its module is not in LINKS")

    def test_a_module_is_its_namespace(self):
        for module, folder in MODULES.items():
            name = "limpet" if module in ("core", "face") else f"limpet::{module}"
            for path in sources(folder):
                for opened in re.findall(r"^namespace (limpet\S*) \{", path.read_text(), re.M):
                    if (module, opened) == ("sensors", "limpet::plant"):
                        continue  # what it is granted above
                    with self.subTest(path.relative_to(ROOT)):
                        self.assertTrue(f"{opened}::".startswith(f"{name}::"), opened)

    def test_documents_name_sources_that_are_there(self):
        tops = ("limpet", "adapters", "tests", "docs/examples")
        there = [f"/{path.relative_to(ROOT)}" for top in tops for path in sources(ROOT / top)]
        pages = [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md"), *(ROOT / "docs/decisions").glob("*.md"),
                 ROOT / "adapters/ros/README.md"]
        for page in pages:
            for name in set(re.findall(r"`([\w/]+\.[ch]pp)`", page.read_text())):
                if "NAME" not in name:
                    with self.subTest(f"{page.relative_to(ROOT)}: {name}"):
                        self.assertTrue(any(path.endswith(f"/{name}") for path in there), "no such file")

    def test_the_models_page_names_tests_that_are_there(self):
        there = set()
        for top in ("tests", "adapters/gazebo/tests", "adapters/ros/test", "adapters/ros2/test"):
            for path in (ROOT / top).rglob("*.cpp"):
                there |= set(re.findall(r"^TEST(?:_[FP])?\(\s*(\w+),\s*(\w+)\)", path.read_text(), re.M))
        suites = {suite for suite, _ in there}
        page = (ROOT / "docs/models.md").read_text()
        for suite, name in set(re.findall(r"`([A-Z]\w+)\.(\w+|\*)`", page)) - {("Suite", "Name")}:
            with self.subTest(f"{suite}.{name}"):
                self.assertTrue((suite, name) in there if name != "*" else suite in suites, "no such test")

    def test_the_readme_is_short(self):
        shown = re.sub(r"<!--.*?-->", "", (ROOT / "README.md").read_text())  # what a reader sees, bars of tables aside
        self.assertLessEqual(len([word for word in shown.split() if re.search(r"\w", word)]), 500, "words")

    def test_the_version_stands_in_one_place_and_others_say_the_same(self):
        version = re.search(r'kVersion = "([\d.]+)"', (ROOT / "limpet/core/version.hpp").read_text())[1]
        minor = version.rsplit(".", 1)[0]
        for file, said in (("docs/CITATION.cff", f"\nversion: {version}\n"), ("docs/CHANGELOG.md", f"\n## {version}"),
                           ("adapters/ros/package.xml", f"<version>{version}</version>"), ("adapters/ros/CMakeLists.txt", f"VERSION {version} "),
                           ("docs/examples/CMakeLists.txt", f"find_package(limpet {minor} "), ("docs/install.md", f"`liblimpet{minor}`")):
            with self.subTest(file):
                self.assertIn(said, (ROOT / file).read_text())

    def test_the_log_of_changes_is_by_release_and_area(self):
        releases = re.split(r"^## ", (ROOT / "docs/CHANGELOG.md").read_text(), flags=re.M)[1:]
        newest = releases[0]
        self.assertIn("> **What breaks", newest)
        before, *areas = re.split(r"^### ", newest, flags=re.M)
        self.assertNotRegex(before, r"(?m)^- ", "an entry without an area")
        self.assertEqual([area.split("\n")[0] for area in areas],
                         ["Command line", "Flights and physics", "Campaigns, studies and the paper", "Files and readers",
                          "PX4, MAVLink and the companion", "Gazebo and ROS", "C++ and Python", "Pages and pictures",
                          "Packages and building"])

    def test_the_examples_of_growth_still_apply(self):
        diffs = sorted((ROOT / "docs/extending").glob("*.diff"))
        self.assertEqual([diff.stem for diff in diffs],
                         ["autopilot", "engine", "pressure_model", "sensor", "verb"])
        for diff in diffs:
            with self.subTest(diff.name):
                tried = subprocess.run(["git", "apply", "--check", diff], cwd=ROOT, capture_output=True, text=True)
                self.assertEqual(tried.returncode, 0, tried.stderr)

    def test_a_test_that_is_gone_is_seen(self):
        """tests/count fails where a module has more tests or fewer than tests/counts.txt says, or is not there."""
        counts = [line.split() for line in (ROOT / "tests/counts.txt").read_text().splitlines() if not line.startswith("all ")]
        whole = [f"  Test #{k}: {module}.T{k}" for module, count in counts for k in range(int(count))]
        for listed, code in ((whole, 0), (whole[1:], 1), (whole + ["  Test #9: core.Another"], 1), ([], 1)):
            with self.subTest(len(listed)), tempfile.NamedTemporaryFile("w") as file:
                file.write("\n".join(listed) + "\n")
                file.flush()
                counted = subprocess.run([ROOT / "tests/count", "--of", file.name], capture_output=True, text=True)
                self.assertEqual(counted.returncode, code, counted.stderr)
                self.assertEqual("tests/count --write" in counted.stderr, code == 1)


if __name__ == "__main__":
    unittest.main()
