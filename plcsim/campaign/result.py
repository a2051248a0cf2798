"""What came of one run of a campaign."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from plcsim.campaign.variables import Scalar

_NUMBER = re.compile(r"-?\d+(\.\d+)?([eE][-+]?\d+)?")
_LONGEST_MESSAGE = 500


class RunOutcome(StrEnum):
    """How a run ended."""

    PASSED = "passed"
    FAILED = "failed"
    """Something that was required did not hold, or the controller went into SERVICE."""
    ERROR = "error"
    """The campaign's own code raised, so nothing is known of the programs."""
    HUNG = "hung"
    """It took longer than ``time_limit``."""
    CRASHED = "crashed"
    """Its process ended, as it does where a library of C fails or memory is short."""


@dataclass(frozen=True)
class PlannedRun:
    """A run to be done.

    Attributes:
        number: of the run, from 0.
        seed: of its network and noise.
        values: of its variables.
    """

    number: int
    seed: int
    values: dict[str, Scalar]


@dataclass(frozen=True)
class Result:
    """What came of a run; the same wherever it was done, but for ``host_s``.

    Attributes:
        order: what was done.
        outcome: how it ended.
        message: what was wrong, in one line.
        requirement: the one that did not hold, "" where it was none.
        margin: the smallest of all requirements (`plcsim.campaign.requirements`), None where no
            requirement has one.
        measured: by name.
        host_s: seconds that it took on the host.
        details: the last cycles, where somebody asked for them.
    """

    order: PlannedRun
    outcome: RunOutcome
    message: str = ""
    requirement: str = ""
    margin: float | None = None
    measured: dict[str, Scalar | None] = field(default_factory=dict)
    host_s: float = 0.0
    details: str = ""

    @property
    def cause(self) -> str:
        """What failures are grouped by: the requirement, else the message without its numbers."""
        return (
            ""
            if self.outcome is RunOutcome.PASSED
            else self.requirement or without_numbers(self.message)
        )


def without_numbers(message: str) -> str:
    """Return a message in which every number is "…", so that alike failures have one text."""
    return _NUMBER.sub("…", message)


def shortened(message: str) -> str:
    """Return the first line of a message, cut where it is very long."""
    line = message.splitlines()[0] if message else ""
    return line if len(line) <= _LONGEST_MESSAGE else line[: _LONGEST_MESSAGE - 1] + "…"
