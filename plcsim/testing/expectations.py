"""What a test may expect of the controller in time: until, within, stable, sequence."""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import partial
from typing import TYPE_CHECKING, Any, NoReturn

from plcsim.core.duration import format_duration
from plcsim.library.value_text import text_of
from plcsim.testing.condition import Condition
from plcsim.testing.errors import PlcTestError
from plcsim.testing.times import duration_ns
from st_types.types.values import decode

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from types import TracebackType

    from plcsim.testing.condition import Given
    from plcsim.testing.tags import Tags

__tracebackhide__ = True

PATIENCE_NS = 10_000_000_000
"""How long `Expectations.until` waits where nothing else is said."""


class Expectations(ABC):
    """Base of `Plc`: all of its methods that wait for something or assert something."""

    tags: Tags

    def __init__(self) -> None:
        self._limits: list[TimeLimit] = []

    @property
    @abstractmethod
    def time_ns(self) -> int:
        """Time since the start of the controller."""

    @abstractmethod
    def advance(self, duration_ns: int, stop: Callable[[], bool] | None = None) -> bool:
        """Run for a time, or until ``stop`` holds after a cycle; return whether it did."""

    @abstractmethod
    def fail(self, text: str, paths: Iterable[str]) -> NoReturn:
        """Raise ExpectationFailed with the last cycles of the tags ``paths``."""

    @property
    @abstractmethod
    def last_release_ns(self) -> int:
        """Release of the latest cycle, since the start of the controller."""

    @property
    @abstractmethod
    def cycle_count(self) -> int:
        """Cycles of the task class under test so far."""

    def until(self, condition: Given, within: str | int | None = None) -> int:
        """Run until a condition holds after a cycle.

        Args:
            condition: a tag that is to be TRUE, ``{tag: value, ...}``, or a function.
            within: how long it may take; by default what an enclosing `assert_within` leaves,
                else 10 s. A cycle released exactly at the end counts.

        Returns:
            Nanoseconds it took, from now to the release of that cycle; 0 if it holds already.

        Raises:
            ExpectationFailed: it did not hold in time.
        """
        wanted = Condition(condition, self.tags)
        if within is not None:
            limit_ns = duration_ns(within, "within")
        else:
            limit_ns = min((limit.rest_ns() for limit in self._limits), default=PATIENCE_NS)
        return self._wait(wanted, limit_ns, f"waited {format_duration(limit_ns)} for {wanted.text}")

    def _wait(self, wanted: Condition, limit_ns: int, expectation: str) -> int:
        if wanted.holds():
            return 0
        start_ns, start = self.time_ns, self.cycle_count
        if not self.advance(limit_ns + 1, wanted.holds):
            self._never_held(wanted, expectation, self.cycle_count - start)
        return max(0, self.last_release_ns - start_ns)

    def _never_held(self, wanted: Condition, expectation: str, cycles: int) -> NoReturn:
        seen = "; ".join(self._now(path) for path in list(wanted.paths)[:4])
        self.fail(
            f"{expectation}; it held after none of {cycles} cycles" + (f"; {seen}" if seen else ""),
            wanted.paths,
        )

    def _now(self, path: str) -> str:
        return f"{path} is {text_of(self.tags.find(path).data_type, self.tags.peek(path))}"

    def assert_within(self, limit: str | int, condition: Given | None = None) -> TimeLimit:
        """Assert that a condition holds in time, or that a ``with`` block takes no longer.

        ::

            plc.assert_within("100ms", "Cell.motor")
            with plc.assert_within("100ms"):
                plc.until("Cell.motor")
                plc.until({"Cell.speed": 1500})

        Args:
            limit: time on the controller's clock; a cycle released exactly at its end counts.
            condition: as for `until`.

        Returns:
            With ``elapsed_ns`` how long it took.

        Raises:
            ExpectationFailed: it took longer.
        """
        limit_ns = duration_ns(limit, "assert_within")
        allowed = TimeLimit(self, limit_ns)
        if condition is not None:
            wanted = Condition(condition, self.tags)
            text = f"expected {wanted.text} within {format_duration(limit_ns)}"
            allowed.elapsed_ns = self._wait(wanted, limit_ns, text)
        return allowed

    def assert_stable(
        self, tags: str | Sequence[str], for_: str | int, value: object = None
    ) -> None:
        """Run for a time and assert that no cycle changes the tags.

        Args:
            tags: one tag or several.
            for_: how long.
            value: what one tag is to be during that time; by default what it is now.

        Raises:
            ExpectationFailed: one of them changed, or is not ``value`` to begin with.
        """
        paths = [tags] if isinstance(tags, str) else list(tags)
        if value is not None and len(paths) != 1:
            raise PlcTestError("assert_stable: a value needs exactly one tag")
        span_ns = duration_ns(for_, "for_")
        first = [self.tags.raw(path) for path in paths]
        if value is not None and first[0] != self.tags.encode(paths[0], value):
            wanted = text_of(self.tags.find(paths[0]).data_type, value)
            self.fail(f"expected {paths[0]} to be {wanted}, but {self._now(paths[0])}", paths)
        start_ns = self.time_ns
        if self.advance(span_ns, lambda: [self.tags.raw(path) for path in paths] != first):
            elapsed_ns = max(0, self.last_release_ns - start_ns)
            changed = [p for p, raw in zip(paths, first, strict=True) if self.tags.raw(p) != raw]
            was = first[paths.index(changed[0])]
            self.fail(
                f"expected {changed[0]} to stay {self._text(changed[0], was)} for "
                f"{format_duration(span_ns)}; after {format_duration(elapsed_ns)} it became "
                f"{self._text(changed[0], self.tags.raw(changed[0]))}",
                paths,
            )

    def _text(self, path: str, raw: bytes) -> str:
        data_type = self.tags.find(path).data_type
        return text_of(data_type, decode(data_type, raw))

    def assert_sequence(
        self,
        tag: str | tuple[str, ...],
        steps: Sequence[Any],
        within: str | int = PATIENCE_NS,
        tolerance: str | int | None = None,
    ) -> None:
        """Run until a tag has taken values one after another, and no other in between.

        Args:
            tag: a tag, or several as a tuple whose steps then are tuples of values.
            steps: values, or pairs ``(value, duration)`` of how long each is to stay. The first is
                the present one. The last one's duration is not looked at.
            within: how long the whole may take.
            tolerance: how much a duration may differ; by default one cycle of the task class.

        Raises:
            ExpectationFailed: another value came, a value came too early or too late, or the time
                is over.
        """
        Sequencer(self, tag, steps, tolerance).run(duration_ns(within, "within"))

    @property
    @abstractmethod
    def cycle_ns(self) -> int:
        """Cycle time of the task class under test."""


