"""What is known of the frames: for each the way to its parent over time, bounded.

As in tf2: a lookup at time 0 is one at the newest time that all frames on the way have; between
two stamps is interpolated, and beyond them nothing is guessed.
"""

from __future__ import annotations

from bisect import bisect_right, insort
from typing import TYPE_CHECKING, Final, NamedTuple

from crosnode.errors import TransformError
from crosnode.tf.transform import Transform

if TYPE_CHECKING:
    from collections.abc import Iterable

CACHE_NS: Final = 10_000_000_000
"""Nanoseconds for which transforms are kept, as by tf2."""

MOST_FRAMES: Final = 1_000
MOST_STAMPS: Final = 2_000
"""Of each frame; the oldest goes first."""

MOST_LINKS: Final = 200
"""Frames on the way to a root; more are taken for a ring."""


class Stamped(NamedTuple):
    """Where a frame was at a time."""

    stamp_ns: int
    parent: str
    transform: Transform


class Frame:
    """One frame.

    Attributes:
        history: where it was, oldest first; a single entry where it is static.
        is_static: whether it is where it is at all times.
    """

    __slots__ = ("history", "is_static")

    def __init__(self, *, is_static: bool) -> None:
        self.history: list[Stamped] = []
        self.is_static = is_static

    def add(self, new: Stamped) -> None:
        """Take another stamp; one that is too old is passed over."""
        history = self.history
        if self.is_static:
            history[:] = [new]
            return
        if history and new.stamp_ns < history[-1].stamp_ns - CACHE_NS:
            return
        if not history or new.stamp_ns > history[-1].stamp_ns:
            history.append(new)
        else:
            insort(history, new, key=lambda each: each.stamp_ns)
        oldest = bisect_right(history, history[-1].stamp_ns - CACHE_NS - 1, key=_stamp)
        del history[: max(oldest, len(history) - MOST_STAMPS)]

    def at(self, time_ns: int, name: str) -> Stamped:
        """Return where the frame was.

        Raises:
            TransformError: the time is before or after all that is known.
        """
        history = self.history
        if self.is_static:
            return history[0]
        place = bisect_right(history, time_ns, key=_stamp)
        if place and history[place - 1].stamp_ns == time_ns:
            return history[place - 1]
        if not 0 < place < len(history):
            first, last = history[0].stamp_ns, history[-1].stamp_ns
            raise TransformError(f"{name}: known from {first} to {last} ns, asked for {time_ns}.")
        before, after = history[place - 1 : place + 1]
        if before.parent != after.parent:
            return before
        part = (time_ns - before.stamp_ns) / (after.stamp_ns - before.stamp_ns)
        return Stamped(time_ns, before.parent, before.transform.towards(after.transform, part))


def _stamp(entry: Stamped) -> int:
    return entry.stamp_ns


class TransformBuffer:
    """All frames that were told of.

    Attributes:
        frames: by name.
        refused: transforms that were not taken: too many frames, or a frame that is its own parent.
    """

    def __init__(self) -> None:
        self.frames: dict[str, Frame] = {}
        self.refused = 0
        self._names: set[str] = set()

    def add(
        self, parent: str, child: str, stamp_ns: int, transform: Transform, *, is_static: bool
    ) -> None:
        """Take a transform; names lose a leading slash, as in tf2."""
        parent, child = parent.lstrip("/"), child.lstrip("/")
        is_new = not {parent, child} <= self._names
        is_too_many = is_new and len(self._names) + 2 > MOST_FRAMES
        if not parent or not child or parent == child or is_too_many:
            self.refused += 1
            return
        self._names |= {parent, child}
        frame = self.frames.get(child)
        if frame is None or frame.is_static is not is_static:
            frame = self.frames[child] = Frame(is_static=is_static)
        frame.add(Stamped(stamp_ns, parent, transform))

    def clear(self) -> None:
        """Forget all that moves, for time went back."""
        self.frames = {name: each for name, each in self.frames.items() if each.is_static}

    def lookup(self, target: str, source: str, time_ns: int = 0) -> Transform:
        """Return what takes coordinates in ``source`` to coordinates in ``target``.

        Args:
            target: frame that coordinates are wanted in.
            source: frame that they are in.
            time_ns: nanoseconds since 1970; 0 for the newest time that the whole way has.

        Raises:
            TransformError: a frame is not known, there is no way between them, or not at that time.
        """
        target, source = target.lstrip("/"), source.lstrip("/")
        self._check_known((target, source))
        above = self._names_above(source), self._names_above(target)
        common = set(above[0]) & set(above[1])
        if not time_ns:
            time_ns = self._newest_common(above, common)
        ups, downs = (self._way(name, time_ns, common) for name in (source, target))
        names = {name: place for place, (name, _) in enumerate(downs)}
        for name, from_source in ups:
            if name in names:
                _, from_target = downs[names[name]]
                return from_target.inverse().after(from_source)
        raise TransformError(f"{target} and {source} have no frame in common above them.")

    def _check_known(self, names: Iterable[str]) -> None:
        for name in names:
            if name not in self._names:
                raise TransformError(f"no frame {name[:100]!r} is known.")

    def _way(self, name: str, time_ns: int, until: set[str]) -> list[tuple[str, Transform]]:
        """Return the frames from one upwards, each with what takes ``name`` to it."""
        way = [(name, Transform())]
        while name in self.frames and name not in until:
            if len(way) > MOST_LINKS:
                raise TransformError(f"the frames above {way[0][0]} are a ring.")
            found = self.frames[name].at(time_ns, name)
            way.append((found.parent, found.transform.after(way[-1][1])))
            name = found.parent
        return way

    def _newest_common(self, above: tuple[list[str], list[str]], common: set[str]) -> int:
        """Return the newest time that all frames which move below the common ones have."""
        stamps = [
            self.frames[name].history[-1].stamp_ns
            for names in above
            for name in names
            if name not in common and name in self.frames and not self.frames[name].is_static
        ]
        return min(stamps, default=0)

    def _names_above(self, name: str) -> list[str]:
        names = [name]
        while name in self.frames and len(names) <= MOST_LINKS:
            name = self.frames[name].history[-1].parent
            names.append(name)
        return names
