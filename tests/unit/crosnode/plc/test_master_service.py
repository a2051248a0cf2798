"""The embedded master as a process beside a real scan: found, killed, port taken, EXIT."""

import os
import signal
import socket
import subprocess
import sys
import threading
import time
import xmlrpc.client
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from tests.ports import free_port

PROGRAM = """
from crosnode.plc.project import create_node
from plcsim import Program

class Talker(Program):
    __slots__ = ("node",)

    def init(self):
        self.node = create_node(self.context, "talker")
        self.node.register_publisher("/chatter", "std_msgs/String")

    def cyclic(self):
        self.node.do_events_loop()

    def exit(self):
        call = self.node.set_param("/left", True)
        while not call.was_answered:  # no longer than init_timeout
            self.node.do_events_loop()
        self.node.destroy()
"""


class Site:
    """A project with its own master that runs under its supervisor in a thread."""

    def __init__(self, folder: Path, port: int) -> None:
        (folder / "talker").mkdir()
        (folder / "talker" / "main.py").write_text(PROGRAM)
        (folder / "plc.toml").write_text(
            f'[plc]\nrealtime = "off"\nwatchdog = "100s"\ninit_timeout = "100s"\n'
            f'[task_class.1]\ncycle = "2ms"\ntolerance = "10s"\n'
            f'programs = ["talker"]\n[ros]\nmaster = "embedded"\nhost = "127.0.0.1"\n'
            f"master_port = {port}\n"
        )
        self.port = port
        self.supervisor = Supervisor(read_project(folder))
        self.result: dict[str, Any] = {}
        self._thread = threading.Thread(target=self._wait)
        self._thread.start()

    def _wait(self) -> None:
        self.result = self.supervisor.wait()

    def stop(self) -> None:
        self.supervisor.stop()
        self._thread.join(100)

    def ask(self, method: str, *params: Any) -> Any:
        """Call the master; None where it does not answer."""
        proxy = xmlrpc.client.ServerProxy(f"http://127.0.0.1:{self.port}/")
        with proxy:
            try:
                return getattr(proxy, method)("/test", *params)[2]
            except (OSError, xmlrpc.client.Error):
                return None

    def knows_talker(self) -> bool:
        state = self.ask("getSystemState") or [[]]
        return ["/chatter", ["/talker"]] in state[0]


def await_(condition: Callable[[], object]) -> None:
    deadline = time.monotonic() + 100
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.fixture
def open_site(tmp_path: Path) -> Iterator[Callable[[int], Site]]:
    sites: list[Site] = []

    def make(port: int) -> Site:
        sites.append(Site(tmp_path, port))
        return sites[-1]

    yield make
    for site in sites:
        site.stop()
        site.supervisor.__exit__()


def test_after_a_kill_the_nodes_register_with_the_next_master(
    open_site: Callable[[int], Site], capfd: pytest.CaptureFixture[str]
) -> None:
    site = open_site(free_port())
    await_(site.knows_talker)
    first = site.ask("getPid")
    assert site.ask("getParam", "/run_id").startswith(f"plcsim-{first}-")
    os.kill(first, signal.SIGKILL)
    await_(lambda: site.ask("getPid") not in (first, None))
    await_(site.knows_talker)
    assert site.supervisor.services.starts == {"ros": 2}
    site.stop()
    assert site.result["state"] == "STOPPED"  # and EXIT had the master
    assert f"ros: master at http://127.0.0.1:{site.port}/" in capfd.readouterr().err


def test_a_port_in_use_is_told_once_and_tried_again(
    open_site: Callable[[int], Site], tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    told: list[str] = []

    def news() -> list[str]:
        told.extend(capfd.readouterr().err.splitlines())
        return told

    port = free_port()
    with socket.create_server(("127.0.0.1", port)):
        site = open_site(port)
        await_(news)
        time.sleep(1.5)  # one more attempt of the process
    await_(site.knows_talker)
    site.stop()
    file = tmp_path / "plc.toml"
    assert news() == [
        f"plcsim: {file}: ros.master_port: {port} is in use; trying on",
        f"ros: master at http://127.0.0.1:{port}/",
    ]
    assert site.supervisor.services.starts == {"ros": 1}


def test_the_scan_process_does_not_load_the_master() -> None:
    code = (
        "import sys; import plcsim.process.scan_process\n"
        "import crosnode.plc.extension, crosnode.plc.project\n"
        "assert 'crosnode.plc.settings' in sys.modules\n"
        "assert not {'crosnode.master.master', 'crosnode.master.server'} & sys.modules.keys()\n"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
