"""[ros] on a controller: settings for its programs, a restart, no bridge without topics."""

from pathlib import Path

import pytest

from crosnode.plc.extension import EXTENSION
from crosnode.plc.in_process_master import InProcessMaster
from crosnode.plc.project import create_node, surroundings
from plcsim.cli.main import main
from plcsim.core.clock import VirtualClock
from plcsim.core.controller import Controller
from plcsim.core.system import State
from plcsim.network import VirtualNetwork
from plcsim.program.python.language import PythonCode
from plcsim.program.python.program import Program
from plcsim.program.setup import ProgramSetup, Setup, TaskClassSetup, make_controller
from plcsim.settings.table import Table
from st_types import BOOL, UDINT, var

MS = 1_000_000


CELL = """
from plcsim import Program
from st_types import BOOL, var

class Cell(Program):
    on = var(BOOL)

    def cyclic(self):
        pass
"""


class Talker(Program):
    __slots__ = ("node",)
    count = var(UDINT)
    broken = var(BOOL)

    def init(self) -> None:
        self.node = create_node(self.context, "talker", "chatter:=/other")
        self.node.register_publisher("chatter", "std_msgs/String")

    def cyclic(self) -> None:
        self.node.do_events_loop()
        self.count += 1
        if self.count == 100 and self.broken:
            raise ValueError("broken")


def controller(**values: object) -> Controller:
    clock = VirtualClock()
    host = VirtualNetwork(clock.now_ns).host("192.168.0.10")
    classes = [TaskClassSetup(1, MS, [ProgramSetup("talker", PythonCode(Talker))])]
    plc = make_controller(Setup(classes), network=host, clock=clock)
    table = Table(Path("plc.toml"), "ros", {"master": "embedded", "host": "127.0.0.1"} | values)
    settings = EXTENSION.in_process(EXTENSION.read(table), "")
    attachment = EXTENSION.attach(settings, plc)
    assert not attachment.exports
    return plc


def test_programs_get_the_settings_and_the_master_runs_in_the_scan() -> None:
    plc = controller(namespace="/cell")
    plc.boot()
    plc.run(cycles=100)
    node = plc.tasks[0].cyclic.__self__.node  # type: ignore[attr-defined]
    assert node.name == "/cell/talker"
    assert list(node.publishers) == ["/rosout", "/other"]
    assert node.is_registered
    assert node.now_ns == plc.context.release_ns
    assert node.statistics.last_ns > 0
    found = surroundings(plc.context)
    assert found
    assert found.epoch.ns == 0


def test_after_service_a_restart_makes_node_and_master_anew() -> None:
    plc = controller()
    plc.boot()
    first = plc.context.library(InProcessMaster)
    plc.tasks[0].cyclic.__self__.broken = True  # type: ignore[attr-defined]
    assert plc.run(cycles=200) is State.SERVICE
    assert plc.boot() is State.RUN
    plc.run(cycles=80)
    second = plc.context.library(InProcessMaster)
    assert second is not first
    assert "/talker" in str(second.master.get_system_state("/x"))
    plc.shutdown()


def test_without_topics_there_is_no_bridge() -> None:
    plc = controller()
    plc.boot()
    plc.run(cycles=50)
    state = plc.context.library(InProcessMaster).master.get_system_state("/x")
    assert "plc_bridge" not in str(state)


def check(tmp_path: Path, text: str) -> int:
    """Write a project with a table [ros] and let ``plcsim check`` say what it thinks."""
    (tmp_path / "cell").mkdir()
    (tmp_path / "cell" / "main.py").write_text(CELL)
    (tmp_path / "plc.toml").write_text(f'[task_class.1]\nprograms = ["cell"]\n[ros]\n{text}\n')
    return main(["check", str(tmp_path)])


@pytest.mark.parametrize(
    ("text", "error"),
    [
        (
            'publish."/on" = {tag = "cell.of", type = "std_msgs/Bool"}',
            "ros.publish./on: no tag 'cell.of'",
        ),
        (
            'subscribe."/on" = {tag = "cell.on", type = "std_msgs/String"}',
            "ros.subscribe./on: tag cell.on is BOOL, which does not go with string",
        ),
        (
            'publish."/on" = {tag = "cell.on", type = "std_srvs/SetBool"}',
            "ros.publish./on.type: std_srvs/SetBool is a service; topics have messages",
        ),
        (
            'publish."/on" = {tag = "cell.on", type = "std_msgs/Bol"}',
            "ros.publish./on.type: No message type std_msgs/Bol.",
        ),
    ],
)
def test_check_says_what_a_run_would(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, error: str
) -> None:
    assert check(tmp_path, text) == 1
    assert f"plcsim: {tmp_path}/plc.toml: {error}" in capsys.readouterr().err


def test_check_opens_nothing_and_needs_no_master(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = 'master = "http://nowhere:1/"\nbind = "192.0.2.1"\nhost = "nobody"\n'
    assert (
        check(tmp_path, f'{text}publish."/on" = {{tag = "cell.on", type = "std_msgs/Bool"}}') == 0
    )
    assert "on this host" not in capsys.readouterr().out


def test_only_an_embedded_master_outside_of_tests_is_a_service() -> None:
    def service(master: str, *, in_process: bool) -> str:
        table = Table(Path("plc.toml"), "ros", {"master": master})
        settings = EXTENSION.read(table)
        return EXTENSION.service(EXTENSION.in_process(settings, "") if in_process else settings)

    assert service("embedded", in_process=False) == "crosnode.plc.master_service"
    assert service("embedded", in_process=True) == ""
    assert service("http://localhost:11311/", in_process=False) == ""


def test_the_endpoint_is_the_uri_of_the_master() -> None:
    table = Table(Path("plc.toml"), "ros", {"master": "embedded", "master_port": 11411})
    assert EXTENSION.endpoint(EXTENSION.read(table)).endswith(":11411/")


def test_the_logbook_says_once_that_a_program_misses_its_master() -> None:
    plc = controller(master="http://192.168.0.99:11311/")
    plc.boot()
    plc.run(cycles=8_000)
    lines = [entry.text for entry in plc.logbook if entry.source == "ros"]
    assert lines == ["/talker: no master at http://192.168.0.99:11311/; trying on"]


def test_on_a_virtual_network_addresses_are_its_own_and_no_environment_counts() -> None:
    values = {"master": "http://robot:5/", "host": "robot", "bind": "10.0.0.1", "namespace": "/x"}
    settings = EXTENSION.read(Table(Path("plc.toml"), "ros", values))
    moved = EXTENSION.in_process(settings, "192.168.0.10")
    assert moved.master_uri == "http://192.168.0.1:11311/"
    assert (moved.host, moved.bind_ip, moved.table.namespace) == ("192.168.0.10", None, "/x")
    assert moved.environment == {}


def test_on_a_virtual_network_the_embedded_master_keeps_its_port() -> None:
    values = {"master": "embedded", "master_port": 12345}
    settings = EXTENSION.read(Table(Path("plc.toml"), "ros", values))
    moved = EXTENSION.in_process(settings, "192.168.0.10")
    assert moved.master_uri == "http://192.168.0.10:12345/"
