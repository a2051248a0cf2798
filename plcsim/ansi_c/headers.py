"""Headers that C programs include, written from declarations as Automation Studio writes them.

Per library one (``AsTCP.h``); ``AsDefault.h`` brings all of them, the types and variables of the
project and those of the program itself.
"""

from __future__ import annotations

import hashlib
import os
import re
import tempfile
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Final, NamedTuple

from st_types.writers.c_header import C_TYPES, Header, c_header

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

    from st_types.resolve.scope import Scope

INCLUDE: Final = Path(__file__).parent / "include"
"""Folder of the headers that are the same for everybody: ``bur/plctypes.h``, the C library."""

DEFAULT: Final = "AsDefault.h"

_LAYOUT: Final = {
    "LREAL": "plclreal",
    "LINT": "plclint",
    "ULINT": "plculint",
    "LWORD": "plclword",
}
"""Types of 8 bytes, which C for WebAssembly would align to 8; those in plctypes.h have 4."""

_SAME: Final = ("plc.h", "globalTYP.h", "globalVAR.h", "Libraries.h")
"""Names by which Automation Studio has parts of what `DEFAULT` brings."""

_FIRST: Final = "#include <bur/plctypes.h>\n"

_IN_ORDER: Final = "PLCSIM_IN_ORDER"
"""Defined while all libraries are included one by one, so that none looks for those before it."""

_DECLARATION = re.compile(r"^[\w *]+?[ *](\w+)\([^#]*?\)[^;{]*;", re.MULTILINE)
_TYPE_OF_HEADER = re.compile(r"\b(?!size_t\b|wchar_t\b)(?:\w+_t|va_list|FILE|struct)\b")

_PLAIN_PROTOTYPE = re.compile(
    r"^_BUR_PUBLIC ([\w ]+?) (\w+)\(((?:(?:un)?signed \w+ \w+(?:, )?)+)\);$", re.MULTILINE
)
"""A function of numbers."""

_PROTOTYPE = re.compile(r"^_BUR_PUBLIC [^(]*?\b(\w+)\(.*$", re.MULTILINE)


def library_headers(libraries: Sequence[Scope]) -> Mapping[str, str]:
    """Return a header per library by name, which all programs of a project share.

    Args:
        libraries: in the order in which they are included.
    """
    return _library_headers(libraries)[0]


def _library_headers(libraries: Iterable[Scope]) -> tuple[dict[str, str], list[Header]]:
    """Return the headers by name, and what they declare, for those that rest on them."""
    headers: dict[str, str] = {}
    known: list[Header] = []
    before: tuple[Scope, ...] = ()
    for library in libraries:
        before = (*before, library)
        header, text = _last_header(before)
        headers[f"{library.name}.h"] = _including(known, text)
        known.append(header)
    return headers, known


@lru_cache(maxsize=256)
def _last_header(libraries: tuple[Scope, ...]) -> tuple[Header, str]:
    """Return the header of the last of libraries, and its text without what it includes."""
    *before, library = libraries
    header = _header(library, [_last_header(tuple(before))[0]] if before else ())
    text = _without_standard(c_header(header, library.name))
    if not library.strict:  # a library's own sources need what they declare, and no more
        text += _taking_pointers(text, library.name)
    return header, text


def program_headers(scopes: Iterable[Scope], libraries: Sequence[Scope]) -> dict[str, str]:
    """Return the headers of one program by name, without those of `library_headers`.

    Args:
        scopes: what the program declares, and around it the folders up to the project.
        libraries: in the order in which they are included.
    """
    brought, known = _library_headers(libraries)
    headers: dict[str, str] = {}
    local, *around = scopes
    for scope in reversed(around):
        known.append(_header(scope, known[-1:]))
        headers[f"plcsim_{len(headers)}.h"] = c_header(known[-1], f"plcsim {scope.name}")
    known.append(_header(local, known[-1:]))
    headers["plcsim_program.h"] = c_header(known[-1], "plcsim_program")
    includes = f"#define {_IN_ORDER}\n{_included(brought)}#undef {_IN_ORDER}\n"
    return _of_files([*around, local]) | headers | _default(f"{includes}{_included(headers)}")


