"""A controller in this process that commands take for a run of a project."""

import os
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from plcsim.core.clock import VirtualClock
from plcsim.core.controller import Controller
from plcsim.core.tag import Tag
from plcsim.network import VirtualNetwork
from plcsim.process.run_file import Run, announce
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.shared_image import ImageWriter
from plcsim.shared_image.layout import make_file
from plcsim.shared_image.status_page import StatusPage


@contextmanager
def run_of(
    folder: Path, program: type[Program], exports: Callable[[Controller], list[Tag]] = lambda _: []
) -> Iterator[Controller]:
    """Run a program as ``cell`` for seven cycles, and leave it to `cycling` to go on."""
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    setup = Setup([TaskClassSetup(1, 1_000_000, [ProgramSetup("cell", PythonCode(program))])])
    page = StatusPage()
    plc = make_controller(setup, network=network, clock=clock, heartbeat=page)
    fd = make_file()
    ImageWriter(fd, plc, project="cell", services={}, exports=exports(plc))
    plc.boot()
    plc.run(cycles=7)
    (folder / "plc.toml").touch()
    announce(folder, Run(os.getpid(), fd, page.fd))
    yield plc
    os.close(fd)
    page.close()


@contextmanager
def cycling(plc: Controller) -> Iterator[None]:
    """Let the controller do cycles beside what the block does."""
    done = threading.Event()

    def cycle() -> None:
        while not done.is_set():
            plc.run(cycles=1)
            time.sleep(0.001)

    thread = threading.Thread(target=cycle)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()
