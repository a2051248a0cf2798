"""What a fault of a compiled program means, and where in its sources it was."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.errors import Fault
from plcsim.machine import frames_of, trace_inside
from plcsim.program.fault import describe, frames

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.program.structured_text.codegen.lines import LineTable, Location

REASONS = {"index": "index outside the bounds of its array"}
"""By what compiled code has noted for a trap that it has made itself (`Location.trap`)."""


def fault_of(error: BaseException, lines_of: Callable[[str], LineTable | None]) -> Fault:
    """Return what something that a unit raised means.

    Args:
        error: what came out of the call of a unit: a trap, the end of its budget, or what a block
            or function in Python has raised.
        lines_of: gives the lines of a module by its name.
    """
    chain = _locations(error, lines_of)
    reason = REASONS.get(chain[-1].trap) if chain else None
    calls = [(f"{one.file}:{one.line}", one.function) for one in chain]
    calls += frames(trace_inside(error))
    location = calls[-1][0] if calls else ""
    texts = tuple(f"{line} in {function}" for line, function in calls)
    return Fault(location, reason or describe(error), texts)


def _locations(error: BaseException, lines_of: Callable[[str], LineTable | None]) -> list[Location]:
    """Return where in the sources the calls were that an exception has passed, outermost first."""
    found = []
    for frame in reversed(frames_of(error)):
        lines = lines_of(frame.module)
        location = lines.find(frame.offset) if lines else None
        if location is not None and location.kind != "helper":
            found.append(location)
    return found
