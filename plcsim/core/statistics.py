"""Counts and percentiles of a run: a histogram of fixed size for every measured duration.

The histogram is log-linear, as HDR histograms are: each power of two of nanoseconds is cut into 32
equal buckets, so a percentile is exact to about 3 %. It never grows and takes an addition of one
list element in the scan.
"""

from __future__ import annotations

from typing import Final, NamedTuple

SUB_BITS: Final = 5
LARGEST_NS: Final = (1 << 40) - 1
"""About 18 minutes; longer durations are counted in the last bucket."""

NEVER_NS: Final = 1 << 63
"""Longer than any duration."""

BUCKETS: Final = (40 - SUB_BITS + 1) << SUB_BITS

PERCENTILES: Final = (50.0, 90.0, 99.0, 99.9)


class Summary(NamedTuple):
    """A histogram in a few numbers, all in nanoseconds but ``entries``."""

    entries: int
    minimum_ns: int
    mean_ns: int
    p50_ns: int
    p90_ns: int
    p99_ns: int
    p99_9_ns: int
    maximum_ns: int


class Histogram:
    """Durations in nanoseconds; negative ones count as 0.

    Attributes:
        counts: how many durations fell into each bucket.
        total_ns: their sum.
        minimum_ns: the shortest, exactly; `NEVER_NS` while empty.
        maximum_ns: the longest, exactly.
        last_ns: the latest.
    """

    __slots__ = ("_bucket", "counts", "last_ns", "maximum_ns", "minimum_ns", "total_ns")

    def __init__(self) -> None:
        self.counts = [0] * BUCKETS
        self.reset()

    def reset(self) -> None:
        """Forget all durations."""
        self.counts[:] = [0] * BUCKETS
        self.total_ns = 0
        self.minimum_ns = NEVER_NS
        self.maximum_ns = 0
        self.last_ns = 0
        self._bucket = -1  # of the latest one, where there is one

    def record(self, duration_ns: int) -> None:
        """Count one duration."""
        if duration_ns == self.last_ns and self._bucket >= 0:  # the rule on the virtual clock
            self.counts[self._bucket] += 1
            self.total_ns += duration_ns
            return
        if duration_ns < 0:  # noqa: PLR1730  # here and below: five calls of max() are 1 us a cycle
            duration_ns = 0
        shift = duration_ns.bit_length() - SUB_BITS - 1
        if shift <= 0:
            bucket = duration_ns
        elif duration_ns <= LARGEST_NS:
            bucket = (shift << SUB_BITS) + (duration_ns >> shift)
        else:
            bucket = BUCKETS - 1
        self.counts[bucket] += 1
        self._bucket = bucket
        self.total_ns += duration_ns
        self.last_ns = duration_ns
        if duration_ns > self.maximum_ns:  # noqa: PLR1730
            self.maximum_ns = duration_ns
        if duration_ns < self.minimum_ns:  # noqa: PLR1730
            self.minimum_ns = duration_ns

    @property
    def count(self) -> int:
        """How many durations were recorded."""
        return sum(self.counts)

    def percentile_ns(self, percent: float) -> int:
        """Return a duration that ``percent`` of all durations do not exceed, 0 while empty.

        The upper end of the bucket is given, at most the largest duration seen.
        """
        wanted = self.count * percent / 100
        seen = 0
        for bucket, count in enumerate(self.counts):
            seen += count
            if count and seen >= wanted:
                return min(bucket_end_ns(bucket), self.maximum_ns)
        return 0

    def buckets(self) -> list[tuple[int, int]]:
        """Return (largest duration in nanoseconds, count) of every bucket that is not empty."""
        return [(bucket_end_ns(b), count) for b, count in enumerate(self.counts) if count]

    def summary(self) -> Summary:
        """Return count, smallest, mean, percentiles and largest."""
        count = self.count
        p50_ns, p90_ns, p99_ns, p99_9_ns = (self.percentile_ns(p) for p in PERCENTILES)
        return Summary(
            entries=count,
            minimum_ns=self.minimum_ns if count else 0,
            mean_ns=self.total_ns // count if count else 0,
            p50_ns=p50_ns,
            p90_ns=p90_ns,
            p99_ns=p99_ns,
            p99_9_ns=p99_9_ns,
            maximum_ns=self.maximum_ns,
        )


def bucket_end_ns(bucket: int) -> int:
    """Return the largest duration that is counted in a bucket."""
    if bucket < 2 << SUB_BITS:
        return bucket
    shift = (bucket >> SUB_BITS) - 1
    return ((bucket - (shift << SUB_BITS) + 1) << shift) - 1
