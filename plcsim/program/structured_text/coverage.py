"""What ran of compiled programs: lines and branches, for those who measure coverage.

While `MEASURING` is on, programs are compiled with counters, which take half of their speed and add
instructions. What can run in a file is kept beside the compiled code, by its text, so that a report
can be made later.
"""

from __future__ import annotations

import hashlib
import marshal
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from plcsim.program.structured_text.code_cache import code_cache
from plcsim.program.structured_text.codegen.generate import COUNTER
from plcsim.program.structured_text.codegen.instrument import OVERHEAD
from plcsim.program.structured_text.codegen.options import CodegenOptions

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable

    from plcsim.machine import Instance
    from plcsim.program.structured_text.codegen.profile import Counts, Profile

Way = tuple[int, int]


class Seen(NamedTuple):
    """What of a file there is, or what of it has run.

    Attributes:
        lines: those with statements.
        ways: from the line of a condition to the line that follows; below 0 the function that
            begins in that line is left.
    """

    lines: set[int]
    ways: set[Way]

    def add(self, other: Seen) -> None:
        """Take what another has."""
        self.lines.update(other.lines)
        self.ways.update(other.ways)


class CountedModule:
    """A module with counters on a controller.

    Args:
        task: whose module it is, "" for that of a library.
        profile: what its counters mean.
        instance: the module.

    Attributes:
        task: as above.
        profile: likewise.
        overhead: tells the instructions that counting has taken so far.
    """

    def __init__(self, task: str, profile: Profile, instance: Instance) -> None:
        self.task = task
        self.profile = profile
        self._instance = instance
        self.overhead = instance.variable(COUNTER.format(OVERHEAD))

    @cached_property
    def _counters(self) -> list[Callable[[], int]]:
        numbers = range(OVERHEAD + 1, OVERHEAD + 1 + self.profile.counters)
        return [self._instance.variable(COUNTER.format(number)) for number in numbers]

    def counts(self) -> Counts:
        """Return the values of all counters."""
        import numpy as np  # noqa: PLC0415  # 100 ms that those who count nothing do not need

        return np.array([counter() for counter in self._counters], np.int64)


class Measuring:
    """Whether programs are compiled with counters, and the modules with them, for coverage.

    Attributes:
        is_on: programs are compiled with counters from now on.
        is_collected: somebody collects what has run.
    """

    def __init__(self) -> None:
        self.is_on = False
        self.is_collected = False
        self._linked: list[CountedModule] = []

    @property
    def options(self) -> CodegenOptions:
        """How programs are compiled."""
        return CodegenOptions(counters=self.is_on)

    def link(self, module: CountedModule) -> None:
        """Note a module that was linked."""
        if self.is_collected:
            self._linked.append(module)

    def collect(self) -> dict[str, Seen]:
        """Return what has run, by file, and forget the modules."""
        found: dict[str, Seen] = {}
        for module in self._linked:
            profile, counts = module.profile, module.counts()
            for number, path in enumerate(profile.files):
                seen = Seen(profile.lines_run(number, counts), profile.ways_gone(number, counts))
                if profile.lines(number):
                    found.setdefault(path, Seen(set(), set())).add(seen)
        self._linked.clear()
        return found


MEASURING = Measuring()


def keep_possible(profile: Profile | None, texts: dict[str, str]) -> None:
    """Keep what can run, by the texts of the files.

    Args:
        profile: of a module.
        texts: of its files, by path.
    """
    if profile is None:
        return
    for number, path in enumerate(profile.files):
        if path in texts:
            seen = possible_in(texts[path]) or Seen(set(), set())
            seen.add(Seen(profile.lines(number), profile.ways(number)))
            data = marshal.dumps((sorted(seen.lines), sorted(seen.ways)))
            code_cache().store(_key(texts[path]), data)


def possible_in(text: str) -> Seen | None:
    """Return what can run in a file with this text, None where it was not compiled so far."""
    data = code_cache().load(_key(text))
    if data is None:
        return None
    lines, ways = marshal.loads(data)  # noqa: S302  # from the user's own cache, hashed
    return Seen(set(lines), set(ways))


def _key(text: str) -> str:
    digest = hashlib.blake2b(text.encode("utf-8", "surrogatepass"), digest_size=20)
    return f"coverage-{digest.hexdigest()}"


def exits_of(ways: Iterable[Way]) -> dict[int, int]:
    """Return how many ways lead from each line that has several."""
    counts: dict[int, int] = {}
    for line, _ in ways:
        counts[line] = counts.get(line, 0) + 1
    return counts