def body_headers(
    library: Scope, libraries: Sequence[Scope], needed: Collection[Scope]
) -> dict[str, str]:
    """Return the headers for the sources of a library by name.

    Args:
        library: whose bodies are in C.
        libraries: all, in the order in which they are included.
        needed: those that its own header and `DEFAULT` bring; the others are there.
    """
    headers, known = _library_headers(each for each in libraries if each is not library)
    around = [each for each in known if each.scope in needed]
    own = f"{library.name}.h"
    text = c_header(_header(library, around), library.name)  # what others have as well, it declares
    brought = [f"{each.scope.name}.h" for each in around]
    default = _default(_included([*brought, own]))
    return {**_of_files([library]), **headers, own: _including(around, text), **default}


def _including(known: Iterable[Header], text: str) -> str:
    """Return a header that brings what it may rest on, as Automation Studio's do.

    Nothing rests on a library that declares nothing; its own header may hold C++.
    """
    includes = _included(f"{each.scope.name}.h" for each in known if each.scope.files)
    return text.replace(_FIRST, f"{_FIRST}#ifndef {_IN_ORDER}\n{includes}#endif\n", 1)


def _taking_pointers(text: str, name: str) -> str:
    """Return overloads for C++ of functions that take addresses as numbers.

    Vendors' headers declare pointers there (``void **``), so that C++ passes them without a cast.

    Args:
        text: of a library's header.
        name: of the library.
    """
    overloads = []
    for result, function, given in _PLAIN_PROTOTYPE.findall(text):
        kinds = _types_of(given)
        if "unsigned long" in kinds:
            types = ", ".join(f"class T{n}" for n in range(len(kinds)))
            taken = ", ".join(f"T{n} a{n}" for n in range(len(kinds)))
            passed = ", ".join(f"({kind})a{n}" for n, kind in enumerate(kinds))
            overloads.append(
                f"template <{types}> inline {result} {function}({taken})\n"
                f"{{ return {function}({passed}); }}\n"
            )
    if not overloads:
        return ""
    guard = f"PLCSIM_POINTERS_{name}"
    head = f"\n#if defined(__cplusplus) && !defined({guard})\n#define {guard}\n"
    return f'{head}extern "C++" {{\n{"".join(overloads)}}}\n#endif\n'


def _of_files(scopes: Iterable[Scope]) -> dict[str, str]:
    """Return the headers that Automation Studio writes for single files: ``axisTYP.h``."""
    names = [Path(file.path).stem for scope in scopes for file in scope.files]
    headers = [f"{name}{kind}.h" for name in names for kind in ("TYP", "VAR")]
    return dict.fromkeys(headers, f"#include <{DEFAULT}>\n")


def _header(scope: Scope, known: Sequence[Header]) -> Header:
    """Return what writes a scope; its variables are the controller's, C does not define them."""
    return Header(scope, known, variables="extern", c_types={**C_TYPES, **_LAYOUT})


def _default(includes: str) -> dict[str, str]:
    guard = "#ifndef _ASDEFAULT_H_\n#define _ASDEFAULT_H_\n"
    text = f"{guard}#include <bur/plctypes.h>\n{includes}#endif\n"
    return {DEFAULT: text, **dict.fromkeys(_SAME, f"#include <{DEFAULT}>\n")}


def _included(names: Iterable[str]) -> str:
    return "".join(f"#include <{name}>\n" for name in names)


def _without_standard(text: str) -> str:
    """Return a library's header where C's own headers declare what they have as well.

    Libraries such as asstring make functions of C known to Structured Text.
    """
    standard = standard_functions()
    found = {m[1] for m in _PROTOTYPE.finditer(text)} & standard.keys()
    if not found:
        return text
    others = _of_other_length(text, {name: standard[name].declaration for name in found})
    text = _PROTOTYPE.sub(lambda m: f"/* {m[1]}: of C */" if m[1] in found else m[0], text)
    text = text.replace(_FIRST, f"{_FIRST}{others}", 1)
    return text.replace(_FIRST, f"{_FIRST}{_of_c([standard[name] for name in sorted(found)])}", 1)


