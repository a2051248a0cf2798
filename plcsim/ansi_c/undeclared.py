"""Functions that a file in C calls without a declaration before, and that do not return an int.

C takes such a function for one that returns int. GCC only warns where it turns out to return
nothing, so projects of Automation Studio have such calls; clang refuses a definition that follows
in the same file, and a call of WebAssembly must have the type of what it calls. A declaration of
the result, without parameters where they are as C passes them, makes both right.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Collection, Iterable
    from pathlib import Path

_WARNING = re.compile(
    r"(?:implicit declaration of|call to undeclared) function '(\w+)'"  # clang 14, and newer ones
)
_HEAD = r"^[ \t]*(?:extern[ \t]+)?void[ \t\r\n]+({})[ \t\r\n]*\("
_LIBRARY: Final = {
    **{
        name: f"void {name}();"
        for name in ("_exit", "abort", "exit", "free", "perror", "qsort", "srand")
    },
    **{name: f"double {name}();" for name in ("atof", "difftime")},
    **{name: f"int {name}(const char *, ...);" for name in ("printf", "scanf")},
    "snprintf": "int snprintf(char *, __SIZE_TYPE__, const char *, ...);",
    "sscanf": "int sscanf(const char *, const char *, ...);",
    "sprintf": "int sprintf(char *, const char *, ...);",
}
"""Functions of the C library; of others clang knows the declaration by itself."""


def undeclared(warnings: Iterable[str]) -> set[str]:
    """Return the names of functions that the compiler warns of as not declared."""
    return {found[1] for text in warnings if (found := _WARNING.search(text))}


def declarations(names: Collection[str], sources: Iterable[Path]) -> str:
    """Return declarations of those functions that are not what C takes them for.

    Args:
        names: of the functions.
        sources: files that may define them; they go before the C library.
    """
    found = {name: _LIBRARY[name] for name in names if name in _LIBRARY}
    head = re.compile(_HEAD.format("|".join(map(re.escape, sorted(names)))), re.MULTILINE)
    for source in sources:
        own = head.findall(source.read_text("latin-1"))
        found |= {name: f"void {name}();" for name in own}
    return "".join(f"{each}\n" for _, each in sorted(found.items()))
