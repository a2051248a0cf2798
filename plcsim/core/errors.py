"""Errors of plcsim.

::

    PlcError                         base of all
    ├── ApplicationError             a program ended the application, by ERRxfatal
    ├── ConfigurationError           plc.toml or a project folder is wrong; names file and field
    │   └── ExtensionError           a table for an extension is wrong, and no program
    ├── PageFault                    an address that no variable lies at
    ├── PhaseError                   an act in a phase of the scan that does not allow it
    ├── StateError                   an act in a system state that does not allow it
    ├── TagError                     no such tag, or a value it cannot take
    └── ProgramError                 what a program raised, with program, unit, file and line

    CycleTimeViolation               raised in a program that does not return, by the watchdog; no
                                     PlcError, so that ``except Exception`` does not catch it
"""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterator


class PlcError(Exception):
    """Base of all errors of this package."""


class ApplicationError(PlcError):
    """A program has found that the application must not go on."""


class ConfigurationError(PlcError):
    """A project cannot be loaded; the message names the file and the field.

    Attributes:
        findings: everything that is wrong, a line or more for each.
    """

    def __init__(self, *findings: str) -> None:
        super().__init__("\n".join(findings))
        self.findings = findings


class ExtensionError(ConfigurationError):
    """What plc.toml says for an extension does not fit the project or the host."""


class Findings:
    """Gathers what is wrong, so that a person is told everything in one go."""

    def __init__(self) -> None:
        self._texts: dict[str, None] = {}

    @property
    def texts(self) -> tuple[str, ...]:
        """Everything that is wrong so far, each once."""
        return tuple(self._texts)

    def __bool__(self) -> bool:
        return bool(self._texts)

    def add(self, error: ConfigurationError) -> None:
        """Add the findings of an error; what is there already is not told twice."""
        self._texts |= dict.fromkeys(error.findings)

    @contextmanager
    def gathered(self) -> Iterator[None]:
        """Add what is raised inside, and go on after it."""
        try:
            yield
        except ConfigurationError as error:
            self.add(error)

    def check(self) -> None:
        """Raise one ConfigurationError with all findings, if there are any."""
        if self._texts:
            raise ConfigurationError(*self._texts)


class PageFault(PlcError):  # noqa: N818  # the field's term
    """An access through an address at which no variable lies.

    Attributes:
        address: what was accessed.
        size: bytes.
    """

    def __init__(self, address: int, size: int) -> None:
        super().__init__(f"page fault: {size} bytes at address 16#{address:08X}")
        self.address = address
        self.size = size


class PhaseError(PlcError):
    """An act that the current phase of the scan does not allow."""


class StateError(PlcError):
    """An act that the system state of the controller does not allow."""


class TagError(PlcError):
    """A tag does not exist or cannot take a value."""


class CycleTimeViolation(BaseException):  # the field's term
    """Raised by the watchdog in a program that does not return."""


class Fault(NamedTuple):
    """What stopped a program, as its language tells it.

    Attributes:
        location: "file:line" of the program's own source, "" where there is none.
        reason: what happened, in one line.
        calls: "file:line in NAME" of each call that led there, the outermost first.
    """

    location: str
    reason: str
    calls: tuple[str, ...] = ()


class ProgramError(PlcError):
    """What a program raised.

    Attributes:
        program: name of the program in plc.toml.
        unit: INIT, CYCLIC or EXIT, "" where none of them ran.
        location: as in `Fault`, like the rest.
        reason: likewise.
        calls: likewise.
    """

    def __init__(self, program: str, unit: str, fault: Fault) -> None:
        where = f" ({fault.location})" if fault.location else ""
        super().__init__(f"{program} {unit}".rstrip() + f": {fault.reason}{where}")
        self.program = program
        self.unit = unit
        self.location, self.reason, self.calls = fault
