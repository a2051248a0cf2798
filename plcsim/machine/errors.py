"""Errors of the machine.

::

    PlcError
    ├── MachineError      a module cannot be compiled or linked, or the host has no room for it
    └── MachineFault      compiled code has trapped: kind, address, call chain

An exception of Python code that compiled code has called comes out of the call unchanged.
`frames_of` tells for any of them which compiled functions it has passed.
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from plcsim.core.errors import PlcError


class MachineError(PlcError):
    """A module cannot be compiled or linked, or the host has no room for the machine."""


class FaultKind(Enum):
    """Why compiled code has trapped."""

    PAGE_FAULT = "page fault"
    DIVISION_BY_ZERO = "division by zero"
    INTEGER_OVERFLOW = "integer overflow"
    INVALID_CONVERSION = "conversion of a value that is no number to an integer"
    STACK_OVERFLOW = "stack overflow"
    NIL_FUNCTION = "call through a function pointer that is nil"
    WRONG_FUNCTION = "call through a function pointer of another type"
    UNREACHABLE = "unreachable code"
    BUDGET = "ended by the watchdog"
    FUEL = "more instructions than allowed"
    OTHER = "trap"


class Frame(NamedTuple):
    """One function of a call chain.

    Attributes:
        module: name of the module.
        function: name of the function, "" where it has none.
        number: of the function in its module.
        offset: in the module's binary, of the instruction that trapped or called; 0 where it is
            not known, as at the entry of a function that finds no room on the stack.
    """

    module: str
    function: str
    number: int
    offset: int


class MachineFault(PlcError):  # noqa: N818  # the field's term
    """Compiled code has trapped.

    Attributes:
        kind: why.
        address: what was accessed, for page faults where the host tells.
    """

    def __init__(self, kind: FaultKind, address: int | None = None, detail: str = "") -> None:
        where = "" if address is None else f": address 16#{address:08X}"
        super().__init__(f"{detail or kind.value}{where}")
        self.kind = kind
        self.address = address

    @property
    def frames(self) -> tuple[Frame, ...]:
        """The call chain, innermost first."""
        return frames_of(self)


_FRAMES = "machine_frames"
_BEFORE = "machine_frames_before"


def frames_of(error: BaseException) -> tuple[Frame, ...]:
    """Return the compiled functions that an exception has passed, innermost first."""
    frames: tuple[Frame, ...] = vars(error).get(_FRAMES, ())
    return frames


def note_frames(error: BaseException, frames: tuple[Frame, ...]) -> None:
    """Note which compiled functions an exception has passed; those noted first are all of them."""
    vars(error).setdefault(_FRAMES, (*vars(error).get(_BEFORE, ()), *frames))


def go_on(error: BaseException, ended: BaseException) -> None:
    """Note that an exception goes on where another one has ended: it has passed what that has."""
    vars(error)[_BEFORE] = frames_of(ended)
