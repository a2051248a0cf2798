"""The live view beside a run on the virtual clock."""

import socket
from pathlib import Path

import pytest

from plcsim.process.supervisor import Supervisor
from plcsim.project.plc_toml import read_project
from plcsim.recorder.bag.reading import open_bag
from tests.ports import free_port

from .viewer import PAUSE, PAUSED, Viewer

pytest.importorskip("foxglove")
pytest.importorskip("websockets.sync.client")

MAIN = """
from plcsim import Program
from st_types import UDINT, var

class Cell(Program):
    count = var(UDINT)

    def cyclic(self):
        self.count += 1
"""


def test_a_viewer_stops_the_virtual_clock_and_the_bag_is_whole(tmp_path: Path) -> None:
    port = free_port()
    (tmp_path / "cell").mkdir()
    (tmp_path / "cell" / "main.py").write_text(MAIN)
    (tmp_path / "plc.toml").write_text(
        '[task_class.1]\ncycle = "10ms"\nprograms = ["cell"]\n'
        f'[record]\nfile = "run.bag"\nlive = {port}\n'
    )
    paused = []

    def look() -> None:
        with socket.socket() as probe:
            if paused or probe.connect_ex(("127.0.0.1", port)):
                return
        viewer = Viewer(port)
        viewer.press(PAUSE, 1.0)
        while (state := viewer.playback())[0] != PAUSED:
            pass
        paused.append(state)
        viewer.close()
        supervisor.stop()

    project = read_project(tmp_path)
    with Supervisor(project, virtual=True, serves=["record"], quiet=True) as supervisor:
        report = supervisor.wait(look)

    assert paused == [(PAUSED, 1.0)]
    with open_bag(tmp_path / "run.bag") as bag:
        cycles = [record.cycle for _, record in bag.records() if record.task_class]
    assert cycles == list(range(1, report["task_classes"][0]["cycles"] + 1))