def _of_other_length(text: str, declarations: Mapping[str, str]) -> str:
    """Return declarations of functions that take fewer numbers than those of C with their names.

    That is asstring's itoa, which is called with two where C's takes three: clang tells them apart.

    Args:
        text: of a library's header.
        declarations: of C's functions, by name.
    """
    lines = []
    for result, name, given in _PLAIN_PROTOTYPE.findall(text):
        if name in declarations and given.count(",") != declarations[name].count(","):
            for last in ("unsigned long", "void *"):
                types = ", ".join([*_types_of(given)[:-1], last])
                head = f"__attribute__((overloadable)) {result} {name}"
                lines.append(f'{head}({types}) __asm__("{name}");\n')
    return f"#ifndef __cplusplus\n{''.join(lines)}#endif\n" if lines else ""


def _types_of(parameters: str) -> list[str]:
    return [each.strip().rpartition(" ")[0] for each in parameters.split(",")]


class StandardFunction(NamedTuple):
    """A function that C itself has.

    Attributes:
        header: that declares it.
        declaration: its text.
    """

    header: str
    declaration: str

    @property
    def is_plain(self) -> bool:
        """Whether the declaration needs no type of its header."""
        return _TYPE_OF_HEADER.search(self.declaration) is None


def _of_c(functions: Sequence[StandardFunction]) -> str:
    """Return what declares functions of C.

    Their headers would bring names that a project may have given to something else (``random``);
    C++ does not do without them, and has name spaces.
    """
    headers = [f"#include <{name}>\n" for name in sorted({each.header for each in functions})]
    rest = sorted({each.header for each in functions if not each.is_plain})
    known = [f"#include <{name}>\n" for name in ("stddef.h", *rest)]
    plain = [f"{each.declaration}\n" for each in functions if each.is_plain]
    return "".join(["#ifdef __cplusplus\n", *headers, "#else\n", *known, *plain, "#endif\n"])


@cache
def standard_functions() -> Mapping[str, StandardFunction]:
    """Return the functions that C itself has, by their names."""
    found: dict[str, StandardFunction] = {}
    for file in sorted(INCLUDE.glob("*.h")):
        for match in _DECLARATION.finditer(file.read_text("utf-8")):
            found.setdefault(match[1], StandardFunction(file.name, match[0]))
    return found


def identity_of(kind: str, scopes: Iterable[Scope]) -> str:
    """Return what headers of scopes depend on: a hash of their texts, and of who writes them.

    Args:
        kind: of the headers; those of a program and of a library differ.
        scopes: in order.
    """
    state = hashlib.blake2b(_writer() + kind.encode(), digest_size=16)
    for scope in scopes:
        state.update(scope.identity)
    return state.hexdigest()


@cache
def _writer() -> bytes:
    """Return what changes when headers are written in another way."""
    state = hashlib.blake2b()
    files = [Path(__file__), *sorted(Path(c_header.__code__.co_filename).parent.glob("*.py"))]
    for file in (*files, *sorted(INCLUDE.rglob("*.h"))):
        state.update(file.read_bytes())
    return state.digest()


def written_headers(
    identity: str, make: Callable[[], Mapping[str, str]], parent: Path | None
) -> Path:
    """Return a folder with headers; it is written where it is not there.

    Args:
        identity: of the headers: what has the same one is not made again.
        make: gives their texts by name.
        parent: where the folder lies; None, or one that cannot be written, takes a temporary one.
    """
    for place in (parent, Path(tempfile.gettempdir()) / f"plcsim-headers-{os.getuid()}"):
        if place is not None:
            folder = place / identity
            try:
                if not folder.is_dir():
                    _write(make(), folder)
            except OSError:
                continue
            return folder
    raise FileNotFoundError(f"no folder for headers can be written beside {parent}")


def _write(headers: Mapping[str, str], folder: Path) -> None:
    """Make a folder as a whole: another process may make the same one at the same time."""
    folder.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    made = Path(tempfile.mkdtemp(dir=folder.parent, prefix="new-"))
    for name, text in headers.items():
        (made / name).write_text(text, "utf-8")
    try:
        made.rename(folder)
    except OSError:
        if not folder.is_dir():
            raise
