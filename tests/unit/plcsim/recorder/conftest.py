from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from plcsim import Program
from plcsim.core.clock import Clock, VirtualClock
from plcsim.core.controller import Controller
from plcsim.network import Network, VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup
from plcsim.project.assembly import VIRTUAL_IP, Application, assemble
from plcsim.recorder.settings import RecordProject, RecordSettings
from st_types import BOOL, REAL, STRING, UDINT, UINT, var

MS = 1_000_000


class Fast(Program):
    """Counts, and doubles what it is told."""

    count = var(UDINT)
    told = var(UINT)
    doubled = var(UINT)
    lamp = var(BOOL)
    name = var(STRING(11), "fast")

    def cyclic(self) -> None:
        self.count += 1
        self.doubled = (2 * self.told) & 0xFFFF
        self.lamp = not self.lamp


class Slow(Program):
    level = var(REAL, 1.5)

    def cyclic(self) -> None:
        self.level = self.level * 0.5 + 1.0


def application_of(
    *programs: type[Program], extensions: dict[str, Any] | None = None
) -> Application:
    """Return a controller with a task class of 10 ms, 20 ms, ... for each program."""
    classes = [
        TaskClassSetup(
            number, 10 * number * MS, [ProgramSetup(program.__name__, PythonCode(program))], 10 * MS
        )
        for number, program in enumerate(programs, 1)
    ]
    return Application("project", Setup(classes), extensions or {})


class Recordings:
    """Runs controllers on the virtual clock and records them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def __call__(
        self,
        file: str,
        application: Application,
        *,
        cycles: int = 20,
        act: Callable[[Controller], None] = lambda _: None,
        network: Network | None = None,
        clock: Clock | None = None,
        **settings: Any,
    ) -> Path:
        """Record ``cycles`` twice, with ``act`` between them; return the bag."""
        record = RecordProject(
            RecordSettings(file=file, **settings), self.folder, is_in_process=True
        )
        application = replace(application, extensions={**application.extensions, "record": record})
        clock = clock or VirtualClock()
        net = network or VirtualNetwork(clock.now_ns).host(VIRTUAL_IP)
        controller = assemble(application, clock=clock, network=net)
        controller.boot()
        controller.start()
        controller.run(cycles=cycles)
        act(controller)
        controller.run(cycles=cycles)
        controller.shutdown()
        controller.close()
        return record.file


@pytest.fixture
def recordings(tmp_path: Path) -> Recordings:
    return Recordings(tmp_path)
