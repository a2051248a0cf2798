"""A native project made of an Automation Studio project runs as that one does."""

from pathlib import Path

import pytest

from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.cli.main import main
from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.system import State
from plcsim.core.tag import leaves
from plcsim.network import VirtualNetwork
from plcsim.project.assembly import assemble, load, runnable
from plcsim.project.native import write_native
from plcsim.project.plc_toml import read_project

BOTTLING = Path(__file__).parents[3] / "data" / "automation_studio" / "Bottling"
STEP_NS = 40_000_000


@pytest.fixture
def _a_compiler():
    try:
        find_toolchain()
    except ConfigurationError:
        pytest.skip("no compiler for C is installed")


def booted(project):
    application = load(project).in_process("192.168.0.1")
    clock = VirtualClock()
    network = VirtualNetwork(clock.now_ns).host("192.168.0.1")
    controller = assemble(application, clock=clock, network=network)
    controller.boot()
    controller.start()
    return controller


def values(controller):
    return {
        tag.path: controller.memory.read(tag.address, tag.data_type.size)
        for area in controller.areas
        for tag in leaves(area, elements=True)
    }


def trace(project, steps=50):
    """Return the bytes of all tags, step by step; an input is switched meanwhile."""
    controller = booted(project)
    found = [values(controller)]
    start = controller.tags.find("IoMap.X20DI9371.DigitalInput01")
    for step in range(steps):
        controller.memory.write(start.address, bytes([step // 5 % 2]))
        controller.run_for(STEP_NS)
        found.append(values(controller))
    assert controller.state is State.RUN
    return found


@pytest.mark.usefixtures("_a_compiler")
@pytest.mark.parametrize("configuration", ["Machine", "Simulation"])
def test_both_have_the_same_trace(tmp_path, configuration):
    folder = tmp_path / "native"
    project = read_project(BOTTLING, {"as": {"config": configuration}})
    write_native(project, folder)
    there, here = trace(runnable(project)), trace(read_project(folder))
    assert there[0].keys() == here[0].keys()
    moving = [path for path in there[0] if len({step[path] for step in there}) > 1]
    assert len(moving) > 5
    differ = [
        (at, path)
        for at, (one, other) in enumerate(zip(there, here, strict=True))
        for path in one
        if one[path] != other[path]
    ]
    assert differ == []


@pytest.mark.usefixtures("_a_compiler")
def test_it_holds_what_runs_and_says_what_is_left_out(tmp_path, capsys):
    folder = tmp_path / "native"
    assert main(["import-as", str(BOTTLING), str(folder), "--config", "Machine"]) == 0
    told = capsys.readouterr().out
    assert "Panel is left out: it is skipped or disabled" in told
    assert "the configuration Simulation is left out" in told
    names = {path.name for path in folder.rglob("*") if path.is_file()}
    assert {"plc.toml", "Main.c", "Cap.st", "Sum.c", "IoMap.iom"} <= names
    assert not {"Forgotten.st", "Main.ld", "Package.pkg", "Bottling.apj"} & names
    assert main(["check", str(folder)]) == 0


def test_a_folder_that_is_there_stays_as_it_is(tmp_path):
    (tmp_path / "mine.txt").write_text("mine")
    with pytest.raises(ConfigurationError, match="exists already; nothing was changed"):
        write_native(read_project(BOTTLING), tmp_path)
    assert [path.name for path in tmp_path.iterdir()] == ["mine.txt"]


def test_a_native_project_is_none_of_automation_studio(tmp_path):
    (tmp_path / "plc.toml").write_text('[task_class.1]\nprograms = ["main"]\n')
    with pytest.raises(ConfigurationError, match="is no Automation Studio project"):
        write_native(read_project(tmp_path), tmp_path / "native")
