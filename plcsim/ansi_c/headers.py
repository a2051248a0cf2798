"""Headers that C programs include, written from declarations as Automation Studio writes them.

Per library one (``AsTCP.h``); ``AsDefault.h`` brings all of them, the types and variables of the
project and those of the program itself.
"""

from __future__ import annotations

import hashlib
import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Final

from st_types.writers.c_header import C_TYPES, Header, c_header

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from st_types.resolve.scope import Scope

INCLUDE: Final = Path(__file__).parent / "include"
"""Folder of the headers that are the same for everybody: ``bur/plctypes.h``, the C library."""

_LAYOUT: Final = {
    "LREAL": "plclreal",
    "LINT": "plclint",
    "ULINT": "plculint",
    "LWORD": "plclword",
}
"""Types of 8 bytes, which C for WebAssembly would align to 8; those in plctypes.h have 4."""


def program_headers(
    local: Scope, project: Scope | None, libraries: Sequence[Scope]
) -> dict[str, str]:
    """Return the headers of one program by name.

    Args:
        local: what the program declares.
        project: what the project declares, None for nothing.
        libraries: in the order in which they are included.
    """
    headers: dict[str, str] = {}
    known: list[Header] = []
    scopes = [(f"{library.name}.h", library, "") for library in libraries]
    if project is not None:
        scopes.append(("plcsim_project.h", project, "_GLOBAL"))
    for name, scope, variables in (*scopes, ("plcsim_program.h", local, "_LOCAL")):
        c_types = {**C_TYPES, **_LAYOUT}
        known.append(Header(scope, known, variables=variables, c_types=c_types))
        headers[name] = c_header(known[-1], scope.name)
    default = [*headers]
    includes = "".join(f"#include <{name}>\n" for name in ("bur/plctypes.h", *default))
    headers["AsDefault.h"] = f"#ifndef _ASDEFAULT_H_\n#define _ASDEFAULT_H_\n{includes}#endif\n"
    return headers


def write_headers(headers: Mapping[str, str], parent: Path | None) -> Path:
    """Write headers into a folder and return it; the same headers give the same folder.

    Args:
        headers: texts by name.
        parent: where the folder lies; None, or one that cannot be written, takes a temporary one.
    """
    state = hashlib.blake2b(digest_size=16)
    for name, text in sorted(headers.items()):
        state.update(f"{name}\0{text}\0".encode())
    for place in (parent, Path(tempfile.gettempdir()) / f"plcsim-headers-{os.getuid()}"):
        if place is not None:
            folder = place / state.hexdigest()
            try:
                _write(headers, folder)
            except OSError:
                continue
            return folder
    raise FileNotFoundError(f"no folder for headers can be written beside {parent}")


def _write(headers: Mapping[str, str], folder: Path) -> None:
    """Make a folder as a whole: another process may make the same one at the same time."""
    if folder.is_dir():
        return
    folder.parent.mkdir(parents=True, exist_ok=True, mode=0o700)
    made = Path(tempfile.mkdtemp(dir=folder.parent, prefix="new-"))
    for name, text in headers.items():
        (made / name).write_text(text, "utf-8")
    try:
        made.rename(folder)
    except OSError:
        if not folder.is_dir():
            raise
