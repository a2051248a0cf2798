"""What a run of a campaign gives besides pass and fail."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from plcsim.campaign.errors import CampaignError
from plcsim.testing.condition import Condition

if TYPE_CHECKING:
    from plcsim.campaign.variables import Scalar
    from plcsim.testing import Plc
    from plcsim.testing.condition import Given


class Measure(ABC):
    """Base of what is measured of a run.

    Attributes:
        name: of the column of the results.
    """

    name: str

    @abstractmethod
    def watch(self, plc: Plc) -> Meter:
        """Return what measures a run."""


class Meter(ABC):
    """Measures one run."""

    def after_cycle(self) -> None:  # noqa: B027  # some need only the end
        """Take note of a cycle."""

    @abstractmethod
    def value(self) -> Scalar | None:
        """Return what was measured; None where there was nothing."""


@dataclass(frozen=True)
class Final(Measure):
    """The value of a tag when the run is over."""

    tag: str

    @property
    def name(self) -> str:  # type: ignore[override]  # a name that follows from the tag
        """Of the column."""
        return self.tag

    def watch(self, plc: Plc) -> Meter:
        """Return what measures a run."""
        return _Final(self.tag, plc)


@dataclass(frozen=True)
class Maximum(Final):
    """The largest value of a tag after any cycle."""

    @property
    def name(self) -> str:  # type: ignore[override]  # likewise
        """Of the column."""
        return f"max {self.tag}"

    def watch(self, plc: Plc) -> Meter:
        """Return what measures a run."""
        return _Extreme(self.tag, plc, max)


@dataclass(frozen=True)
class Minimum(Final):
    """The smallest value of a tag after any cycle."""

    @property
    def name(self) -> str:  # type: ignore[override]  # likewise
        """Of the column."""
        return f"min {self.tag}"

    def watch(self, plc: Plc) -> Meter:
        """Return what measures a run."""
        return _Extreme(self.tag, plc, min)


@dataclass(frozen=True)
class TimeUntil(Measure):
    """The release of the first cycle after which a condition holds, in seconds.

    Args:
        condition: a tag that is to be TRUE, or ``{tag: value, ...}``.
        name: of the column; by default the condition.
    """

    condition: Any
    name: str = ""

    def __post_init__(self) -> None:
        if not self.name:
            text = self.condition if isinstance(self.condition, str) else repr(self.condition)
            object.__setattr__(self, "name", f"time until {text}")

    def watch(self, plc: Plc) -> Meter:
        """Return what measures a run."""
        return _TimeUntil(self.condition, plc)


class _Final(Meter):
    def __init__(self, tag: str, plc: Plc) -> None:
        plc.tags.find(tag)
        self._tag, self._plc = tag, plc

    def value(self) -> Scalar | None:
        return scalar(self._tag, self._plc.tags.peek(self._tag))


class _Extreme(_Final):
    def __init__(self, tag: str, plc: Plc, choose: Any) -> None:
        super().__init__(tag, plc)
        self._choose = choose
        self._extreme: Any = None

    def after_cycle(self) -> None:
        value = scalar(self._tag, self._plc.tags.peek(self._tag))
        self._extreme = value if self._extreme is None else self._choose(self._extreme, value)

    def value(self) -> Scalar | None:
        found: Scalar | None = self._extreme
        return found


class _TimeUntil(Meter):
    def __init__(self, condition: Given, plc: Plc) -> None:
        self._condition, self._plc = Condition(condition, plc.tags), plc
        self._time_s: float | None = None

    def after_cycle(self) -> None:
        if self._time_s is None and self._condition.holds():
            self._time_s = self._plc.last_release_ns / 1e9

    def value(self) -> Scalar | None:
        return self._time_s


def scalar(name: str, value: object) -> Scalar:
    """Return a value that fits into one cell of a table.

    Raises:
        CampaignError: it is a STRUCT, an ARRAY, or nothing that a table holds.
    """
    if isinstance(value, bool | int | float | str):
        return value
    raise CampaignError(f"{name} is {type(value).__name__}, which is not one value")
