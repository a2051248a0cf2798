import pytest

from plcsim.project.automation_studio.io_channels import channels_type, unmapped
from plcsim.project.automation_studio.mapping import Channel, Pv
from plcsim.project.plc_toml import read_project
from plcsim.testing.target import open_plc
from st_types import BOOL, DINT, INT, REAL, UDINT, UINT

MODULES_ARE_THERE = """
PROGRAM _CYCLIC
    IF a AND b THEN
        good := good + 1;
    END_IF
END_PROGRAM
"""
TYPES = {"level": INT, "speed": REAL, "wide": DINT}


def channel(name, direction, width, variable="x", module="M"):
    return Channel(Pv("", variable), direction, width, module, name, False, "io.iom:1")


def test_a_channel_has_the_width_of_its_letter_and_the_type_of_its_variable():
    channels = [
        channel("out", "Q", "W", "wide"),
        channel("flag", "I", "X"),
        channel("level", "I", "W", "level"),
        channel("level", "I", "W", "other"),
        channel("speed.Sub", "I", "D", "speed"),
        channel("raw", "I", "D", module="8I64.00x-1"),
    ]
    found = channels_type(channels, lambda pv: TYPES.get(pv.path))
    modules = {member.name: member.data_type for member in found.members}
    assert list(modules) == ["M", "8I64_00x_1"]
    assert [(each.name, each.data_type) for each in modules["M"].members] == [
        ("flag", BOOL),
        ("level", INT),
        ("speed_Sub", REAL),
        ("out", UINT),
    ]
    assert list(modules.values())[1].members[0].data_type is UDINT


def test_no_channels_no_type():
    assert channels_type([], lambda _pv: None) is None


@pytest.fixture
def plc(project):
    """A program that counts cycles in which two modules are there."""
    folder = project(
        {
            "plc.toml": '[task_class.1]\nprograms = ["main"]\n[io]\nchannels = ["io.iom"]\n',
            "main/Main.st": MODULES_ARE_THERE,
            "main/Main.var": "VAR\na, b, c : BOOL;\ngood : UDINT;\nEND_VAR",
            "io.iom": """VAR_CONFIG
                ::main:a AT %IX."X20DI".ModuleOk;
                ::main:b AT %IX."X20DO".ModuleOk;
                ::main:c AT %IX."X20DI".DigitalInput01;
                END_VAR""",
        }
    )
    with open_plc(project=folder) as plc:
        yield plc


def test_modules_say_that_they_are_there_until_somebody_takes_them_out(plc):
    plc.run("100ms")
    assert (plc["main.a"], plc["main.b"], plc["main.c"]) == (True, True, False)
    assert plc["main.good"] == 10
    assert "ModuleOk of 2 modules is simulated: TRUE" in [e.text for e in plc.controller.logbook]
    plc["IoMap.X20DO.ModuleOk"] = False
    plc.run("100ms")
    assert plc["main.good"] == 10
    plc.restart()
    plc.run("100ms")
    assert plc["main.good"] == 10


def test_what_is_mapped_and_not_there_or_does_not_fit_is_told_with_its_line(project):
    folder = project(
        {
            "plc.toml": """
                [task_class.1]
                programs = ["main"]
                [io]
                channels = ["io.iom"]
                copies = ["pv.vvm"]
                permanent = ["cpu.per"]
                """,
            "main/Main.st": MODULES_ARE_THERE,
            "main/Main.var": "VAR\na, b : BOOL;\ngood : UDINT;\nEND_VAR",
            "io.iom": """VAR_CONFIG
                ::main:a AT %IX."X20DI".DigitalInput01;
                ::main:gone AT %IX."X20DI".DigitalInput02;
                ::main:good AT %IW."X20AI".AnalogInput01;
                END_VAR""",
            "pv.vvm": """VAR_CONFIG
                ::main:a AT %Q.::nowhere;
                ::main:a AT %Q.::main:good;
                ::main:a AT %Q.::main:b;
                END_VAR""",
            "cpu.per": "VAR_CONFIG\nlost AT %MD0;\nEND_VAR",
        }
    )
    expected = [
        'io.iom:3: warning: there is no variable main.gone for %IX."X20DI".DigitalInput02',
        'io.iom:4: warning: main.good has 4 bytes and %IW."X20AI".AnalogInput01 2: 2 are copied',
        "pv.vvm:2: warning: there is no variable nowhere",
        "pv.vvm:3: warning: main.a and main.good differ in size, nothing is copied",
        "cpu.per:2: warning: there is no variable lost",
    ]
    with open_plc(project=folder) as plc:
        told = [entry.text.removeprefix(f"{folder}/") for entry in plc.controller.logbook]
        assert told[: len(expected)] == expected
        assert len(unmapped(plc.controller, read_project(folder).maps)) == len(expected)
