"""Functions that call themselves: what lives in one call must be single values then."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.program.structured_text.check.kinds import kind_of
from plcsim.program.structured_text.check.names import BY_ADDRESS

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from plcsim.program.structured_text.check import typed


def needs_memory(body: typed.CheckedBody) -> bool:
    """Return True for a function with an array, a structure, a string, or an address taken."""
    others = [*body.locals, *([body.result] if body.result is not None else [])]
    addressed = [symbol for symbol in body.parameters if not symbol.by_address]
    return any(
        symbol.has_address or kind_of(symbol.type) in BY_ADDRESS for symbol in [*others, *addressed]
    )


def reaches(name: str, calls: Mapping[str, Collection[str]]) -> bool:
    """Return True if a function calls itself, by whatever others.

    Args:
        name: of the function.
        calls: names of what each function calls.
    """
    waiting, seen = [name], set[str]()
    while waiting:
        for called in set(calls.get(waiting.pop(), ())) - seen:
            seen.add(called)
            waiting.append(called)
    return name in seen
