"""Compiled modules as bytes, so that unchanged sources are compiled once."""

from __future__ import annotations

import hashlib
import marshal
import sys
from array import array
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import plcsim
import st_types
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.lines import FunctionLines, ModuleLines
from plcsim.program.structured_text.codegen.object_code import HOLES, ObjectCode
from plcsim.program.structured_text.codegen.profile import Arc, LineCost, Profile

if TYPE_CHECKING:
    from collections.abc import Iterable

_OF_THE_COMPILER: Final = (
    Path(plcsim.__file__).parent / "program" / "structured_text",
    Path(plcsim.__file__).parent / "machine",
    Path(plcsim.__file__).parent / "core" / "system_area.py",
    Path(plcsim.__file__).parent / "core" / "memory.py",
    Path(st_types.__file__).parent,
)


@cache
def compiler() -> bytes:
    """Return what is different after a change of the compiler, for keys of what it has made."""
    state = hashlib.blake2b(sys.version.encode(), digest_size=16)
    for place in _OF_THE_COMPILER:
        for file in sorted(place.rglob("*.py")) if place.is_dir() else [place]:
            status = file.stat()
            state.update(f"{file}\0{status.st_size}\0{status.st_mtime_ns}\0".encode())
    return state.digest()


def dump(code: ObjectCode) -> bytes:
    """Return a module as bytes."""
    return marshal.dumps(
        (
            code.name,
            code.wasm,
            [(one.name, one.size, one.alignment, one.data) for one in code.segments],
            code.holes.tobytes(),
            _tuples(code.lines.functions),
            code.lines.traps,
            [
                (one.space, one.name, list(one.signature.parameters), one.signature.result)
                for one in code.imports
            ],
            _dump_profile(code.profile),
        )
    )


def load(data: bytes) -> ObjectCode | None:
    """Return the module that `dump` has made bytes of; None for other bytes."""
    try:
        return _load(*marshal.loads(data))  # noqa: S302  # from the user's own cache, hashed
    except (EOFError, TypeError, ValueError):
        return None


def _load(  # the parts of `dump`
    name: str,
    wasm: bytes,
    segments: list[Any],
    holes: bytes,
    functions: list[Any],
    traps: dict[int, str],
    imports: list[Any],
    profile: Any,
) -> ObjectCode:
    return ObjectCode(
        name,
        wasm,
        [ir.Segment(*one) for one in segments],
        array(HOLES, holes),
        ModuleLines([FunctionLines(*one) for one in functions], traps),
        [
            ir.Import(space, field, ir.Signature(parameters, result))
            for space, field, parameters, result in imports
        ],
        None if profile is None else _load_profile(*profile),
    )


def _tuples(rows: Iterable[tuple[Any, ...]]) -> list[tuple[Any, ...]]:
    return [tuple(row) for row in rows]


def _dump_profile(profile: Profile | None) -> tuple[Any, ...] | None:
    if profile is None:
        return None
    return list(profile.files), profile.counters, _tuples(profile.costs), _tuples(profile.arcs)


def _load_profile(files: list[str], counters: int, costs: list[Any], arcs: list[Any]) -> Profile:
    costs = [LineCost(*row) for row in costs]
    return Profile(files, counters, costs, [Arc(*row) for row in arcs])
