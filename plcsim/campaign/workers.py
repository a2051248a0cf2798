"""What runs in a worker of Dask: it unpacks the content once, and keeps processes that do the runs.

Each thread of a worker does one run at a time, in a process of its own (`plcsim.campaign.runner`).
"""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
from importlib.metadata import version
from multiprocessing import Pipe
from pathlib import Path
from typing import TYPE_CHECKING, Any

from distributed import WorkerPlugin, get_worker

from plcsim.campaign.errors import CampaignError
from plcsim.campaign.result import Result, RunOutcome
from plcsim.campaign.runner import HELD_BACK
from plcsim.host.signals import held_back

if TYPE_CHECKING:
    from collections.abc import Sequence

    from distributed import Worker

    from plcsim.campaign.content import Content
    from plcsim.campaign.result import PlannedRun

START_LIMIT_S = 120.0
"""A runner that has not imported the campaign by then is given up."""


class Runner:
    """A process that does runs.

    Args:
        file: of the campaign, unpacked.
        folder: the process' working directory.

    Raises:
        CampaignError: it does not start; the message says why.
    """

    def __init__(self, file: Path, folder: Path) -> None:
        self._connection, child = Pipe()
        arguments = [str(file), str(child.fileno()), str(os.getpid())]
        with held_back(HELD_BACK):
            self._process = subprocess.Popen(  # noqa: S603  # our own module
                [sys.executable, "-P", "-m", "plcsim.campaign.runner", *arguments],
                pass_fds=(child.fileno(),),
                cwd=folder,
                stdin=subprocess.DEVNULL,
            )
        child.close()
        self._await_start()

    def _await_start(self) -> None:
        try:
            wrong = self._receive(START_LIMIT_S)
        except (EOFError, OSError) as err:  # a TimeoutError is an OSError
            self.end()
            raise CampaignError(
                f"a process for the runs did not start: {str(err) or self._how_it_ended()}"
            ) from None
        if wrong:
            self.end()
            raise CampaignError(wrong)

    def perform(self, order: PlannedRun, limit_s: float) -> Result:
        """Do a run.

        Returns:
            Its result; `RunOutcome.HUNG` or `RunOutcome.CRASHED` where the process is no more.
        """
        try:
            self._connection.send(order)
            result: Result = self._receive(limit_s)
        except TimeoutError:
            self.end()
            return Result(order, RunOutcome.HUNG, f"took longer than {limit_s:g} s")
        except (EOFError, OSError):
            self.end()
            return Result(order, RunOutcome.CRASHED, f"its process ended: {self._how_it_ended()}")
        return result

    def _receive(self, limit_s: float) -> Any:
        if not self._connection.poll(limit_s):
            raise TimeoutError(f"nothing came within {limit_s:g} s")
        return self._connection.recv()

    @property
    def is_alive(self) -> bool:
        """Whether it can do another run."""
        return self._process.poll() is None

    def _how_it_ended(self) -> str:
        code = self._process.wait()
        return signal.Signals(-code).name if code < 0 else f"exit code {code}"

    def end(self) -> None:
        """End the process, whatever it does."""
        if self._process.poll() is None:
            self._process.kill()
        self._process.wait()
        self._connection.close()


class Installation(WorkerPlugin):  # type: ignore[misc]  # distributed is hardly typed
    """The content of a campaign on a worker, and the processes that run it there.

    Dask gives it to every worker, also to one that joins later.

    Args:
        content: what is unpacked.
    """

    def __init__(self, content: Content) -> None:
        self.name = plugin_name(content.name)
        self._content = content
        self._version = version("plcsim")

    def __getstate__(self) -> dict[str, Any]:
        """Return what travels: no process does."""
        return {"name": self.name, "_content": self._content, "_version": self._version}

    def setup(self, worker: Worker) -> None:
        """Unpack the content.

        Raises:
            CampaignError: the worker has another version of plcsim.
        """
        if version("plcsim") != self._version:
            raise CampaignError(
                f"the worker has plcsim {version('plcsim')}, this machine {self._version}"
            )
        self._folder = Path(tempfile.mkdtemp(prefix="plcsim-campaign-"))
        self._file = self._content.unpack(self._folder)
        self._lock = threading.Lock()
        self._idle: list[Runner] = []
        self._all: list[Runner] = []

    def teardown(self, worker: Worker) -> None:
        """End all processes, remove the content."""
        for runner in self._all:
            runner.end()
        shutil.rmtree(self._folder, ignore_errors=True)

    def perform(self, order: PlannedRun, limit_s: float) -> Result:
        """Do a run in a process that is free, or in a new one."""
        runner = self._take()
        result = runner.perform(order, limit_s)
        with self._lock:
            if runner.is_alive:
                self._idle.append(runner)
            else:
                self._all.remove(runner)
        return result

    def _take(self) -> Runner:
        with self._lock:
            if self._idle:
                return self._idle.pop()
        runner = Runner(self._file, self._folder)
        with self._lock:
            self._all.append(runner)
        return runner


def plugin_name(content_name: str) -> str:
    """Return the name that Dask knows the plugin of a content by."""
    return f"plcsim-campaign-{content_name}"


def perform(content_name: str, batch: Sequence[PlannedRun], limit_s: float) -> list[Result]:
    """Do runs, one after another; what a worker of Dask is asked for."""
    installation: Installation = get_worker().plugins[plugin_name(content_name)]
    return [installation.perform(order, limit_s) for order in batch]
