"""What has to hold in a run, each with a margin that says how far it is from failing.

The margin of a run is the robustness of signal temporal logic (Fainekos and Pappas, 2009; Donzé and
Maler, 2010): the smallest over all cycles for what has always to hold, the largest for what has to
hold once; below 0 the requirement does not hold.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING

from plcsim.campaign.errors import CampaignError

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.testing import Plc


@dataclass(frozen=True)
class Requirement(ABC):
    """Base of what has to hold.

    Args:
        text: what has to hold, in words; failures are grouped by it.
        margin: of the controller; returns by how much it holds, below 0 where it does not. A bool
            says whether it holds, and gives a search nothing to go by.
    """

    text: str
    margin: Callable[[Plc], object]

    def now(self, plc: Plc) -> float:
        """Return the margin of this moment.

        Raises:
            CampaignError: the function gives no number.
        """
        value = self.margin(plc)
        if isinstance(value, bool):
            return math.inf if value else -math.inf
        if not isinstance(value, int | float) or math.isnan(value):
            raise CampaignError(f"{self.text}: its margin is {value!r}, not a number or a bool")
        return float(value)

    @abstractmethod
    def watch(self, plc: Plc) -> Observation:
        """Return what observes a run."""


class Observation:
    """The margin of one requirement in one run so far."""

    def __init__(self, requirement: Requirement, plc: Plc) -> None:
        self.text = requirement.text
        self.margin = math.nan
        self._now = requirement.now
        self._plc = plc

    def after_cycle(self) -> bool:
        """Take note of a cycle; return False where the requirement can hold no more."""
        return True

    def at_end(self) -> bool:
        """Take note of the end of the run; return whether the requirement held."""
        return self.margin >= 0


class _Always(Observation):
    def after_cycle(self) -> bool:
        margin = self._now(self._plc)
        if not self.margin <= margin:
            self.margin = margin
        return margin >= 0

    def at_end(self) -> bool:
        return not self.margin < 0


class _Eventually(Observation):
    def after_cycle(self) -> bool:
        margin = self._now(self._plc)
        if not self.margin >= margin:
            self.margin = margin
        return True


class _AtEnd(Observation):
    def at_end(self) -> bool:
        self.margin = self._now(self._plc)
        return super().at_end()


class Always(Requirement):
    """Has to hold after every cycle; the run ends where it does not."""

    def watch(self, plc: Plc) -> Observation:
        """Return what observes a run."""
        return _Always(self, plc)


class Eventually(Requirement):
    """Has to hold after one cycle at least."""

    def watch(self, plc: Plc) -> Observation:
        """Return what observes a run."""
        return _Eventually(self, plc)


class AtEnd(Requirement):
    """Has to hold when the run is over."""

    def watch(self, plc: Plc) -> Observation:
        """Return what observes a run."""
        return _AtEnd(self, plc)
