"""Which programs call blocks and functions that nothing executes here, and where.

It looks for their names in the text of the sources, so that it can tell of programs too that cannot
be compiled.
"""

from __future__ import annotations

import re
from contextlib import suppress
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.core.errors import ConfigurationError
from plcsim.library.simulated import LANGUAGE as TABLE
from plcsim.library.stub import LANGUAGE as STUB
from plcsim.program.structured_text.check.builtins import EDGES, PLACE_FUNCTIONS, rule_of
from plcsim.project.automation_studio.problems import LANGUAGES
from st_types.errors import SourceError
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping, Sequence
    from pathlib import Path

    from plcsim.library.catalogue import Catalogue

_SOURCES: Final = frozenset([*LANGUAGES, ".typ", ".var", ".fun", ".h", ".hpp"])

_COMPILED_TEXT: Final = frozenset([".st", ".typ", ".var", ".fun", ".ab", ".il", ".sfc"])

_NAME = re.compile(
    r"\(\*.*?\*\)|/\*.*?\*/|//[^\n]*|'(?:[^'\n$]|\$.)*'|\"[^\"\n]*\"|([A-Za-z_]\w*)(\s*\()?",
    re.DOTALL,
)

_WORD = re.compile(r"[A-Za-z_]\w*")


class StubCall(NamedTuple):
    """A name that a program uses and nothing executes.

    Attributes:
        library: that declares it.
        name: of the block or function.
        program: that uses it, or the library that does.
        location: "file:line" of the first time.
        times: how often its sources name it.
    """

    library: str
    name: str
    program: str
    location: str
    times: int


def stub_calls(catalogue: Catalogue, sources: Mapping[str, Sequence[Path]]) -> list[StubCall]:
    """Return the names that nothing executes, by program and in order of their first use.

    Args:
        catalogue: of the project.
        sources: files by the name of the program or the library that they belong to.
    """
    blocks = _names(catalogue, "types")
    functions = _names(catalogue, "functions")
    known: dict[str, str | None] = {}
    calls: dict[tuple[str, str], StubCall] = {}
    for program, files in sources.items():
        for name, is_called, location in _uses(files, blocks | functions):
            if name not in known:
                known[name] = _stubbed_in(catalogue, name)
            library = known[name]
            if library is None or not (is_called or name in blocks):
                continue
            before = calls.get((program, name))
            times = 1 if before is None else before.times + 1
            first = location if before is None else before.location
            calls[program, name] = StubCall(library, name, program, first, times)
    return [*calls.values()]


def _names(catalogue: Catalogue, space: str) -> frozenset[str]:
    scopes = [library.scope for library in catalogue.libraries if catalogue.has_stubs(library)]
    if space == "functions":
        declared = (name for scope in scopes for name in scope.index.names("functions"))
        return frozenset([*declared, *_idle(catalogue)])
    return frozenset(block.name for scope in scopes for block in scope.function_blocks)


def _idle(catalogue: Catalogue) -> dict[str, str]:
    """Return who brings what was looked up and does nothing, functions of compiled C among it."""
    found = catalogue.stubbed.items()
    return {name: owner for owner, names in found for name, text in names.items() if not text}


def _stubbed_in(catalogue: Catalogue, name: str) -> str | None:
    """Return the library whose stub a name means, None where something executes it."""
    with suppress(ConfigurationError):  # of the library that declares it; it is told elsewhere
        for found in (catalogue.find_block(name), catalogue.find_function(name)):
            if found is not None and found[1] is not None and found[1].language in (STUB, TABLE):
                return found[0].name
    return _idle(catalogue).get(name)


def _is_built_in(name: str) -> bool:
    """Whether Structured Text knows a function itself; vendors declare these in libraries too."""
    return name.upper() in EDGES | PLACE_FUNCTIONS or rule_of(name) is not None


def _has_any(text: str, names: frozenset[str]) -> bool:
    """Return whether some names stand in a text, comments too: that is told fast."""
    return bool(names) and not names.isdisjoint(_WORD.findall(text))


def _uses(files: Iterable[Path], names: frozenset[str]) -> Iterator[tuple[str, bool, str]]:
    """Yield the names that stand in files, whether a bracket follows, and where."""
    for file in files:
        suffix = file.suffix.lower()
        if suffix not in _SOURCES:
            continue
        try:
            text = Source.read(file).text
        except (OSError, SourceError):
            continue  # the loader tells what cannot be read
        for found in _NAME.finditer(text) if _has_any(text, names) else ():
            if found[1] in names and not (suffix in _COMPILED_TEXT and _is_built_in(found[1])):
                line = text.count("\n", 0, found.start()) + 1
                yield found[1], found[2] is not None, f"{file}:{line}"
