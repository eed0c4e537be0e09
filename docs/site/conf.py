# SPDX-License-Identifier: Apache-2.0
"""The site of the pages as they lie in the tree (docs/site/build makes it): what Sphinx adds is the way round, search,
and the references of C++ and Python."""

import os
import pathlib
import re
import shutil
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, os.environ["LIMPET_PYTHON"])  # autodoc imports the module that is built

project = "Limpet"
author = copyright = "The Limpet developers"
release = re.search(r'kVersion = "([^"]+)"', (ROOT / "limpet/core/version.hpp").read_text())[1]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc"]
root_doc = "README"
include_patterns = ["*.md", "docs/*.md", "docs/decisions/*.md", "docs/reference/*.md", "docs/site/*.md", "data/scenarios/README.md",
                    "data/campaigns/README.md", "adapters/python/README.md", "data/samples/README.md", "adapters/ros/README.md"]
exclude_patterns = ["build", "out", ".git", "adapters/web", "apps/limpet", "tests", "limpet", "adapters/gazebo", "adapters/ros2"]
source_suffix = {".md": "markdown"}
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]
breathe_projects = {"limpet": os.environ["LIMPET_XML"]}
breathe_default_project = "limpet"
breathe_show_include = True
autodoc_member_order = "bysource"
autodoc_typehints = "none"
html_theme = "furo"
html_title = f"Limpet {release}"
html_css_files = ["limpet.css"]
html_static_path = [str(ROOT / "docs/site/static")]
html_use_index = html_domain_indices = False
html_show_sphinx = False
html_copy_source = False
pygments_style = "friendly"

CHAPTERS = {
    "Begin": ["docs/README", "docs/tutorial", "docs/commands", "docs/reading_a_flight"],
    "Yours": ["docs/own_vehicle", "docs/own_controller", "data/scenarios/README", "data/campaigns/README", "adapters/python/README", "data/samples/README"],
    "Around it": ["docs/px4", "docs/companion", "docs/gazebo", "adapters/ros/README", "docs/ros2", "docs/live", "docs/lab", "docs/scaling", "docs/security"],
    "What it computes": ["docs/from_paper_to_code", "docs/models", "docs/parameters", "docs/evidence", "docs/validation", "docs/wind", "docs/faults",
                         "docs/reference/README"],
    "Reference": ["docs/glossary", "docs/site/cpp", "docs/site/python"],
    "How it is built": ["docs/design", "docs/conventions", "docs/CONTRIBUTING", "docs/decisions/README", "CHANGELOG"],
}


def contents():
    """The way round, which the README does not need where it lies."""
    listed = {name for names in CHAPTERS.values() for name in names} | {"README"}
    left = sorted(path.stem for path in (ROOT / "docs").glob("*.md") if f"docs/{path.stem}" not in listed)
    chapters = {**CHAPTERS, **({"More": [f"docs/{name}" for name in left]} if left else {})}
    return "\n\n".join(f"```{{toctree}}\n:hidden:\n:caption: {caption}\n\n" + "\n".join(names) + "\n```"
                       for caption, names in chapters.items())


def listed(folder):
    names = sorted(path.stem for path in (ROOT / folder).glob("*.md") if path.stem != "README")
    return "```{toctree}\n:maxdepth: 1\n\n" + "\n".join(f"/{folder}/{name}" for name in names) + "\n```\n"


def link_to(app, docname, text, target):
    """A link of the tree as one of the site: pages stay, of other files the text is shown, folders are their names."""
    file, _, anchor = target.partition("#")
    path = (ROOT / docname).parent.joinpath(file).resolve()
    if re.match(r"[a-z]+:", target) or not file or not path.exists():
        return None  # a broken one is Sphinx's to tell
    name = str(path.relative_to(ROOT))
    if path.is_dir():
        page = f"{name}/README"
        if page not in app.env.found_docs:
            return f"{text} (`{name}/`)" if name not in text else text
        return f"[{text}](/{page}.md)"
    if path.suffix == ".md" and name[:-3] in app.env.found_docs or path.suffix in (".png", ".jpg", ".webp"):
        return None
    up = "../" * docname.count("/")
    return f'<a href="{up}files/{name}.txt">{text.replace("`", "")}</a>'


