"""Pages of the documentation that are made from what lies elsewhere; a hook of mkdocs.

The home page is README.md, the changelog CHANGELOG.md; the commands come from the parser of
``plcsim``, the API from the docstrings, the list of decisions from their titles.
"""

from __future__ import annotations

import posixpath
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Iterator

TOP = Path(__file__).resolve().parent.parent
PACKAGES = ("plcsim", "st_types", "crosnode")

_LINK = re.compile(r"(?<!!)\[(?P<text>[^\]]+)\]\((?P<target>\.\.?/[^)#]+)[^)]*\)")


def pages() -> Iterator[tuple[str, str]]:
    """Iterate over the pages that are made: path in the site, text in Markdown."""
    yield "index.md", from_top((TOP / "README.md").read_text("utf-8"))
    yield "changelog.md", from_top((TOP / "CHANGELOG.md").read_text("utf-8"))
    yield "commands.md", commands()
    yield "decisions/index.md", decisions()
    for room in rooms():
        yield f"api/{room}.md", api(room)


def from_top(text: str) -> str:
    """Return a file of the top folder with links as they are in docs/."""
    text = text.replace("](docs/decisions/)", "](decisions/index.md)")
    return re.sub(r"\]\(docs/", "](", text)


def inside(text: str, path: str) -> str:
    """Return a page whose links to files outside of docs/ are their text alone.

    Args:
        text: of the page.
        path: of it, below docs/.
    """

    def link(found: re.Match[str]) -> str:
        target = posixpath.normpath(posixpath.join(posixpath.dirname(path), found["target"]))
        return found["text"] if target.startswith("../") else found[0]

    return _LINK.sub(link, text)


def commands() -> str:
    """Return the help of all commands, as they print it."""
    from plcsim.cli.command import build_parser  # noqa: PLC0415  # once the path is set
    from plcsim.cli.command_tree import command_tree  # noqa: PLC0415  # likewise

    lines = ["# Commands", "", "What `--help` of each command prints.", ""]
    for command in command_tree(build_parser()).walk():
        name = " ".join(("plcsim", *command.path))
        lines += [f"## {name}", "", "```text", command.parser.format_help().rstrip(), "```", ""]
    return "\n".join(lines)


def decisions() -> str:
    """Return the list of decision records."""
    lines = ["# Decisions", "", "Why it is as it is, one page each.", ""]
    for page in sorted((TOP / "docs" / "decisions").glob("*.md")):
        title = page.read_text("utf-8").partition("\n")[0].removeprefix("# ")
        lines.append(f"- [{title}]({page.name})")
    return "\n".join([*lines, ""])


def rooms() -> Iterator[str]:
    """Iterate over the folders with modules, as dotted names."""
    for package in PACKAGES:
        for init in sorted((TOP / package).rglob("__init__.py")):
            yield ".".join(init.parent.relative_to(TOP).parts)


def api(room: str) -> str:
    """Return the page of a room: its own docstring and those of its modules."""
    folder = TOP.joinpath(*room.split("."))
    modules = [room]
    modules += [f"{room}.{f.stem}" for f in sorted(folder.glob("*.py")) if f.stem[0] != "_"]
    parts = [f"# {room}", *(f"::: {module}\n" for module in modules)]
    return "\n\n".join(parts)


# what mkdocs calls


def on_config(config: Any) -> Any:
    """Fill the sections of the navigation that are left empty in mkdocs.yml."""
    records = (TOP / "docs" / "decisions").glob("*.md")
    sections = {
        "Decisions": ["decisions/index.md", *(f"decisions/{f.name}" for f in sorted(records))],
        "API": [{package: _pages_of(package)} for package in PACKAGES],
    }
    config["nav"] = [_filled(entry, sections) for entry in config["nav"]]
    return config


def _pages_of(package: str) -> list[str]:
    return [f"api/{room}.md" for room in rooms() if room.split(".")[0] == package]


def _filled(entry: Any, sections: dict[str, list[Any]]) -> Any:
    """Return an entry of the navigation with what belongs into empty sections."""
    if not isinstance(entry, dict):
        return entry
    return {
        title: [_filled(inner, sections) for inner in below] or sections[title]
        for title, below in entry.items()
    }


def on_page_markdown(markdown: str, page: Any, **_: Any) -> str:
    """Return a page without links that lead out of the site, to examples and to code."""
    return inside(markdown, page.file.src_uri)


def on_files(files: Any, config: Any) -> Any:
    """Add the pages that are made."""
    from mkdocs.structure.files import File  # noqa: PLC0415  # only there when the site is built

    sys.path.insert(0, str(TOP))
    for path, text in pages():
        files.append(File.generated(config, path, content=text))
    return files
