"""Where in Structured Text the faults of compiled programs are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.machine import FaultKind
from plcsim.program.compiled import CallSite

if TYPE_CHECKING:
    from plcsim.machine import Frame
    from plcsim.program.compiled import Locate
    from plcsim.program.structured_text.codegen.lines import ModuleLines

REASONS = {
    "index": "index outside the bounds of its array",
    "stack": FaultKind.STACK_OVERFLOW.value,
}
"""By what compiled code has noted for a trap that it has made itself (`Location.trap`)."""


def locator(lines: ModuleLines) -> Locate:
    """Return what locates the frames of a module by its lines."""

    def locate(frame: Frame) -> CallSite | None:
        found = lines.find(frame.offset)
        if found is None or found.kind == "helper":
            return None
        return CallSite(f"{found.file}:{found.line}", found.function, REASONS.get(found.trap))

    return locate