def read(app, docname, source):
    text = source[0]
    pieces = re.split(r"(^ *```.*?^ *```$)", text, flags=re.M | re.S)
    for i in range(0, len(pieces), 2):
        pieces[i] = re.sub(r"(?<!!)\[([^\]]*)\]\(([^)\s]+)\)", lambda found: link_to(app, docname, found[1], found[2]) or found[0], pieces[i])
    text = "".join(pieces)
    if docname == root_doc:
        text += "\n" + contents() + "\n"
    if docname in ("docs/decisions/README", "docs/reference/README"):
        text += "\n" + listed(docname.removesuffix("/README"))
    if docname == "docs/site/cpp":
        text += cpp_reference()
    source[0] = text


def finish(app, failure):
    if failure:
        return
    out = pathlib.Path(app.outdir)
    shown_files = set()
    for page in out.rglob("*.html"):  # "file:line" in a comment is no address; a file may not ask for a module
        page.write_text(re.sub(r'<a class="reference external" href="file:[^"]*">(.*?)</a>', r"\1", page.read_text())
                        .replace('<script type="module" src=', "<script defer src="))
        shown_files.update(re.findall(r'href="[./]*files/([^"]+)\.txt"', page.read_text()))
    for name in shown_files:
        shown = out / "files" / f"{name}.txt"
        shown.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, shown)
    repair_theme(out / "_static")
    shutil.copy(out / "README.html", out / "index.html")


def cpp_reference():
    """What each public header declares, by Doxygen's XML."""
    folder = pathlib.Path(os.environ["LIMPET_XML"])
    headers = re.search(r"LIMPET_PUBLIC_HEADERS\s+([^)]*)\)", (ROOT / "limpet/face/CMakeLists.txt").read_text())[1].split()
    declared = {f"limpet/{header}": [] for header in headers}
    for file in sorted([*folder.glob("class*.xml"), *folder.glob("struct*.xml"), *folder.glob("namespacelimpet*.xml")]):
        compound = xml_root(file).find("compounddef")
        name = compound.findtext("compoundname")
        if compound.get("kind") != "namespace":
            header = compound.find("location").get("file")
            outer = name.rpartition("::")[0]
            if header in declared and outer in ("limpet", "limpet::plant") and "<" not in name:
                declared[header].append(f"```{{doxygen{compound.get('kind')}}} {name}\n:members:\n:undoc-members:\n```\n")
            continue
        for member in compound.iter("memberdef"):
            header, kind = member.find("location").get("file"), member.get("kind")
            described = "".join(member.find("briefdescription").itertext()).strip()
            if header in declared and kind in ("enum", "function", "typedef") and described and member.find("templateparamlist") is None:
                what = f"{name}::{member.findtext('name')}" + (member.findtext("argsstring") if kind == "function" else "")
                declared[header].append(f"```{{doxygen{kind}}} {what}\n```\n")
    return "".join(f"\n## {header}\n\n" + "\n".join(dict.fromkeys(entries)) for header, entries in declared.items() if entries)


def xml_root(file):
    return xml.etree.ElementTree.parse(file).getroot()


def as_written(app, what, name, obj, options, lines):
    """Docstrings are laid out for a terminal, in columns: the first paragraph is text, the rest stays as it is."""
    first = next((i for i, line in enumerate(lines) if not line.strip()), len(lines))
    while first < len(lines) and not lines[first].strip():
        first += 1
    head, rest = lines[:first], lines[first:]
    if any(line.startswith(" ") for line in head):
        head, rest = [], lines
    while rest and not rest[-1].strip():
        rest.pop()
    lines[:] = [line.replace("*", r"\*").replace("`", "``") for line in head]
    if rest:
        lines += ["", ".. code-block:: text", "", *("    " + line for line in rest)]
    lines.append("")


def repair_theme(static):
    """Debian's Furo leaves its style and its script in parts that a page which is opened as a file cannot load, and has the
    dark colours only for who asks the page for them, not for whose machine is dark."""
    css, script, part = static / "styles/furo.css", static / "scripts/furo.js", static / "scripts/gumshoe-patched.js"
    style = re.sub(r"@import url\(/javascript/([\w./-]+)\);",
                   lambda found: pathlib.Path("/usr/share/javascript", found[1]).read_text(), css.read_text())
    dark = re.search(r'body\[data-theme="dark"\] \{([^}]*--color-background-primary[^}]*)\}', style)
    if dark and "prefers-color-scheme" not in style:
        style += f'@media (prefers-color-scheme: dark) {{ body:not([data-theme="light"]) {{{dark[1]}}} }}\n'
    css.write_text(style)
    if script.read_text().startswith("import "):
        script.write_text(part.read_text() + re.sub(r"^import .*\n", "", script.read_text()))


def setup(app):
    app.connect("autodoc-process-docstring", as_written)
    app.connect("source-read", read)
    app.connect("build-finished", finish)
