"""What compiler and linker say, in words that help."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.ansi_c.case_blind import SUFFIXES
from plcsim.core.suggestion import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

_NO_HEADER = re.compile(r"'([^']+)' file not found$")
_DUPLICATE = re.compile(r"duplicate symbol: (.+?), defined in (.+?), defined in (.+)$")
_COMMENT = re.compile(r"//[^\n]*|/\*.*?(?:\*/|\Z)", re.DOTALL)
_DEEPEST = 5
_MOST_HEADERS = 5_000
_ASSEMBLER = "this is assembler of the controller's processor; plcsim compiles for another machine"
_NESTED = re.compile(r"(.+?):(\d+):(\d+): function definition is not allowed here")
_HEAD_OF_FUNCTION = re.compile(r"(\w+)\s*\([^()]*\)\s*\Z")
_HEAD_OF_UNIT = re.compile(r"\b_(?:INIT|CYCLIC|EXIT)\b[^;{}]*\Z")
_IS_NESTED = (
    "is a nested function, an extension of GCC that clang does not have: move it out of the other "
    "function, and hand it what it uses of that"
)
_OF_BLOCKS = re.compile(r"inside block|block pointer|__block type|\(\^\)")
_IS_BLOCK = (
    "a nested function, an extension of GCC, is a block of clang here, which can neither change "
    "parameters of the other function nor be taken for a pointer: move it out"
)
THROWS = re.compile(r" with exceptions disabled$| requires -frtti$")
_NO_EXCEPTIONS = "exceptions and types at run time need the compiler of plcsim[c]"
_UNIT_INSIDE = re.compile(r"(.+?:\d+):\d+: 'export_name' attribute only applies to functions")
_NO_BRACE = "this unit stands inside another function: a } is missing somewhere before it"
_SOCKETS = "a controller has no sockets of POSIX, TCP is the library AsTCP (AsTCP.h)"
_THREADS = "a controller has no threads: a program's units run in its task class"
_PROCESSES = "a controller has one process, and no system around it"
_ELSEWHERE = {
    **dict.fromkeys(("sys/un.h", "net/if.h", "sys/epoll.h", "sys/uio.h", "ifaddrs.h"), _SOCKETS),
    **dict.fromkeys(("threads.h", "semaphore.h"), _THREADS),
    **dict.fromkeys(("sys/wait.h", "sys/mman.h", "sys/resource.h", "spawn.h"), _PROCESSES),
    **dict.fromkeys(("pwd.h", "grp.h", "sys/utsname.h", "execinfo.h"), _PROCESSES),
    "dlfcn.h": "libraries are linked when a program is built",
    "termios.h": "a controller has no terminal; serial interfaces are the library DVFrame",
    "syslog.h": "the logbook is the library ArEventLog",
    **dict.fromkeys(
        ("regex.h", "glob.h", "fnmatch.h", "iconv.h"), "this is none of the C library here"
    ),
}


def explained(finding: str, folders: Sequence[Path]) -> str:
    """Return what the compiler said, and a hint where there is one.

    Args:
        finding: "file:line:column: text".
        folders: where headers are looked for.
    """
    missing = _NO_HEADER.search(finding)
    if missing:
        return finding + _about_header(missing[1], folders)
    nested = _NESTED.match(finding)
    if nested:
        return f"{finding}: {_nested(nested)}"
    if _OF_BLOCKS.search(finding):
        return f"{finding} ({_IS_BLOCK})"
    if unit := _UNIT_INSIDE.match(finding):
        return f"{unit[1]}: {_NO_BRACE}"
    if THROWS.search(finding):
        return f"{finding} ({_NO_EXCEPTIONS})"
    return f"{finding} ({_ASSEMBLER})" if " in asm" in finding else finding


def _nested(found: re.Match[str]) -> str:
    """Return what is wrong with a function whose body begins at a place of a file, in another."""
    try:
        lines = Path(found[1]).read_text("utf-8", "replace").splitlines()[: int(found[2])]
    except OSError:
        lines = []
    lines[-1:] = [line[: int(found[3]) - 1] for line in lines[-1:]]
    text = "\n".join(lines)
    if _HEAD_OF_UNIT.search(text):
        return _NO_BRACE
    name = _HEAD_OF_FUNCTION.search(text)
    return f"{name[1]} {_IS_NESTED}" if name else _IS_NESTED


def _about_header(name: str, folders: Sequence[Path]) -> str:
    if name in _ELSEWHERE:
        return f"; {_ELSEWHERE[name]}"
    known: dict[str, str] = {}
    for path in _headers(folders):
        known.setdefault(os.path.basename(path), path)  # noqa: PTH119  # thousands of them
        if len(known) > _MOST_HEADERS:
            break
    found = known.get(os.path.basename(name))  # noqa: PTH119  # as above
    if found is not None:
        return f"; it is {found}: name its folder in [c] include of plc.toml"
    return did_you_mean(name, known, 2)


def _headers(folders: Iterable[Path]) -> Iterator[str]:
    for folder in folders:
        yield from _below(os.fspath(folder), _DEEPEST)


def _below(folder: str, depth: int) -> Iterator[str]:
    try:
        with os.scandir(folder) as found:
            entries = sorted(found, key=lambda entry: entry.name)
    except OSError:
        return
    for entry in entries:
        if entry.name.lower().endswith(SUFFIXES):
            yield entry.path
        elif depth and entry.name[0] not in "._" and entry.is_dir(follow_symlinks=False):
            yield from _below(entry.path, depth - 1)


def defined_twice(text: str) -> str:
    """Return what the linker says of two definitions, with their places."""
    found = _DUPLICATE.search(text)
    if found is None:
        return text
    name, *files = found.groups()
    first, second = (place_of(name, Path(file)) for file in files)
    return f"{name} is defined at {first} and at {second}; one of them goes, or is static or extern"


def plain_name(symbol: str) -> str:
    """Return the name of a function or a variable of C++ without its types: ``Motor::start``."""
    left, names = re.match(r"_ZN?K?(?:St3__1)?(.*)", symbol), []
    rest = left[1] if left else ""
    while found := re.match(r"(\d+)(.*)", rest):
        names.append(found[2][: int(found[1])])
        rest = found[2][int(found[1]) :]
    return "::".join(names) or symbol


def first_use(name: str, sources: Iterable[Path]) -> str:
    """Return "file:line" where a name is used first outside of comments, "" where it is not seen.

    Args:
        name: as `plain_name` gives it.
        sources: files to look into.
    """
    word = re.escape(name.rpartition("::")[2])
    used = re.compile(rf"(?:[;{{}}()=,&|!+\-/<>?:\[.]|\b(?:return|else|do))\s*({word})\b")
    seen = re.compile(rf"\b({word})\b")
    texts = {source: without_comments(source) for source in sources}
    for pattern in (used, seen):
        for source, text in texts.items():
            if found := pattern.search(text):
                return f"{source}:{text.count(chr(10), 0, found.start(1)) + 1}"
    return ""


def without_comments(source: Path) -> str:
    """Return the text of a source with its lines and no comments, "" where it cannot be read."""
    try:
        text = source.read_text("latin-1")
    except OSError:
        return ""
    return _COMMENT.sub(lambda found: "\n" * found[0].count("\n"), text)


def place_of(name: str, source: Path) -> str:
    """Return "file:line" of a definition, the file alone where it is not seen."""
    plain = re.escape(name.partition("(")[0].rpartition("::")[2])
    definition = re.compile(rf"^(?!\s*(?:extern|return|#|//|\*))\w[^;={{}}]*\b{plain}\b")
    try:
        lines = source.read_text("utf-8", "replace").splitlines()
    except OSError:
        return str(source)
    number = next((n for n, line in enumerate(lines, 1) if definition.match(line)), None)
    return str(source) if number is None else f"{source}:{number}"
