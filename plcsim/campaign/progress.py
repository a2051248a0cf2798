"""What a person sees while a campaign runs: how far, how fast, how many failures, how long yet."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, Final

from rich import progress

from plcsim.campaign.result import RunOutcome

if TYPE_CHECKING:
    from types import TracebackType

    from plcsim.campaign.cluster import Cluster
    from plcsim.campaign.result import Result
    from plcsim.cli.console import CommandConsole

PIPE_PERIOD_S: Final = 5.0
"""Between two lines where no terminal is."""


class ProgressBar:
    """A bar on a terminal, a line now and then in a pipe.

    Args:
        console: where it is shown.
        runs: of the whole campaign.
        done: before.
        cluster: that does the others.
    """

    def __init__(self, console: CommandConsole, runs: int, done: int, cluster: Cluster) -> None:
        self._console, self._runs, self._done, self._cluster = console, runs, done, cluster
        self._started_s = self._told_s = time.monotonic()
        self._new = self._failed = 0
        self._bar = progress.Progress(
            progress.TextColumn("{task.completed}/{task.total} runs"),
            progress.BarColumn(),
            progress.TextColumn("{task.fields[rate]}"),
            progress.TextColumn("{task.fields[failed]} failed", style="red"),
            progress.TimeRemainingColumn(),
            console=console,
            disable=not console.is_terminal,
        )
        self._task = self._bar.add_task("", total=runs, completed=done, rate="", failed=0)

    def __enter__(self) -> ProgressBar:
        """Show it."""
        self._bar.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        _error: BaseException | None,
        _trace: TracebackType | None,
    ) -> None:
        """Leave the last state there; say what comes of an interruption."""
        self._bar.stop()
        if not self._console.is_terminal and self._new:
            self._tell()
        if kind is KeyboardInterrupt:
            self._console.print("interrupted; the same command goes on from here")

    def add(self, result: Result) -> None:
        """Take note of a run that is done."""
        self._new += 1
        self._failed += result.outcome is not RunOutcome.PASSED
        now_s = time.monotonic()
        rate = f"{self._new / max(now_s - self._started_s, 1e-3):.1f}/s"
        rate += f" on {self._cluster.processors}"
        self._bar.update(self._task, advance=1, rate=rate, failed=self._failed)
        if not self._console.is_terminal and now_s - self._told_s >= PIPE_PERIOD_S:
            self._told_s = now_s
            self._tell()

    def _tell(self) -> None:
        span_s = max(time.monotonic() - self._started_s, 1e-3)
        self._console.print(
            f"{self._done + self._new}/{self._runs} runs, {self._failed} failed, "
            f"{self._new / span_s:.1f}/s"
        )
