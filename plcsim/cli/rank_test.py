"""The rank test of Mann and Whitney: are the values of one sample larger than those of another?

It compares ranks only, so it needs no assumption about how durations are distributed, and one wild
value counts no more than any other. H. B. Mann, D. R. Whitney, Ann. Math. Statist. 18 (1947) 50-60.
"""

from __future__ import annotations

from functools import cache
from math import comb, erfc, sqrt
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

EXACT_UP_TO = 20
"""Samples up to this size without ties get an exact probability, others the normal one."""


class RankTest(NamedTuple):
    """Result of the test.

    Attributes:
        u: number of pairs in which the second sample's value is larger, ties counted half.
        superiority: ``u`` as a share of all pairs; 0.5 where neither sample is larger.
        probability: of a ``u`` at least as large if both samples came from one distribution.
    """

    u: float
    superiority: float
    probability: float


def rank_test(first: Sequence[float], second: Sequence[float]) -> RankTest:
    """Test whether ``second`` tends to larger values than ``first`` (one-sided).

    Raises:
        ValueError: a sample is empty.
    """
    if not first or not second:
        raise ValueError("both samples need at least one value")
    ranks, ties = _ranks([*first, *second])
    m, n = len(first), len(second)
    u = sum(ranks[m:]) - n * (n + 1) / 2
    if not ties and max(m, n) <= EXACT_UP_TO:
        probability = _exact(round(u), m, n)
    else:
        probability = _normal(u, m, n, ties)
    return RankTest(u, u / (m * n), probability)


def _ranks(values: Sequence[float]) -> tuple[list[float], list[int]]:
    """Return the rank of each value, from 1, and the sizes of groups of equal values above 1."""
    order = sorted(range(len(values)), key=values.__getitem__)
    ranks = [0.0] * len(values)
    ties: list[int] = []
    start = 0
    while start < len(order):
        end = start
        while end < len(order) and values[order[end]] == values[order[start]]:
            end += 1
        for place in order[start:end]:
            ranks[place] = (start + 1 + end) / 2
        if end - start > 1:
            ties.append(end - start)
        start = end
    return ranks, ties


@cache
def _ways(u: int, m: int, n: int) -> int:
    """Return in how many orders of m and n values exactly u pairs have the second larger."""
    if u < 0 or u > m * n:
        return 0
    if m == 0 or n == 0:
        return 1 if u == 0 else 0
    return _ways(u - m, m, n - 1) + _ways(u, m - 1, n)


def _exact(u: int, m: int, n: int) -> float:
    return sum(_ways(k, m, n) for k in range(u, m * n + 1)) / comb(m + n, n)


def _normal(u: float, m: int, n: int, ties: Sequence[int]) -> float:
    """Return the probability by the normal distribution, corrected for ties and continuity."""
    total = m + n
    correction = sum(t**3 - t for t in ties) / (total * (total - 1)) if total > 1 else 0
    variance = m * n / 12 * (total + 1 - correction)
    if variance <= 0:
        return 1.0
    z = (u - m * n / 2 - 0.5) / sqrt(variance)
    return 0.5 * erfc(z / sqrt(2))
