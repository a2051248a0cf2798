"""Compiled programs on disk: where nothing that a program sees has changed, nothing is done again.

What a program sees is all text that is declared around it and the places of the global variables;
machine code has a cache of its own (`plcsim.machine.cache`).
"""

from __future__ import annotations

import hashlib
import marshal
from typing import TYPE_CHECKING, NamedTuple

from plcsim.machine.cache import CodeCache, default_folder
from plcsim.program.structured_text.codegen.storage import compiler, dump, load

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.codegen.object_code import ObjectCode
    from plcsim.program.structured_text.sources import UnitFile
    from plcsim.program.variables import DeclaredVariables
    from st_types.resolve.scope import Scope


class Stored(NamedTuple):
    """A compiled program.

    Attributes:
        code: of it.
        warnings: about its text.
    """

    code: ObjectCode
    warnings: Sequence[str]


def code_cache() -> CodeCache:
    """Return the cache in the user's own folder."""
    folder = default_folder()
    return CodeCache(folder.parent / "st" if folder else None)


def key_of(
    names: Sequence[str], files: Sequence[UnitFile], scope: Scope, shared: DeclaredVariables
) -> str:
    """Return what two programs have in common whose code is the same.

    Args:
        names: of the program and its dialect.
        files: with its units.
        scope: what it declares and sees.
        shared: the global variables.
    """
    state = hashlib.blake2b(compiler(), digest_size=20)
    sources = [file.source for file in files]
    for text in (*names, *(part for source in sources for part in (source.path, source.text))):
        state.update(f"{len(text)} ".encode())
        state.update(text.encode("utf-8", "surrogatepass"))
    for each in scope.chain:
        state.update(each.identity)
    for kind in shared:
        for member, offset in zip(kind.members, kind.offsets, strict=True):
            state.update(f"{member.name} {offset};".encode())
        state.update(b"|")
    return state.hexdigest()


def find(cache: CodeCache, key: str) -> Stored | None:
    """Return what is stored under a key, None where there is nothing that can be used."""
    data = cache.load(key)
    if data is None:
        return None
    try:
        warnings, stored = marshal.loads(data)  # noqa: S302  # from the user's own cache, hashed
    except (EOFError, TypeError, ValueError):
        return None
    code = load(stored)
    return None if code is None else Stored(code, warnings)


def keep(cache: CodeCache, key: str, stored: Stored) -> None:
    """Store a compiled program."""
    cache.store(key, marshal.dumps(([*stored.warnings], dump(stored.code))))
