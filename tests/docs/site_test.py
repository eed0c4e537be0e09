# SPDX-License-Identifier: Apache-2.0
"""The site (docs/site/build), made without a warning, and every page of it opened in a real browser: no error on the
console, nothing asked of other hosts, no link that leads nowhere, no page wider than a phone.

    tests/docs/site_test.py BUILD OUT       77: no Sphinx, Doxygen or Chromium here (./test installs them)"""

import importlib.machinery
import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
MUST_BE_THERE = ("index.html", "docs/tutorial.html", "docs/site/cpp.html", "docs/site/python.html", "search.html")


def browser_of_tests():
    sys.dont_write_bytecode = True
    loader = importlib.machinery.SourceFileLoader("browser", str(ROOT / "tests/support/browser"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("browser", loader))
    loader.exec_module(module)
    return module


def look_at(browser, program, site):
    """What is wrong, page by page."""
    wrong = []
    pages = sorted(site.rglob("*.html"))
    with tempfile.TemporaryDirectory(prefix="limpet_site.", ignore_cleanup_errors=True) as folder:
        process = browser.Browser(program, folder, time.monotonic() + 240)
        try:
            for page in pages:
                tab = browser.Tab(process, page.as_uri())
                report = browser.look(tab, process, page.as_uri())
                own = f"requests {site.as_uri()}/"  # style, scripts and pictures of the site are its own
                wrong += [f"{page.relative_to(site)}: {problem}" for problem in report["problems"] if not problem.startswith(own)]
                for target in process.ask("Target.getTargets")["targetInfos"]:
                    if target["url"] == page.as_uri():
                        process.ask("Target.closeTarget", targetId=target["targetId"])
        finally:
            process.close()
    print(f"{len(pages)} pages looked at")
    return wrong


def main():
    build, site = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    browser = browser_of_tests()
    program = next(filter(None, map(shutil.which, browser.NAMES)), None)
    sphinx = subprocess.run(["/usr/bin/python3", "-c", "import sphinx, myst_parser, breathe, furo"], capture_output=True)
    if program is None or sphinx.returncode != 0 or shutil.which("doxygen") is None:
        print("no Chromium, or no Sphinx with myst_parser, breathe and furo, or no Doxygen")
        return 77
    made = subprocess.run([ROOT / "docs/site/build", build, site], capture_output=True, text=True)
    wrong = [] if made.returncode == 0 else [made.stdout + made.stderr]
    wrong += [f"{name}: is not there" for name in MUST_BE_THERE if not (site / name).is_file()]
    cpp, python = ((site / f"docs/site/{name}.html").read_text() for name in ("cpp", "python"))
    wrong += [f"the references do not have {name}" for name, text in (("class Autopilot", cpp), ("limpet.fly", python))
              if name.split()[-1] not in text]
    wrong += look_at(browser, program, site)
    for line in wrong:
        print(line)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
