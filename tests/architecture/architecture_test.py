# SPDX-License-Identifier: Apache-2.0
"""What docs/design.md promises of the modules: a page each, a size, arrows that run down."""

import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODULES = {folder.name: folder for folder in sorted((ROOT / "limpet").iterdir()) if folder.is_dir()}
MOST_LINES = 3600
PAGE_LINES = 20
MOST_ENTRIES = 16  # of the repository's top, as `ls` shows it
# A header of core's kind that lies with the bodies it speaks of: plant.hpp needs core alone.
GRANTED = {("sensors", "plant/plant.hpp")}


# What cites pages: sources, data and pages themselves; not what others wrote, nor what has been.
CITING = (".cpp", ".hpp", ".py", ".yaml", ".json", ".xml", ".md", ".ts", ".cmake", ".txt")
# "facts.md section 3"; 'px4.md "Offboard" and "Perched"', quotes escaped in a string of C++.
CITED = re.compile(r'([\w./-]*\w\.md)((?:,? section \d+)|(?:,? (?:and )?\\?"[^"\\]+\\?")+)?')


def running_text(text):
    """A citation may be broken over lines of a comment, of a table's text or of YAML."""
    return re.sub(r"\n\s*(?:///?<?|\*|#)?\s*", " ", re.sub(r'"\n\s*"', "", text))


def cited_pages(name, origin):
    """A path from the root or, on a page, from there; a bare name is a page of docs/reference, else of docs."""
    near = [origin.parent / name] if origin.suffix == ".md" else []
    bare = [ROOT / "docs/reference" / name, ROOT / "docs" / name] if "/" not in name else []
    return [page for page in (*bare, ROOT / name, ROOT / "data" / name, *near) if page.is_file()]


def headings(page):
    return re.findall(r"^#+ (.+)$", re.sub(r"^```.*?^```", "", page.read_text(), flags=re.M | re.S), re.M)


SOURCE = re.compile(r"\b(assumed|recalled|paper|derived|fitted|convention|decision|here|facts\.md|baseline\.md|physics\.md|px4\.md|PX4|EKF2_\w+|IMU_\w+|"
                    r"Gazebo|Iris|MAVLink|Motive|sheet|TFmini Plus|MS5803|OptiTrack|R&M|MIL-F-\w+|MIL-STD\w*|ICAO|ISO|WMO|Schmalz|arXiv|doi|"
                    r"vehicle file|legs and cup|by geometry|all in one plane|none is in another's wake|as \w+|\w+\.hpp)")


def parameter_rows():
    """[(key, default, source)] of docs/parameters.md, which a test of apps holds against the program."""
    rows = [[cell.strip() for cell in line.split("|")] for line in (ROOT / "docs/parameters.md").read_text().splitlines() if line.startswith("| `")]
    return [(cells[1].strip("`"), cells[2], cells[6]) for cells in rows if len(cells) == 8]


def stands_in(value, text):
    """To three digits, in SI or in one of the units of a page: mm, hPa, kN, per cent, minutes."""
    numbers = {float(number) for number in re.findall(r"(?<![\w.])-?\d*\.?\d+(?:e-?\d+)?", text)}
    return any(abs(number * unit - value) <= 1e-3 * abs(value) for number in numbers for unit in (1, 1e3, 1e-3, 100, 0.01, 60, 0.1, 0.0174533))


def sources(folder):
    return sorted(path for path in folder.rglob("*") if path.suffix in (".cpp", ".hpp"))


def tracked():
    """Paths of the repository's files; of an unpacked archive those that nothing has built or flown."""
    listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True)
    if listed.returncode == 0:
        return [name for name in map(os.fsdecode, listed.stdout.split(b"\0")) if name and (ROOT / name).exists()]
    return [str(path.relative_to(ROOT)) for path in ROOT.rglob("*")
            if path.is_file() and path.relative_to(ROOT).parts[0] not in ("build", "out")]


def files(*suffixes):
    return [ROOT / name for name in tracked() if name.endswith(suffixes) and (ROOT / name).is_file()]


def tables(text, level):
    """First cell of each row under each heading of a level: [(heading, cell)]. A heading is its first word."""
    found, heading = [], None
    for line in text.split("\n"):
        if re.match(rf"#{{1,{level}}} ", line):
            heading = re.match(r"#+ (\w+)", line)[1] if line.startswith("#" * level + " ") else None
        cell = re.match(r"\| \[?([\w/]+)[\]| ]", line)
        if heading and cell and cell[1] not in ("module", "adapter", "folder"):
            found.append((heading, cell[1]))
    return found


