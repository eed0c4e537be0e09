# SPDX-License-Identifier: Apache-2.0
"""What the house promises of its rooms (docs/design.md): a page each, a size, arrows that run down."""

import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
ROOMS = {folder.name: folder for folder in sorted((ROOT / "limpet").iterdir()) if folder.is_dir()}
MOST_LINES = 3500
PAGE_LINES = 20
# A header of core's kind that lies with the bodies it speaks of: plant.hpp needs core alone.
GRANTED = {("sensors", "plant/plant.hpp")}


# What cites pages: sources, data and pages themselves; not what others wrote, nor what has been.
CITING = (".cpp", ".hpp", ".py", ".yaml", ".json", ".xml", ".md", ".ts", ".cmake", ".txt")
# "facts.md section 3"; 'px4.md "Offboard" and "Perched"', quotes escaped in a string of C++.
CITED = re.compile(r'([\w./-]*\w\.md)((?:,? section \d+)|(?:,? (?:and )?\\?"[^"\\]+\\?")+)?')


def tracked(*suffixes):
    names = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    return [ROOT / name for name in names.split("\0") if name.endswith(suffixes) and (ROOT / name).is_file()]


def running_text(text):
    """A citation may be broken over lines of a comment, of a table's text or of YAML."""
    return re.sub(r"\n\s*(?:///?<?|\*|#)?\s*", " ", re.sub(r'"\n\s*"', "", text))


def cited_pages(name, origin):
    """A path from the root or, on a page, from there; a bare name is a page of docs/reference, else of docs."""
    near = [origin.parent / name] if origin.suffix == ".md" else []
    bare = [ROOT / "docs/reference" / name, ROOT / "docs" / name] if "/" not in name else []
    return [page for page in (*bare, ROOT / name, *near) if page.is_file()]


def headings(page):
    return re.findall(r"^#+ (.+)$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), re.M)


def sources(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".cpp", ".hpp"))


def links(room):
    """The rooms that its CMakeLists.txt names."""
    text = re.sub(r"#.*", "", (ROOMS[room] / "CMakeLists.txt").read_text())
    return set(re.findall(r"limpet::(\w+)", text)) & set(ROOMS) - {room}


def below(room, seen=None):
    seen = set() if seen is None else seen
    for other in links(room) - seen:
        seen.add(other)
        below(other, seen)
    return seen


