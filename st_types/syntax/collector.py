"""Python's cyclic garbage collector, held back while trees are built.

A syntax tree is many objects and no cycles, and so is what a compiler makes of it. Collections that
start while it grows walk all of it again and again and find nothing; without them parsing and
compiling are half as fast again.
"""

from __future__ import annotations

import gc
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Iterator

FROZEN_BY_PYTHON: Final = 1_000
"""Python 3.12 starts with some hundred frozen objects; whoever freezes a program has more."""


@contextmanager
def collector_paused() -> Iterator[None]:
    """Start no automatic collection inside the block; leave the collector as it was found."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            _age()
            gc.enable()


def _age() -> None:
    """Move all objects to the oldest generation, or the next collection would walk the new ones.

    To freeze and unfreeze them does that without looking at any. What somebody else has frozen
    must stay so.
    """
    if gc.get_freeze_count() < FROZEN_BY_PYTHON:
        gc.freeze()
        gc.unfreeze()
