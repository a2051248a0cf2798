"""What a campaign varies: each variable maps a number from 0 to 1 to its own values."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite
from typing import TYPE_CHECKING, Any, Protocol

from plcsim.campaign.errors import CampaignError

if TYPE_CHECKING:
    from collections.abc import Sequence

Scalar = bool | int | float | str
"""A value of a variable, or one that is measured."""


class VariedVariable(Protocol):
    """Something that is varied."""

    @property
    def simplest(self) -> Scalar:
        """The value that shrinking goes towards."""

    def at(self, share: float) -> Scalar:
        """Return the value at a share of the way, from 0 up to but without 1."""

    def steps(self, count: int) -> Sequence[Scalar]:
        """Return the values of a grid, at most ``count``, both ends among them."""

    def simpler(self, value: Any) -> Sequence[Scalar]:
        """Return values that are simpler than ``value``, the simplest first."""


@dataclass(frozen=True)
class Uniform:
    """A number between two limits.

    Args:
        low: the smallest value.
        high: the largest value.
        nominal: the value that shrinking goes towards; by default ``low``.
    """

    low: float
    high: float
    nominal: float | None = None

    def __post_init__(self) -> None:
        if not (isfinite(self.low) and isfinite(self.high) and self.low < self.high):
            raise CampaignError(f"Uniform({self.low}, {self.high}): the first is to be the smaller")
        _check_nominal(self, self.nominal, self.low, self.high)

    @property
    def simplest(self) -> float:
        """The nominal value."""
        return float(self.low if self.nominal is None else self.nominal)

    def at(self, share: float) -> float:
        """Return the value at a share of the way."""
        return self.low + (self.high - self.low) * share

    def steps(self, count: int) -> list[float]:
        """Return ``count`` values at equal distances."""
        if count == 1:
            return [self.simplest]
        return [self.low + (self.high - self.low) * n / (count - 1) for n in range(count)]

    def simpler(self, value: float) -> list[float]:
        """Return the nominal value, what lies halfway to it, and the value with fewer digits."""
        rounded = [float(f"{value:.{digits}g}") for digits in range(1, 6)]
        wanted = [self.simplest, *rounded, (self.simplest + value) / 2]
        simple = [v for v in wanted if self.low <= v <= self.high and v != value]
        return [v for v in dict.fromkeys(simple) if self._cost(v) < self._cost(value)]

    def _cost(self, value: float) -> tuple[int, float]:
        return (len(repr(value).strip("-0").replace(".", "")), abs(value - self.simplest))


@dataclass(frozen=True)
class Integer:
    """A whole number between two limits, both of them possible; for ``nominal`` see `Uniform`."""

    low: int
    high: int
    nominal: int | None = None

    def __post_init__(self) -> None:
        if self.low > self.high:
            raise CampaignError(f"Integer({self.low}, {self.high}): the first is to be the smaller")
        _check_nominal(self, self.nominal, self.low, self.high)

    @property
    def simplest(self) -> int:
        """The nominal value."""
        return self.low if self.nominal is None else self.nominal

    def at(self, share: float) -> int:
        """Return the value at a share of the way."""
        return min(self.high, self.low + int((self.high - self.low + 1) * share))

    def steps(self, count: int) -> list[int]:
        """Return at most ``count`` values at equal distances."""
        span = self.high - self.low
        if count > span:
            return list(range(self.low, self.high + 1))
        if count == 1:
            return [self.simplest]
        return [self.low + round(span * n / (count - 1)) for n in range(count)]

    def simpler(self, value: int) -> list[int]:
        """Return the nominal value, what lies halfway to it, and the next one."""
        step = 1 if value < self.simplest else -1
        wanted = [self.simplest, (self.simplest + value) // 2, value + step]
        return [
            v for v in dict.fromkeys(wanted) if abs(v - self.simplest) < abs(value - self.simplest)
        ]


class Choice:
    """One of several values, the simplest first.

    Args:
        values: numbers, texts, TRUE and FALSE.
    """

    def __init__(self, *values: Scalar) -> None:
        if not values:
            raise CampaignError("Choice(): name at least one value")
        self.values = values

    @property
    def simplest(self) -> Scalar:
        """The first value."""
        return self.values[0]

    def at(self, share: float) -> Scalar:
        """Return the value at a share of the way."""
        return self.values[min(len(self.values) - 1, int(len(self.values) * share))]

    def steps(self, _count: int) -> Sequence[Scalar]:
        """Return all values."""
        return self.values

    def simpler(self, value: Scalar) -> Sequence[Scalar]:
        """Return the values named before ``value``."""
        return self.values[: self.values.index(value)]


def _check_nominal(kind: object, nominal: float | None, low: float, high: float) -> None:
    if nominal is not None and not low <= nominal <= high:
        raise CampaignError(f"{kind}: nominal is to lie between both limits")