class House(unittest.TestCase):
    def test_every_room_opens_with_a_page(self):
        for folder in [*ROOMS.values(), ROOT / "apps/limpet", ROOT / "gazebo", ROOT / "ros", ROOT / "ros2"]:
            with self.subTest(folder.name):
                page = (folder / "README.md").read_text()
                if folder.parent == ROOT / "limpet":
                    self.assertLess(page.count("\n"), PAGE_LINES)
                    self.assertIn("**Uses:**", page)
                    self.assertIn("**Start reading:**", page)
                for name in re.findall(r"`([\w/]+\.[ch]pp)`", page) + re.findall(r"\]\(([^)#:]+)\)", page):
                    self.assertTrue((folder / name).exists(), f"{name} is not there")

    def test_a_modules_page_names_what_it_links(self):
        for room, folder in ROOMS.items():
            if room == "face":
                continue  # "simulation and what it links"
            page = (folder / "README.md").read_text()
            used = re.sub(r"\([^)]*\)", "", re.search(r"\*\*Uses:\*\*(.*?)\n\n", page, re.S)[1])
            named = set(re.findall(r"\w+", used)) & set(ROOMS)
            with self.subTest(room):
                self.assertEqual(sorted(named), sorted(links(room)))

    def test_every_citation_is_there(self):
        for origin in tracked(*CITING):
            place = origin.relative_to(ROOT)
            if place.name in ("CHANGELOG.md", pathlib.Path(__file__).name, "mentions_test.py") or "corpus" in place.parts:
                continue
            for name, what in CITED.findall(running_text(origin.read_text())):
                if name.startswith(("http", "/")) or "NAME" in name:
                    continue
                with self.subTest(f"{place}: {name}{what}"):
                    pages = cited_pages(name, origin)
                    self.assertTrue(pages or origin.suffix == ".md", "no such page")
                    self.assertTrue(what or len(pages) < 2 or origin.suffix == ".md" or name == "README.md", f"which of {pages}? say its heading")
                    known = [heading for page in pages[:1] for heading in headings(page)]
                    for number in re.findall(r"section (\d+)", what):
                        self.assertTrue(any(known_as.startswith(f"{number}. ") for known_as in known), "no such section")
                    for heading in re.findall(r'"([^"\\]+)\\?"', what):
                        self.assertIn(heading, known)

    def test_a_fault_of_ours_is_no_answer(self):
        """InternalError is caught where it becomes a run's outcome, or another error, and nowhere else."""
        may = {"limpet/campaign/workers.cpp", "limpet/campaign/px4_crew.cpp", "limpet/lab/learn.cpp",  # outcome `fault`
               "limpet/draw/stage.cpp"}  # MuJoCo's: what to install
        catching = {str(path.relative_to(ROOT)) for path in tracked(".cpp", ".hpp")
                    if path.parts[len(ROOT.parts)] in ("limpet", "apps", "python")
                    and re.search(r"catch \((const )?InternalError", path.read_text())}
        self.assertEqual(catching, may)

    def test_no_table_is_cut_in_two(self):
        for page in tracked(".md"):
            lines = page.read_text().split("\n")
            for number in range(2, len(lines)):
                row = lines[number].startswith("|") and not lines[number - 1]
                head = number + 1 < len(lines) and re.match(r"\|[-| :]+\|$", lines[number + 1])
                with self.subTest(f"{page.relative_to(ROOT)}:{number + 1}"):
                    self.assertFalse(row and not head, "a row of no table")

    def test_no_room_is_two(self):
        for name, folder in ROOMS.items():
            with self.subTest(name):
                lines = sum(len(path.read_text().splitlines()) for path in sources(folder))
                self.assertLess(lines, MOST_LINES)

    def test_every_arrow_runs_down(self):
        for room, folder in ROOMS.items():
            self.assertNotIn(room, below(room), "a circle")
            may = below(room) | {room}
            for path in sources(folder):
                for header in re.findall(r'#include "limpet/(\w+/[\w/]+\.hpp)"', path.read_text()):
                    if (room, header) not in GRANTED:
                        with self.subTest(path.relative_to(ROOT)):
                            self.assertIn(header.split("/")[0], may, f"{header}: its room is not in LINKS")

    def test_a_room_is_its_namespace(self):
        for room, folder in ROOMS.items():
            name = "limpet" if room in ("core", "face") else f"limpet::{room}"
            for path in sources(folder):
                for opened in re.findall(r"^namespace (limpet\S*) \{", path.read_text(), re.M):
                    if (room, opened) == ("sensors", "limpet::plant"):
                        continue  # what it is granted above
                    with self.subTest(path.relative_to(ROOT)):
                        self.assertTrue(f"{opened}::".startswith(f"{name}::"), opened)

    def test_documents_name_sources_that_are_there(self):
        tops = ("limpet", "apps", "gazebo", "ros", "ros2", "tests", "bench", "examples")
        there = [f"/{path.relative_to(ROOT)}" for top in tops for path in sources(ROOT / top)]
        pages = [*ROOT.glob("*.md"), *(ROOT / "docs").glob("*.md"), *(ROOT / "docs/decisions").glob("*.md"),
                 ROOT / "ros/README.md"]
        for page in pages:
            for name in set(re.findall(r"`([\w/]+\.[ch]pp)`", page.read_text())):
                if "NAME" not in name:
                    with self.subTest(f"{page.relative_to(ROOT)}: {name}"):
                        self.assertTrue(any(path.endswith(f"/{name}") for path in there), "no such file")

    def test_the_models_page_names_tests_that_are_there(self):
        there = set()
        for top in ("tests", "gazebo/tests", "ros/test", "ros2/test"):
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
        for file, said in (("CITATION.cff", f"\nversion: {version}\n"), ("CHANGELOG.md", f"\n## {version}"),
                           ("ros/package.xml", f"<version>{version}</version>"), ("ros/CMakeLists.txt", f"VERSION {version} "),
                           ("examples/CMakeLists.txt", f"find_package(limpet {minor} "), ("docs/install.md", f"`liblimpet{minor}`")):
            with self.subTest(file):
                self.assertIn(said, (ROOT / file).read_text())

    def test_the_log_of_changes_is_by_release_and_area(self):
        releases = re.split(r"^## ", (ROOT / "CHANGELOG.md").read_text(), flags=re.M)[1:]
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
