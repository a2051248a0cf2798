"""Python's cyclic garbage, collected while the scan sleeps and never while it runs.

With the collector disabled (real-time rights) nothing else would collect it, and a program that
makes reference cycles would grow without bound.
"""

from __future__ import annotations

import gc

ENOUGH_IDLE_NS = 500_000
"""A collection is done in a sleep at least this long."""

YOUNG_OBJECTS = 700
"""As many new objects make a collection worth while; the default of CPython."""

TOO_MANY_OBJECTS = 100_000
"""As many new objects make a collection needed, however short the sleep is."""


def collect_while_idle(idle_ns: int) -> None:
    """Collect the generation that is due, if ``idle_ns`` nanoseconds of sleep allow it."""
    young, middle, old = gc.get_count()
    if young <= YOUNG_OBJECTS or (idle_ns < ENOUGH_IDLE_NS and young <= TOO_MANY_OBJECTS):
        return
    gc.collect(2 if old > 10 else 1 if middle > 10 else 0)


def freeze() -> None:
    """Take all objects made so far out of later collections, and stop automatic ones."""
    gc.collect()
    gc.freeze()
    gc.disable()


def thaw() -> None:
    """Undo `freeze`."""
    gc.unfreeze()
    gc.enable()
