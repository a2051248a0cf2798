"""The watchdog: what the parent makes of a scan process that does not go on.

It looks at the scan from outside, again and again, and takes no time by itself: who looks hands in
what is to be seen and does what it says. The same heartbeat for too long means that the scan does
not go on. First the active program is interrupted by an exception; where nothing comes of that,
because the program is stuck inside a call or the scan hangs outside a program, the process is
killed. All transitions are in `TRANSITIONS`; docs/timing-model.md shows them as a picture.
"""

from __future__ import annotations

from enum import Enum
from typing import Final, NamedTuple

PATIENCE_NS = 1_000_000_000
"""A process that was told to do something has this long before it is killed."""

BLIND_NS = 100_000_000
"""Of a time in which nobody looked, so much counts: a watchdog that was stopped itself, with a
container that was frozen for example, has not seen that the scan did not go on."""


class Watch(Enum):
    """How the scan process stands with its parent."""

    STARTING = "the process starts"
    LOADING = "the programs are being loaded"
    RUNNING = "the heartbeat grows"
    STALLED = "the active program has been interrupted"
    ENDING = "the result is there, the process is about to end"
    KILLED = "the process was told to end at once"


class Sign(Enum):
    """What is seen of the scan process, or asked of it."""

    LOADS = "it has begun to load the programs"
    BEAT = "the heartbeat has grown"
    OVERDUE = "it has not grown for too long"
    DEAF = "nothing came of the interruption"
    RESULT = "the result is there"
    LINGERS = "the process does not end"
    GIVEN_UP = "somebody does not want to wait any longer"


TRANSITIONS: Final[dict[Watch, dict[Sign, Watch]]] = {
    Watch.STARTING: {
        Sign.LOADS: Watch.LOADING,
        Sign.RESULT: Watch.ENDING,
        Sign.OVERDUE: Watch.KILLED,
        Sign.GIVEN_UP: Watch.KILLED,
    },
    Watch.LOADING: {
        Sign.BEAT: Watch.RUNNING,
        Sign.RESULT: Watch.ENDING,
        Sign.OVERDUE: Watch.KILLED,
        Sign.GIVEN_UP: Watch.KILLED,
    },
    Watch.RUNNING: {
        Sign.OVERDUE: Watch.STALLED,
        Sign.RESULT: Watch.ENDING,
        Sign.GIVEN_UP: Watch.KILLED,
    },
    Watch.STALLED: {
        Sign.BEAT: Watch.RUNNING,
        Sign.DEAF: Watch.KILLED,
        Sign.RESULT: Watch.ENDING,
        Sign.GIVEN_UP: Watch.KILLED,
    },
    Watch.ENDING: {Sign.LINGERS: Watch.KILLED},
    Watch.KILLED: {},
}
"""Every transition; a sign that is not there changes nothing."""


_ONCE_LIMITED: Final = (Watch.STARTING, Watch.LOADING, Watch.RUNNING)


class Sight(NamedTuple):
    """What is to be seen of the scan process at one moment.

    Attributes:
        now_ns: when, on a clock that never jumps.
        heartbeat: of the status page.
        limit_ns: how long what it does now may take.
        has_started: it has begun to load the programs, or it has loaded them.
        has_result: it has left its result.
        waits_for_reader: it prints, and nobody takes it: that is no fault of the scan.
        processor_ns: processor time that it has had, where it could go on; None where it waits
            for something else, or nobody knows.
    """

    now_ns: int
    heartbeat: int
    limit_ns: int
    has_started: bool
    has_result: bool = False
    waits_for_reader: bool = False
    processor_ns: int | None = None


class Watchdog:
    """Judges what is seen of one scan process.

    Attributes:
        watch: where it stands.
        limit_ns: what was exceeded, where the process was interrupted or killed.
    """

    def __init__(self) -> None:
        self.watch = Watch.STARTING
        self.limit_ns = 0
        self._heartbeat = 0
        self._silent_ns = 0
        self._looked_ns: int | None = None
        self._processor_ns: int | None = None

    def look(self, sight: Sight) -> Sign | None:
        """Judge what is seen.

        Returns:
            the sign that led to another state, None where nothing changed. In STALLED the caller is
            to interrupt the active program, in KILLED to kill the process.
        """
        self._count_silence(sight)
        if self.watch in _ONCE_LIMITED:
            self.limit_ns = sight.limit_ns
        return self._enter(self._sign(sight))

    def give_up(self) -> Sign | None:
        """Note that somebody does not want to wait for the process any longer; see `look`."""
        return self._enter(Sign.GIVEN_UP)

    def _count_silence(self, sight: Sight) -> None:
        """Count the time since the last look, without what the host gave to others."""
        before_ns = sight.now_ns if self._looked_ns is None else self._looked_ns
        had_ns, has_ns = self._processor_ns, sight.processor_ns
        self._looked_ns, self._processor_ns = sight.now_ns, has_ns
        silent_ns = min(sight.now_ns - before_ns, BLIND_NS)
        if had_ns is not None and has_ns is not None:
            silent_ns = min(silent_ns, has_ns - had_ns)
        if not sight.waits_for_reader:
            self._silent_ns += silent_ns

    def _sign(self, sight: Sight) -> Sign | None:
        """Return what the sight means, None where it means nothing new."""
        if sight.has_result and self.watch is not Watch.ENDING:
            return Sign.RESULT
        if self.watch is Watch.STARTING and sight.has_started:
            return Sign.LOADS
        if sight.heartbeat != self._heartbeat:
            self._heartbeat = sight.heartbeat
            self._silent_ns = 0
            return Sign.BEAT
        match self.watch:
            case Watch.STARTING | Watch.LOADING | Watch.RUNNING if self._silent_ns > sight.limit_ns:
                return Sign.OVERDUE
            case Watch.STALLED if self._silent_ns > PATIENCE_NS:
                return Sign.DEAF
            case Watch.ENDING if self._silent_ns > PATIENCE_NS:
                return Sign.LINGERS
        return None

    def _enter(self, sign: Sign | None) -> Sign | None:
        entered = TRANSITIONS[self.watch].get(sign) if sign else None
        if entered is None:
            return None
        self.watch = entered
        self._silent_ns = 0
        return sign