class TimeLimit:
    """How long a ``with`` block may take on the controller's clock.

    Attributes:
        elapsed_ns: how long it took.
    """

    def __init__(self, plc: Expectations, limit_ns: int) -> None:
        self.elapsed_ns = 0
        self._plc = plc
        self._limit_ns = limit_ns
        self._start_ns = plc.time_ns

    def rest_ns(self) -> int:
        """Return how much of the limit is left."""
        return max(0, self._start_ns + self._limit_ns - self._plc.time_ns)

    def __enter__(self) -> TimeLimit:
        self._start_ns = self._plc.time_ns
        self._plc._limits.append(self)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._plc._limits.remove(self)
        self.elapsed_ns = self._plc.time_ns - self._start_ns
        # until looks 1 ns beyond its end, so that a cycle released exactly there counts
        if kind is None and self.elapsed_ns > self._limit_ns + 1:
            self._plc.fail(
                f"expected the block to take {format_duration(self._limit_ns)} at most; it took "
                f"{format_duration(self.elapsed_ns)}",
                list(self._plc.tags.read)[-6:],
            )


class Sequencer:
    """Follows the values of tags through the steps of `Expectations.assert_sequence`."""

    def __init__(
        self,
        plc: Expectations,
        tag: str | tuple[str, ...],
        steps: Sequence[Any],
        tolerance: str | int | None,
    ) -> None:
        self._plc = plc
        self._paths = (tag,) if isinstance(tag, str) else tag
        self._name = " and ".join(self._paths)
        pairs = [self._pair(step, single=isinstance(tag, str)) for step in steps]
        if not pairs:
            raise PlcTestError("assert_sequence: at least one step is needed")
        self._steps = [self._raw(value) for value, _ in pairs]
        self._durations_ns = [span_ns for _, span_ns in pairs]
        self._tolerance_ns = (
            plc.cycle_ns if tolerance is None else duration_ns(tolerance, "tolerance")
        )

    def _pair(self, step: Any, *, single: bool) -> tuple[tuple[object, ...], int | None]:
        """Return the values of a step and its duration."""
        span: str | None = None
        timed = isinstance(step, tuple) and len(step) == 2 and isinstance(step[1], str)
        if timed and (single or isinstance(step[0], tuple)):
            step, span = step
        values = (step,) if single else tuple(step)
        if len(values) != len(self._paths):
            raise PlcTestError(f"assert_sequence: {step!r} does not fit the tags {self._name}")
        return values, None if span is None else duration_ns(span, "assert_sequence")

    def _raw(self, values: tuple[object, ...]) -> tuple[bytes, ...]:
        pairs = zip(self._paths, values, strict=True)
        return tuple(self._plc.tags.encode(path, value) for path, value in pairs)

    def _present(self) -> tuple[bytes, ...]:
        return tuple(self._plc.tags.raw(path) for path in self._paths)

    def _text(self, raw: tuple[bytes, ...]) -> str:
        pairs = zip(self._paths, raw, strict=True)
        return " and ".join(self._plc._text(path, data) for path, data in pairs)

    def run(self, limit_ns: int) -> None:
        """Run the controller through all steps."""
        plc = self._plc
        if self._present() != self._steps[0]:
            self._fail(0, f"it is {self._text(self._present())} at the start")
        begin_ns = since_ns = plc.time_ns
        for index, wanted in enumerate(self._steps[1:], 1):
            before = self._steps[index - 1]
            rest_ns = begin_ns + limit_ns - plc.time_ns
            if not plc.advance(max(1, rest_ns), partial(self._has_left, before)):
                self._fail(index, f"it was still {self._text(before)} at the end of the time")
            if self._present() != wanted:
                self._fail(index, f"{self._text(self._present())} came")
            self._check_duration(index - 1, plc.last_release_ns - since_ns)
            since_ns = plc.last_release_ns

    def _has_left(self, raw: tuple[bytes, ...]) -> bool:
        return self._present() != raw

    def _check_duration(self, index: int, seen_ns: int) -> None:
        wanted_ns = self._durations_ns[index]
        # the first step has begun before we looked, so it can only be too long
        too_short = index > 0 and wanted_ns is not None and seen_ns < wanted_ns - self._tolerance_ns
        if wanted_ns is None or not (too_short or seen_ns > wanted_ns + self._tolerance_ns):
            return
        self._fail(
            index,
            f"it stayed for {format_duration(seen_ns)} instead of {format_duration(wanted_ns)} "
            f"(tolerance {format_duration(self._tolerance_ns)})",
        )

    def _fail(self, index: int, what: str) -> NoReturn:
        whole = " → ".join(self._text(raw) for raw in self._steps)
        step = f"step {index + 1}, {self._text(self._steps[index])}"
        self._plc.fail(f"expected {self._name} to go {whole}; at {step}: {what}", self._paths)
