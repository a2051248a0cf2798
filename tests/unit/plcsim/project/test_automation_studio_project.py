"""plc.toml beside an Automation Studio project, and none."""

from pathlib import Path

import pytest

from plcsim.core.errors import ConfigurationError
from plcsim.project.plc_toml import AUTOMATION_STUDIO_MEMORY, read_project

BOTTLING = Path(__file__).parents[3] / "data" / "automation_studio" / "Bottling"
US = 1_000


@pytest.fixture
def read(tmp_path):
    """``read(text)``: the project of a plc.toml that names the project Bottling."""

    def read(text, first=f'project = "{BOTTLING}"'):
        (tmp_path / "plc.toml").write_text(f"{first}\n{text}")
        return read_project(tmp_path)

    return read


def names(project):
    return [entry.name for entry in project.programs]


@pytest.mark.parametrize("path", [BOTTLING, BOTTLING / "Bottling.apj"])
def test_a_project_without_plc_toml(path):
    found = read_project(path)
    assert (found.name, found.plc.tick_ns) == ("Bottling", 800 * US)
    assert found.plc.memory_size == AUTOMATION_STUDIO_MEMORY
    assert [(c.number, c.cycle_ns, c.tolerance_ns) for c in found.classes] == [
        (1, 800 * US, 0),
        (2, 8000 * US, 8000 * US),
        (4, 80_000 * US, 80_000 * US),
    ]
    assert found.layout.stubs == {"*"}
    assert [each.name for each in found.layout.libraries if each.is_vendor] == [
        *("standard", "MpBase", "MpAlarm")
    ]


def test_plc_toml_chooses_skips_adds_and_counts_more(read, tmp_path):
    (tmp_path / "plant").mkdir()
    found = read(
        """
        [plc]
        memory = "1MiB"
        [as]
        config = "simulation"
        skip = ["PANEL"]
        [libraries]
        stub = ["MpBase"]
        [simulate.MpAlarmCore]
        Active = "Enable"
        [task_class.2]
        cycle = "16ms"
        programs = ["plant"]
        """
    )
    assert found.automation_studio.configuration.name == "Simulation"
    assert names(found) == [
        "Clock",
        "FillStatio",
        "ValveA",
        "ValveB",
        "Boiler",
        "Motor",
        "Mixer",
        "Washer",
        "Sorter",
        "plant",
        "Count",
    ]
    assert found.classes[1].cycle_ns == 16_000 * US
    assert found.plc.memory_size == 1 << 20
    assert (found.layout.stubs, found.layout.folder) == ({"mpbase"}, tmp_path.resolve())
    assert found.layout.simulate == {"MpAlarmCore": {"Active": "Enable"}}
    assert found.layout.programs["plant"].folder == tmp_path.resolve() / "plant"


def test_everything_that_is_wrong_is_told(read):
    with pytest.raises(ConfigurationError) as raised:
        read('[as]\nskp = []\n[task_class.9]\ncycle = "1ms"\n')
    assert [text.partition("plc.toml: ")[2] for text in raised.value.findings] == [
        "as.skp: unknown key; did you mean skip?",
        "task_class.9: task classes are [task_class.1] to [task_class.8]",
    ]
    with pytest.raises(ConfigurationError, match=r"simulate\.A\.x: \[\] is neither the name of"):
        read("[simulate.A]\nx = []")
    with pytest.raises(ConfigurationError, match=r"simulate\.A\.x: \[1\] is neither the name of"):
        read("[simulate.A]\nx = [1]")
    assert read('[simulate.A]\nx = ["Load", "Save"]').layout.simulate["A"] == {
        "x": ["Load", "Save"]
    }
    with pytest.raises(ConfigurationError, match="project: there is no such folder"):
        read("", 'project = "nowhere"')
    with pytest.raises(ConfigurationError, match="as: there is no Automation Studio project here"):
        read("[as]\nskip = []", "")


def test_a_project_without_programs_says_what_is_wrong_in_its_files(tmp_path):
    (tmp_path / "Logical").mkdir()
    (tmp_path / "Line.apj").write_text("<Project/>")
    (tmp_path / "Logical" / "Package.pkg").write_text("<Package>\n<Obj")
    with pytest.raises(ConfigurationError) as raised:
        read_project(tmp_path)
    first, second, *_ = raised.value.findings
    assert first.endswith("no task runs: the logical view has no program")
    assert second.endswith("Package.pkg:2: error: it is no XML: unclosed token")


def test_a_configuration_without_tasks_names_the_others(read):
    tasks = "Clock FillStatio ValveA ValveB Boiler Motor Mixer Washer Sorter Count"
    skip = str(tasks.split())
    with pytest.raises(ConfigurationError, match="no task runs in the configuration Machine"):
        read(f"[as]\nskip = {skip}")
