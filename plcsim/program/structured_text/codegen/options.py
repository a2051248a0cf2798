"""What is compiled into programs beside themselves."""

from __future__ import annotations

from typing import NamedTuple


class CodegenOptions(NamedTuple):
    """What is compiled into programs beside themselves.

    Attributes:
        budget: every loop, and every function that calls, ends where the watchdog asks for it.
        counters: costs by line and coverage are counted (`instrument`); half as fast.
        copies: variables are kept in locals (`copies`); without, every access goes to memory.
    """

    budget: bool = True
    counters: bool = False
    copies: bool = True
