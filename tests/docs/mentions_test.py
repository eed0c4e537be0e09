# SPDX-License-Identifier: Apache-2.0
"""What pages name in passing is there: files behind links, tests behind `-R`, verbs and their options."""

import importlib.machinery
import importlib.util
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(sys.argv.pop(1))
LIMPET = BUILD / "apps/limpet/limpet"


def pages():
    loader = importlib.machinery.SourceFileLoader("refresh", str(ROOT / "docs/refresh"))
    refresh = importlib.util.module_from_spec(importlib.util.spec_from_loader("refresh", loader))
    sys.dont_write_bytecode = True
    loader.exec_module(refresh)
    return [*refresh.pages(), *(ROOT / "docs").glob("*.md"), *(ROOT / "docs/reference").glob("*.md"), *(ROOT / "docs/decisions").glob("*.md")]


PAGES = sorted(set(pages()))


def heading_anchors(page):
    """As GitHub and the site make them."""
    headings = re.findall(r"^#+ (.*)$", re.sub(r"```.*?```", "", page.read_text(), flags=re.S), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


LYING = """\
```console
$ limpet list surfaces
nothing at all
```
```sh
limpet fly nowhere
```
<!-- not run: no time -->
```sh
limpet fly hover
```
```
limpet fly hover
```
<!-- picture: nothing.png -->
![none](nothing.png)
<!-- figure walls: limpet list surfaces | wc -l => (\\d+) -->
<!-- figure moons: limpet list surfaces | wc -l => (\\d+) -->
There are <!-- walls -->77<!-- /walls --> walls and <!-- stars -->8<!-- /stars --> stars.
"""


class Mentions(unittest.TestCase):
    def test_a_page_that_lies_is_caught(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "lying.md"
            page.write_text(LYING)
            checked = subprocess.run([sys.executable, ROOT / "docs/refresh", "--check", "--build", BUILD, page], capture_output=True,
                                     text=True)
            self.assertEqual(page.read_text(), LYING)
        self.assertEqual(checked.returncode, 1)
        self.assertIn("lying.md:1: says 0 times where it is typed", checked.stderr)
        for line, said in ((3, "says 'nothing at all'"), (6, "exit code 2"), (9, "no excuse"), (13, "nobody types"),
                           (15, "nothing made it"), (19, "says '77' as walls, and there comes '5'"), (19, "stars: no command"),
                           (18, "moons: nothing shows it")):
            self.assertRegex(checked.stderr, rf"lying\.md:{line}: .*{said}")

    def test_a_page_stands_at_one_of_three_places(self):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "moon.md"
            page.write_text("*Typed in the moon.*\n```sh\nlimpet list surfaces\n```\n")
            checked = subprocess.run([sys.executable, ROOT / "docs/refresh", "--check", "--build", BUILD, page], capture_output=True,
                                     text=True)
        self.assertEqual(checked.returncode, 1)
        self.assertRegex(checked.stderr, r"moon\.md:1: \*Typed in the moon\.\*: no such place; there are \*Typed in the checkout's root")

    def test_links_lead_somewhere(self):
        for page in PAGES:
            for link in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"```.*?```", "", page.read_text(), flags=re.S)):
                if re.match(r"[a-z]+://|mailto:", link):
                    continue
                file, _, anchor = link.partition("#")
                target = (page.parent / file).resolve() if file else page
                with self.subTest(f"{page.relative_to(ROOT)}: {link}"):
                    self.assertTrue(target.exists(), "no such file")
                    if anchor and target.suffix == ".md":
                        self.assertIn(anchor, heading_anchors(target), "no such heading")

    def test_tests_that_are_named_exist(self):
        listed = subprocess.run(["ctest", "--test-dir", BUILD, "-N"], capture_output=True, text=True, check=True).stdout
        if "_NOT_BUILT" in listed:
            self.skipTest("not all tests are built")
        there = re.findall(r"Test +#\d+: (\S+)", listed)
        for page in PAGES:
            for quoted, bare in re.findall(r"(?:\./test|ctest)(?: -[A-Z])* -R (?:'([^']+)'|([\w.]+))",
                                           page.read_text().replace("\\|", "|")):  # as a cell of a table has it
                with self.subTest(f"{page.relative_to(ROOT)}: {quoted or bare}"):
                    for part in ([quoted] if "(" in quoted else quoted.split("|")) if quoted else [bare]:
                        if part not in ("suction_cup", "X", "MODULE"):  # of adapters/gazebo/test; patterns
                            self.assertTrue(any(re.search(part, name) for name in there), "no such test")

    def test_tests_of_modules_that_are_named_exist(self):
        """`module.Suite`, `module.Suite.Test`; a name may end in ... or have a * within."""
        listed = subprocess.run(["ctest", "--test-dir", BUILD, "-N"], capture_output=True, text=True, check=True).stdout
        if "_NOT_BUILT" in listed:
            self.skipTest("not all tests are built")
        there = re.findall(r"Test +#\d+: (\S+)", listed)
        modules = {name.split(".")[0] for name in there}
        checked = 0
        for page in PAGES:
            for word in re.findall(r"`([a-z]\w*(?:\.[A-Z*][\w*]*){1,2})(?:\.\.\.)?`", page.read_text()):
                if word.split(".")[0] not in modules:
                    continue
                checked += 1
                with self.subTest(f"{page.relative_to(ROOT)}: {word}"):
                    pattern = re.escape(word).replace(r"\*", r"\w*")
                    self.assertTrue(any(re.match(pattern, name) for name in there), "no such test")
        self.assertGreater(checked, 50)

    def test_cells_of_tables_hide_their_bars(self):
        for page in PAGES:
            for number, line in enumerate(re.sub(r"```.*?```", lambda fence: "\n" * fence[0].count("\n"), page.read_text(),
                                                 flags=re.S).split("\n"), 1):
                if line.startswith("|"):
                    with self.subTest(f"{page.relative_to(ROOT)}:{number}"):
                        self.assertNotRegex(line, r"`[^`|]*[^\\`|]\|[^`|]*\w`", "write \\| within a cell")

    def test_verbs_and_options_that_are_named_exist(self):
        help_of = {}
        for page in PAGES:
            for text in re.findall(r"`(?:limpet|\./run) ([a-z][^`]*)`", page.read_text()):
                verb, *rest = text.split()
                if verb in ("python",) or not re.fullmatch(r"[a-z0-9-]+", verb):
                    continue
                with self.subTest(f"{page.relative_to(ROOT)}: {text}"):
                    if verb not in help_of:
                        asked = subprocess.run([LIMPET, *([] if verb == "help" else [verb]), "--help"], capture_output=True, text=True)
                        help_of[verb] = asked.stdout if asked.returncode == 0 else ""
                    self.assertTrue(help_of[verb], "no such verb")
                    for option in (word for word in rest if word.startswith("--")):
                        self.assertIn(option.split("=")[0], help_of[verb], "no such option")


if __name__ == "__main__":
    unittest.main()
