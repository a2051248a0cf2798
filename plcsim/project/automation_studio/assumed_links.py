"""Links of mapp that are used and that nothing declares, for the configuration is not there.

Some repositories hold the logical view only. What mapp's configuration would make then has no
declaration, and every program that hands the address of such a link to a block could not run.
"""

from __future__ import annotations

import re
from collections import Counter
from typing import TYPE_CHECKING, Final

from plcsim.project.automation_studio.finding import Finding
from plcsim.project.automation_studio.mapp import COMPONENT, MappVariable
from st_types.syntax.source import read_at_most

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES: Final = 16 << 20
"""Bytes of a file that are read."""

_SUFFIXES: Final = frozenset(
    (
        *(".st", ".il", ".sfc", ".ld", ".fbd", ".cfc", ".ab"),
        *(".c", ".cpp", ".h", ".hpp", ".var", ".typ", ".fun"),
    )
)
_COMMENT: Final = re.compile(r"\(\*.*?\*\)|/\*.*?\*/|//[^\n]*", re.DOTALL)
_NAME: Final = re.compile(r"(?<![\w.])[A-Za-z_]\w*")
_LINK: Final = re.compile(
    r"\bADR\s*\(\s*([A-Za-z_]\w*)\s*\)"  # its address
    r"|\bMpLink\s*:=\s*([A-Za-z_]\w*)\b(?!\s*[.\[(])"  # of a function by name
    r"|\bMp[A-Z]\w*\s*\(\s*([A-Za-z_]\w*)\s*,",  # of a function in the first place
    re.IGNORECASE,
)


def assumed_links(logical: Path) -> tuple[list[MappVariable], list[Finding]]:
    """Return the names below a folder that programs use as links of mapp and in no other way.

    A name that stands in a declaration, has a member, or is read or written anywhere is none.
    """
    uses: Counter[str] = Counter()
    as_link: Counter[str] = Counter()
    found: dict[str, MappVariable] = {}
    for file in sorted(logical.rglob("*")):
        if file.suffix.lower() not in _SUFFIXES or not file.is_file():
            continue
        text = _text(file)
        uses.update(name.upper() for name in _NAME.findall(text))
        for use in _LINK.finditer(text):
            name = use[use.lastindex or 0]
            line = text.count("\n", 0, use.start()) + 1
            found.setdefault(name.upper(), MappVariable(name, COMPONENT, file, line))
            as_link[name.upper()] += 1
    links = [link for name, link in found.items() if uses[name] == as_link[name]]
    return links, _told(links)


def _text(file: Path) -> str:
    """Return a file without its comments, as many lines long."""
    try:
        with file.open("rb") as stream:
            data = read_at_most(stream, MAX_BYTES)
    except OSError:
        return ""  # who reads it in earnest tells of it
    return _COMMENT.sub(lambda comment: "\n" * comment[0].count("\n"), data.decode("latin-1"))


def _told(links: list[MappVariable]) -> list[Finding]:
    if not links:
        return []
    first, more = links[0], len(links) - 1
    others = f" and {more} more are" if more else " is"
    message = (
        f"{first.name}{others} declared nowhere and would be what mapp's configuration makes: "
        f"simulated as {COMPONENT}"
    )
    return [Finding(first.file, first.line, message, "Physical")]
