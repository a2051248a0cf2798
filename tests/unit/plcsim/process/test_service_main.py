"""The main of service processes: what a service gets, how it ends, with whom it dies."""

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from plcsim import Program
from plcsim.core.clock import VirtualClock
from plcsim.process.service_main import ServiceOrder
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.shared_image import ImageWriter
from plcsim.shared_image.layout import make_file
from plcsim.shared_image.status_page import ServiceState, StatusPage

WAITS = """
    import select

    def serve(service):
        service.serving(f"here with {service.given}")
        service.serving(f"here with {service.given}")
        select.select([service.stop_fd], [], [])
        assert service.is_stopping
        print("over", flush=True)
"""
REFUSES = """
    from plcsim.core.errors import ConfigurationError

    def serve(service):
        raise ConfigurationError("web.port: 80 is in use")
"""


class World:
    """An image, a status page, and service processes beside them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.page = StatusPage()
        self.image_fd = make_file()
        self.started: list[subprocess.Popen[str]] = []

    @property
    def pass_fds(self) -> tuple[int, int]:
        return self.image_fd, self.page.fd

    def lay_out(self) -> None:
        setup = Setup([TaskClassSetup(1, 1_000_000, [ProgramSetup("p", PythonCode(Program))])])
        network: Any = None
        controller = make_controller(setup, network=network, clock=VirtualClock())
        ImageWriter(self.image_fd, controller, project="cell", services={"web": 4321})

    def command(self, source: str, *, parent: int, quiet: bool = False) -> list[str]:
        (self.folder / "service_for_tests.py").write_text(textwrap.dedent(source))
        order = ServiceOrder("web", 3, parent, self.image_fd, self.page.fd, -1, quiet)
        main = "plcsim.process.service_main"
        return [sys.executable, "-P", "-m", main, "service_for_tests", order.to_json()]

    def start(self, source: str, *, quiet: bool = False) -> subprocess.Popen[str]:
        process = subprocess.Popen(
            self.command(source, parent=os.getpid(), quiet=quiet),
            pass_fds=self.pass_fds,
            env={**os.environ, "PYTHONPATH": str(self.folder)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        self.started.append(process)
        return process

    def await_state(self, state: ServiceState) -> None:
        await_(lambda: self.page.service_state(3) is state)


def await_(condition: Callable[[], object]) -> None:
    deadline = time.monotonic() + 100
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.005)


@pytest.fixture
def world(tmp_path: Path) -> Iterator[World]:
    made = World(tmp_path)
    yield made
    for process in made.started:
        process.kill()
        process.communicate()
    os.close(made.image_fd)
    made.page.close()


def test_a_service_is_given_its_part_says_once_where_it_is_and_ends_when_asked(
    world: World,
) -> None:
    world.lay_out()
    process = world.start(WAITS)
    world.await_state(ServiceState.SERVING)
    assert world.page.has_served(3)
    process.terminate()
    assert process.communicate(timeout=100) == ("over\n", "web: here with 4321\n")
    assert process.returncode == 0


def test_a_quiet_one_says_nothing(world: World) -> None:
    world.lay_out()
    process = world.start(WAITS, quiet=True)
    world.await_state(ServiceState.SERVING)
    process.send_signal(signal.SIGINT)
    assert process.communicate(timeout=100) == ("over\n", "")


def test_one_that_cannot_serve_says_why_and_gives_up(world: World) -> None:
    world.lay_out()
    process = world.start(REFUSES, quiet=True)
    assert process.communicate(timeout=100) == ("", "plcsim: web.port: 80 is in use\n")
    assert process.returncode == 1
    assert world.page.service_state(3) is ServiceState.FAILING
    assert not world.page.has_served(3)


def test_it_waits_for_an_image_that_is_being_laid_out(world: World) -> None:
    world.start(WAITS)
    time.sleep(0.2)
    assert world.page.service_state(3) is ServiceState.STARTING
    world.lay_out()
    world.await_state(ServiceState.SERVING)


@pytest.mark.parametrize("wait_s", [0.0, 0.02, 0.05, 0.1, 0.2])
def test_it_dies_with_a_parent_that_dies_while_it_starts(world: World, wait_s: float) -> None:
    world.lay_out()
    command = world.command(WAITS, parent=0)[:-1]
    code = f"""if True:
        import os, subprocess, sys, time
        from plcsim.process.service_main import ServiceOrder

        order = ServiceOrder("web", 3, os.getpid(), {world.image_fd}, {world.page.fd}, -1)
        child = subprocess.Popen([*{command}, order.to_json()], pass_fds={world.pass_fds})
        print(child.pid, flush=True)
        time.sleep({wait_s})
        os._exit(0)
    """
    parent = subprocess.run(
        [sys.executable, "-c", code],
        pass_fds=world.pass_fds,
        env={**os.environ, "PYTHONPATH": str(world.folder)},
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        check=True,
    )
    child = int(parent.stdout.split()[0])
    await_(lambda: not Path(f"/proc/{child}").exists())
