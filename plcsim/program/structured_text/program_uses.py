"""Which PROGRAMs of some files others name, by their text: so much is known before it is parsed.

In CODESYS and TwinCAT a PROGRAM calls another, and reads and writes its variables. Such a PROGRAM
exists once: it becomes a function block, and its instance a variable that all see
(`plcsim.program.structured_text.check.programs`).
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

UNITS: Final = {"_INIT": "init", "_CYCLIC": "cyclic", "_EXIT": "exit"}
"""Units of a task by the names of Automation Studio; any other PROGRAM is the cyclic one."""

_NO_CODE: Final = re.compile(
    r"""\(\*.*?\*\) | /\*.*?\*/ | //[^\n]* | '(?:[^'$\n]|\$.)*' | "(?:[^"$\n]|\$.)*" """,
    re.VERBOSE | re.DOTALL,
)
_HEADER: Final = re.compile(r"\bPROGRAM\s+(\w+)", re.IGNORECASE)
_IN_CAPITALS: Final = re.compile(r"PROGRAM(?=\s+(\w+))")
_END: Final = re.compile(r"\bEND_PROGRAM\b", re.IGNORECASE)
_OF_A_BLOCK: Final = re.compile(r"\b(?:METHOD|PROPERTY|VAR_IN_OUT)\b", re.IGNORECASE)
_CONFIGURATION: Final = re.compile(
    r"\bCONFIGURATION\b.*?(?:\bEND_CONFIGURATION\b|\Z)", re.IGNORECASE | re.DOTALL
)


class ProgramUses(NamedTuple):
    """PROGRAMs that exist once, each by its name in capitals.

    Attributes:
        called: those that others call.
        named: these, those whose variables others name, and those with methods or VAR_IN_OUT, which
            function blocks have.
    """

    called: frozenset[str] = frozenset()
    named: frozenset[str] = frozenset()


NO_USES: Final = ProgramUses()


class _Section(NamedTuple):
    """A PROGRAM, or what stands between two: ``owner`` is its name in capitals."""

    owner: str
    text: str


def without_comments(text: str) -> str:
    """Return a text without its comments and strings."""
    return _NO_CODE.sub(" ", text)


def program_uses(texts: Iterable[str]) -> ProgramUses:
    """Return which PROGRAMs others name.

    Args:
        texts: of all files of a program or a project.
    """
    return _program_uses(tuple(texts))


@lru_cache(maxsize=1)  # all steps of one program ask in turn
def _program_uses(known: tuple[str, ...]) -> ProgramUses:
    names = {name for text in known for name in _names_in(text.upper())}.difference(UNITS)
    if not names or (len(names) == 1 and not any(map(_OF_A_BLOCK.search, known))):
        return NO_USES
    sections = [section for text in known for section in _sections(text)]
    pattern = re.compile(
        rf"(?<![\w.#%])(?<!ACTION\s)({'|'.join(names)})\b(?:\s*([(.;])|\s*:(?!=))", re.IGNORECASE
    )
    called, named = set[str](), set[str]()
    for section in sections:
        found, own_calls = _named_in(section, pattern)
        named |= found
        called |= own_calls
        if section.owner in names and _OF_A_BLOCK.search(section.text):
            named.add(section.owner)
    return ProgramUses(frozenset(called), frozenset(named))


def _names_in(capitals: str) -> Iterator[str]:
    """Yield what follows the word PROGRAM; a search for a bare word takes a tenth of the time."""
    for match in _IN_CAPITALS.finditer(capitals):
        before = capitals[match.start() - 1 : match.start()]
        if not before.isalnum() and before != "_":
            yield match[1]


def _named_in(section: _Section, pattern: re.Pattern[str]) -> tuple[set[str], set[str]]:
    """Return what a section names, and what it calls, besides itself and variables of its own."""
    named, called, declared = set[str](), set[str](), {section.owner}
    for match in pattern.finditer(section.text):
        name, sign = match[1].upper(), match[2]
        if sign is None:
            declared.add(name)
        else:
            named.add(name)
            if sign != ".":
                called.add(name)
    return named - declared, called - declared


def _sections(text: str) -> Iterator[_Section]:
    """Yield the PROGRAMs of a text, and what stands between them, without what no code is."""
    code = _CONFIGURATION.sub(" ", without_comments(text))
    owner, start = "", 0
    for match in _HEADER.finditer(code):
        yield from _ended(owner, code[start : match.start()])
        owner, start = match[1].upper(), match.end()
    yield from _ended(owner, code[start:])


def _ended(owner: str, text: str) -> Iterator[_Section]:
    end = _END.search(text) if owner else None
    if end is None:
        yield _Section(owner, text)
    else:
        yield _Section(owner, text[: end.start()])
        yield _Section("", text[end.end() :])