def lines_of(path):
    files = [path] if path.is_file() else [file for file in path.rglob("*") if file.suffix in (".cpp", ".hpp", ".h")]
    return sum(len(file.read_text().splitlines()) for file in files)


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
        adapters = sorted(folder for folder in (ROOT / "adapters").iterdir() if folder.is_dir())
        listed = re.findall(r"^\| \[(\w+)\]", (ROOT / "adapters/README.md").read_text(), re.M)
        self.assertEqual(sorted(listed), [folder.name for folder in adapters], "adapters/README.md: each once")
        for folder in [*MODULES.values(), ROOT / "apps/limpet", *adapters]:
            with self.subTest(folder.name):
                page = (folder / "README.md").read_text()
                if folder.parent == ROOT / "limpet":
                    self.assertLess(page.count("\n"), PAGE_LINES)
                    self.assertIn("**Uses:**", page)
                    self.assertIn("**Start reading:**", page)
                for name in re.findall(r"`([\w/]+\.[ch]pp)`", page) + re.findall(r"\]\(([^)#:]+)\)", page):
                    self.assertTrue((folder / name).exists(), f"{name} is not there")

    def test_a_modules_page_names_what_it_links(self):
        for module, folder in MODULES.items():
            if module == "face":
                continue  # "simulation and what it links"
            page = (folder / "README.md").read_text()
            used = re.sub(r"\([^)]*\)", "", re.search(r"\*\*Uses:\*\*(.*?)\n\n", page, re.S)[1])
            named = set(re.findall(r"\w+", used)) & set(MODULES)
            with self.subTest(module):
                self.assertEqual(sorted(named), sorted(links(module)))

    def test_every_citation_is_there(self):
        for origin in files(*CITING):
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

    def test_every_parameter_has_a_source(self):
        """A page with its section, a paper, a data sheet, a program that can be had; else the word is "assumed" or "recalled"."""
        for key, _, source in parameter_rows():
            with self.subTest(f"{key}: {source}"):
                self.assertRegex(source, SOURCE)
                for number in re.findall(r"decision (\d{4})", source):
                    self.assertTrue(list((ROOT / "docs/decisions").glob(f"{number}-*.md")), "no such decision")

    def test_a_cited_number_stands_on_its_page(self):
        """Who cites a page of docs/reference for a parameter finds its default there, in some unit; a switch or an effect that is off has none."""
        for key, value, source in parameter_rows():
            for page, number, item in re.findall(r"\b(facts\.md|baseline\.md|physics\.md)(?: section (\d+)| item (\d+))?", source):
                text = (ROOT / "docs/reference" / page).read_text()
                if number:
                    text = re.search(rf"^## {number}\. .*?(?=^## |\Z)", text, re.M | re.S)[0]
                if item:
                    text = "\n".join(re.findall(rf"^(?:\| {item} \||\*\*Item {item}\.).*?(?=\n\n|\n\| |\Z)", text, re.M | re.S))
                with self.subTest(f"{key} = {value}: {source}"):
                    self.assertTrue(value in ("0", "true", "false", "1") or stands_in(float(value), text), "the page does not have it")

    def test_tables_taken_from_a_page_are_that_pages(self):
        """Numbers that code lists as measured by others stand in the table that it cites."""
        section = re.search(r"^## 5\. .*?(?=^## )", (ROOT / "docs/reference/facts.md").read_text(), re.M | re.S)[0]
        there = {float(number) for number in re.findall(r"(?<![\w.])\d*\.?\d+", section)}
        for name, table in (("nearness.cpp", "kCeiling"), ("wall_aerodynamics.cpp", "kPublished")):
            text = (ROOT / "limpet/vehicle" / name).read_text()
            body = re.search(rf"> {table} = (.*?);", text, re.S)[1].replace("0.5 *", "")
            numbers = [float(number) for number in re.findall(r"(?<![\w.])\d*\.?\d+", body)]
            self.assertGreater(len(numbers), 7)
            for number in numbers:
                with self.subTest(f"{name}: {number}"):
                    self.assertIn(number, there)

    def test_a_fault_of_ours_is_no_answer(self):
        """InternalError is caught where it becomes a run's outcome, or another error, and nowhere else."""
        may = {"limpet/why/trial.cpp", "limpet/campaign/workers.cpp", "limpet/campaign/px4_crew.cpp", "limpet/lab/learn.cpp"}  # outcome `fault`
        catching = {str(path.relative_to(ROOT)) for path in files(".cpp", ".hpp")
                    if path.parts[len(ROOT.parts)] in ("limpet", "apps", "adapters")
                    and re.search(r"catch \((const )?InternalError", path.read_text())}
        self.assertEqual(catching, may)

    def test_a_process_inherits_nothing(self):
        """Programs are started in one place, which closes what is ours; what we open by hand is closed on exec as well."""
        starts = r"(?<![\w.>])(?:::)?(?:v?fork|posix_spawnp?|popen|exec[vl][pe]*|std::system)\s*\("
        opens = r"(?<![\w.>])(?:std::|::)?(open|socket|socketpair|accept4|pipe2|fopen|eventfd|posix_openpt)\s*\(([^;{]*);"
        closed = re.compile(r"_CLOEXEC|\"[rwab+]*e\"|/dev/null")
        for path in files(".cpp", ".hpp"):
            name = str(path.relative_to(ROOT))
            if name.split("/")[0] not in ("limpet", "apps", "adapters") or "/test" in name:
                continue
            text = re.sub(r"//.*", "", path.read_text())
            with self.subTest(name):
                if name != "limpet/core/spawn.cpp":
                    self.assertEqual(re.findall(starts, text), [])
                for call, words in re.findall(opens, text):
                    if call != "open" or "O_" in words:
                        self.assertRegex(words, closed, call)
                self.assertEqual(re.findall(r"(?<![\w.>:])::(accept|pipe|dup)\s*\(", text), [])

    def test_no_table_is_cut_in_two(self):
        for page in files(".md"):
            lines = page.read_text().split("\n")
            for number in range(2, len(lines)):
                row = lines[number].startswith("|") and not lines[number - 1]
                head = number + 1 < len(lines) and re.match(r"\|[-| :]+\|$", lines[number + 1])
                with self.subTest(f"{page.relative_to(ROOT)}:{number + 1}"):
                    self.assertFalse(row and not head, "a row of no table")

    def test_the_top_is_short(self):
        top = {name.split("/")[0] for name in tracked() if not name.startswith(".")}
        self.assertLessEqual(len(top), MOST_ENTRIES, sorted(top))

    def test_every_module_stands_in_both_tables_under_the_same_wing(self):
        read_here = tables((ROOT / "limpet/README.md").read_text(), 2)
        design = (ROOT / "docs/design.md").read_text().split("\n## Modules\n")[1].split("\n## ")[0]
        drawn = [row for row in tables(design, 3) if row[0] not in ("Adapters", "The", "Layers")]
        self.assertEqual(sorted(module for _, module in read_here), sorted(MODULES), "limpet/README.md: each once")
        self.assertEqual(sorted(module for _, module in drawn), sorted(MODULES), "docs/design.md: each once")
        self.assertEqual(read_here, drawn, "the same wings, in the same order")

    def test_limpets_page_names_files_that_are_there(self):
        for row in re.findall(r"^\| \[(\w+)\]\((.*?)\) \|.*\| (.*) \|$", (ROOT / "limpet/README.md").read_text(), re.M):
            module, page, start = row
            for name in [*re.findall(r"`([\w/]+\.\w+)`", start), page.removeprefix(f"{module}/")]:
                with self.subTest(f"{module}: {name}"):
                    self.assertTrue((MODULES[module] / name).is_file(), "no such file")

    def test_every_page_is_in_the_index(self):
        index = (ROOT / "docs/README.md").read_text()
        linked = {(ROOT / "docs" / link).resolve() for link in re.findall(r"\]\(([^)#\s]+)\)", index)}
        pages = {*(ROOT / "docs").glob("*.md"), *(ROOT / "docs/reference").glob("*.md"), *(ROOT / "data").rglob("README.md"), ROOT / "limpet/README.md", ROOT / "adapters/README.md",
                 *(ROOT / "docs").glob("*/README.md")} - {ROOT / "docs/README.md"}
        self.assertEqual([str(page.relative_to(ROOT)) for page in sorted(pages - linked)], [], "not in docs/README.md")

    def test_every_record_has_a_status(self):
        folder = ROOT / "docs/decisions"
        index = (folder / "README.md").read_text()
        rows = {name: (title, status) for name, title, status in re.findall(r"^\| \[\d+\]\((\S+)\) \| (.*) \| (.*) \|$", index, re.M)}
        records = {path.name: re.sub(r"^# \d+:? ", "", path.read_text().split("\n")[0]) for path in folder.glob("[0-9]*.md")}
        self.assertEqual({name: title for name, (title, _) in rows.items()}, records, "a row for each record, with its title")
        for name, (_, status) in rows.items():
            with self.subTest(name):
                self.assertRegex(status, r"^(holds|amended by \[|superseded by \[)")
                self.assertTrue(all(other in records for other in re.findall(r"\]\((\S+?)\)", status)), status)
        numbers = sorted(int(name[:4]) for name in records)
        for missing in set(range(1, numbers[-1])) - set(numbers):
            self.assertIn(f"{missing:04} has no record", index)

    def test_records_count_lines_that_are_there(self):
        for record in (ROOT / "docs/decisions").glob("*.md"):
            for name, lines in re.findall(r"`([\w/.]+)`, ([\d,]+) lines", record.read_text()):
                path = next((ROOT / top / name for top in ("", "limpet") if (ROOT / top / name).exists()), None)
                with self.subTest(f"{record.name}: {name}"):
                    self.assertIsNotNone(path, "no such file")
                    counted = lines_of(path)
                    self.assertLess(abs(counted - int(lines.replace(",", ""))), 0.2 * counted, f"{counted} lines")

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
        tops = ("limpet", "apps", "adapters", "bench", "tests", "docs/examples")
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

    def test_scripts_name_files_that_are_there(self):
        """The two commands, CI and the packages: what a script sources, installs from and fetches for, wherever it is called."""
        listed = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=True).stdout.split()
        scripts = [ROOT / name for name in listed if (ROOT / name).is_file()
                   and re.match(r"#!.*\b(ba)?sh\b", (ROOT / name).read_bytes()[:40].decode(errors="replace").split("\n")[0])
                   or name.endswith(".sh")]
        self.assertGreater(len(scripts), 15)
        for script in scripts:
            text = re.sub(r"\\\n", " ", script.read_text())
            named = {(script.parent / path) for path in re.findall(r'dirname "\$\{BASH_SOURCE\[0\]\}"\)/([\w./-]+)', text)}
            named |= {ROOT / path for path in re.findall(r"\$\{?limpet_root\}?/([\w./-]+)", text)}
            for call in re.findall(r"^\s*(?:install_packages|fetch_node_packages|\.) (.+)$", text, re.M):
                named |= {ROOT / path for path in re.findall(r"(?:^|\s)([\w-]+(?:/[\w.-]+)+)", call)}
            named |= {ROOT / path for path in re.findall(r"^\s*fetch_node_packages ([\w./-]+) ", text, re.M)}
            made = (ROOT / "build", ROOT / "out")
            for path in named:
                with self.subTest(f"{script.relative_to(ROOT)}: {path}"):
                    self.assertTrue(path.exists() or any(path.is_relative_to(folder) for folder in made), "not there")

    def test_the_readme_is_short(self):
        shown = re.sub(r"<!--.*?-->", "", (ROOT / "README.md").read_text())  # what a reader sees, bars of tables aside
        self.assertLessEqual(len([word for word in shown.split() if re.search(r"\w", word)]), 500, "words")

    def test_the_version_stands_in_one_place_and_others_say_the_same(self):
        version = re.search(r'kVersion = "([\d.]+)"', (ROOT / "limpet/core/version.hpp").read_text())[1]
        minor = version.rsplit(".", 1)[0]
        for file, said in (("docs/CITATION.cff", f"\nversion: {version}\n"), ("CHANGELOG.md", f"\n## {version}"),
                           ("adapters/ros/package.xml", f"<version>{version}</version>"), ("adapters/ros/CMakeLists.txt", f"VERSION {version} "),
                           ("docs/examples/CMakeLists.txt", f"find_package(limpet {minor} "), ("docs/install.md", f"`liblimpet{minor}`")):
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
        said = dict(re.findall(r"^\| \[(\w+)\.diff\].*\| (\d+) \| [^|]*\|$", (ROOT / "docs/extending/README.md").read_text(), re.M))
        for diff in diffs:
            with self.subTest(diff.name):
                added = [line for line in diff.read_text().split("\n") if line.startswith("+") and not line.startswith("+++")]
                self.assertEqual(said[diff.stem], str(len(added)), "docs/extending/README.md: lines")
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
