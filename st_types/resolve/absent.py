"""Why a type has no layout: the name, somewhere in it, that nothing declares."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from st_types.resolve.index import DONE
from st_types.syntax.tree import (
    ArraySpecification,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    NamedType,
    StructSpecification,
)

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import Any

    from st_types.resolve.index import IndexEntry


def absent_type(entry: IndexEntry) -> str:
    """Return ``": no type is called Motor (Machine.typ:12)"`` of a declaration without a layout.

    Empty where its layout fails for another reason.
    """
    return _search(entry, {id(entry)})


def _search(entry: IndexEntry, seen: set[int]) -> str:
    scope = entry.resolver.scope
    for node in _named_types(entry.node):
        if scope.find_type(node.name) is not None:
            continue
        hit = scope.lookup("types", node.name)
        if hit is None:
            file = entry.resolver.file
            path, line, _ = file.diagnostics.source.location(file.tokens.offset(node.at))
            return f": no type is called {node.name} ({Path(path).name}:{line})"
        if id(hit.entry) not in seen and hit.entry.state == DONE:
            seen.add(id(hit.entry))
            found = _search(hit.entry, seen)
            if found:
                return found
    return ""


def _named_types(node: Any) -> Iterator[NamedType]:
    """Iterate over the types that a declaration needs for its layout."""
    match node:
        case NamedType():
            yield node
        case ArraySpecification():
            yield from _named_types(node.element)
        case StructSpecification():
            for member in node.members:
                yield from _named_types(member.specification)
        case FunctionBlockDeclaration() | FunctionDeclaration():
            for block in node.blocks:
                for member in block.declarations:
                    yield from _named_types(member.specification)
        case _ if hasattr(node, "specification"):
            yield from _named_types(node.specification)
