"""Functions that call themselves: what lives in one call of them is there once for each call."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping


def block_label(name: str) -> str:
    """Return the name of the body of a function block among those of all bodies."""
    return f"block {name}"


def in_cycles(calls: Mapping[str, Collection[str]]) -> set[str]:
    """Return the bodies that call themselves, by whatever others, and those between two such.

    Args:
        calls: names of what each body calls; names that are no key are left out.
    """
    inside = {name: set(called) & calls.keys() for name, called in calls.items()}
    inside = _without_ends(inside)
    inside = _without_ends(_turned(inside))
    return set(inside)


def _without_ends(calls: Mapping[str, set[str]]) -> dict[str, set[str]]:
    """Return what is left once bodies that call nothing that is left are taken away."""
    callers = _turned(calls)
    open_calls = {name: len(called) for name, called in calls.items()}
    ends = [name for name, count in open_calls.items() if not count]
    gone = set(ends)
    while ends:
        for caller in callers[ends.pop()]:
            open_calls[caller] -= 1
            if not open_calls[caller]:
                gone.add(caller)
                ends.append(caller)
    return {name: called - gone for name, called in calls.items() if name not in gone}


def _turned(calls: Mapping[str, set[str]]) -> dict[str, set[str]]:
    callers: dict[str, set[str]] = {name: set() for name in calls}
    for caller, called in calls.items():
        for name in called:
            callers[name].add(caller)
    return callers
