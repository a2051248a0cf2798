"""The table [operator]: inputs, tags that follow, steps."""

import pytest

from plcsim.core.clock import VirtualClock
from plcsim.core.errors import ConfigurationError
from plcsim.core.logbook import Severity
from plcsim.network import VirtualNetwork
from plcsim.operator.extension import EXTENSION
from plcsim.operator.settings import FollowSettings, OperatorSettings, StepSettings
from plcsim.project.assembly import assemble, load
from plcsim.project.plc_toml import read_project

MS = 1_000_000

MACHINE = """
PROGRAM _INIT
    seen_by_init := ok;
END_PROGRAM

PROGRAM _CYCLIC
    cycles := cycles + 1;
    IF start THEN
        running := TRUE;
    END_IF
    valve := running;
    IF limit AND NOT was_limit THEN
        reached := cycles;
    END_IF
    was_limit := limit;
    level := level + 1;
END_PROGRAM
"""
VARIABLES = """
VAR
    ok, seen_by_init, start, running, valve, limit, was_limit, closed : BOOL;
    cycles, reached, level : UDINT;
END_VAR
VAR CONSTANT
    LARGEST : UDINT := 10;
END_VAR
"""


@pytest.fixture
def controller(project):
    """``controller(table)``: a controller with the table, booted and started."""

    def make(table="", *, is_test=False):
        folder = project(
            {
                "plc.toml": f'[task_class.1]\ncycle = "10ms"\nprograms = ["main"]\n{table}',
                "main/Main.st": MACHINE,
                "main/Main.var": VARIABLES,
            }
        )
        application = load(read_project(folder)).in_process("192.168.0.1", is_test=is_test)
        clock = VirtualClock()
        network = VirtualNetwork(clock.now_ns).host("192.168.0.1")
        made = assemble(application, clock=clock, network=network)
        made.boot()
        made.start()
        return made

    return make


def value(controller, path):
    return controller.tags.read(controller.tags.find(path))


def warnings(controller):
    return [e.text for e in controller.logbook if e.severity is Severity.WARNING]


def test_inputs_are_there_for_init_and_in_every_cycle(controller):
    plc = controller('[operator.inputs]\n"main.ok" = true\n"main.level" = 5\n')
    plc.run_for(100 * MS)
    assert value(plc, "main.seen_by_init") is True
    assert value(plc, "main.level") == 6
    assert "main.ok is simulated: True" in warnings(plc)


def test_a_tag_follows_another_after_its_time(controller):
    plc = controller(
        '[operator.inputs]\n"main.start" = true\n'
        '[operator.follow]\n"main.limit" = { of = "main.valve", after = "50ms" }\n'
        '"main.closed" = { of = "main.valve", inverse = true }\n'
    )
    plc.run_for(10 * MS)
    assert value(plc, "main.closed") is True
    plc.run_for(10 * MS)
    assert value(plc, "main.closed") is False
    plc.run_for(100 * MS)
    assert value(plc, "main.reached") == 7  # it is on after cycle 1, seen in 2, and 5 cycles later
    assert "main.closed is simulated: follows the opposite of main.valve" in warnings(plc)


def test_what_does_not_last_is_not_followed(controller):
    plc = controller(
        '[operator.follow]\n"main.limit" = { of = "main.start", after = "50ms" }\n'
        '[[operator.step]]\nset = { "main.start" = true }\nfor = "40ms"\n'
    )
    plc.run_for(1_000 * MS)
    assert value(plc, "main.running") is True
    assert value(plc, "main.reached") == 0


def test_steps_come_one_after_another(controller):
    plc = controller(
        '[[operator.step]]\nafter = "50ms"\nset = { "main.start" = true }\nfor = "20ms"\n'
        '[[operator.step]]\nafter = "10ms"\nwhen = { "main.cycles" = 20, "main.start" = false }\n'
        'set = { "main.level" = 1000 }\n'
    )
    plc.run_for(45 * MS)
    assert value(plc, "main.running") is False
    plc.run_for(20 * MS)
    assert (value(plc, "main.start"), value(plc, "main.running")) == (True, True)
    plc.run_for(20 * MS)
    assert value(plc, "main.start") is False
    plc.run_for(500 * MS)
    assert value(plc, "main.level") == 1000 + value(plc, "main.cycles") - 20
    told = [e.text for e in plc.logbook if e.source == "operator"]
    assert told == [
        "2 steps of an operator are simulated",
        "main.start := True",
        "main.level := 1000",
    ]


def test_steps_may_repeat_and_a_restart_begins_with_the_first(controller):
    plc = controller(
        "[operator]\nrepeat = true\n"
        '[[operator.step]]\nafter = "100ms"\nset = { "main.level" = 0 }\n'
    )
    plc.run_for(1_000 * MS)
    assert 1 <= value(plc, "main.level") <= 11
    told = sum(1 for e in plc.logbook if e.text == "main.level := 0")
    assert told == 9
    plc.shutdown()
    plc.boot()
    plc.start()
    plc.run_for(95 * MS)
    assert value(plc, "main.level") == 9


def test_a_run_that_repeats_for_long_does_not_fill_the_logbook(controller):
    plc = controller('[operator]\nrepeat = true\n[[operator.step]]\nset = { "main.level" = 0 }\n')
    plc.run_for(3_000 * MS)
    told = [e.text for e in plc.logbook if e.text.startswith("main.level := 0")]
    assert len(told) == 100
    assert told[-1] == "main.level := 0; further ones are not told"


def test_what_is_set_is_told_to_those_who_follow_stores(controller):
    plc = controller('[[operator.step]]\nset = { "main.start" = true }\n')
    told = []
    plc.image.followers.append(lambda address, data: told.append((address, data)))
    plc.run_for(50 * MS)
    assert told == [(plc.tags.find("main.start").address, b"\x01")]


def test_in_a_test_the_test_is_the_operator(controller):
    table = (
        '[operator.inputs]\n"main.ok" = true\n[[operator.step]]\nset = { "main.start" = true }\n'
    )
    plc = controller(table, is_test=True)
    plc.run_for(100 * MS)
    assert (value(plc, "main.ok"), value(plc, "main.running")) == (True, False)


def test_everything_wrong_is_told_in_one_go(controller):
    with pytest.raises(ConfigurationError) as raised:
        controller(
            '[operator.inputs]\n"main.o" = true\n"main.LARGEST" = 1\n"main.level" = "much"\n'
            '[operator.follow]\n"main.limit" = { of = "main.level" }\n'
            '"main.level" = { of = "main.cycles", inverse = true }\n'
            '"main.LARGEST" = { of = "main.cycles" }\n'
            '[[operator.step]]\nset = { "main.ok" = true }\n'
            '[[operator.step]]\nwhen = { "main.nix" = 1 }\nset = { "main.level" = -1 }\n'
        )
    found = [text.replace("plc.toml: ", "", 1) for text in raised.value.findings]
    assert [text.partition(": ")[0] for text in found] == [
        "operator.inputs",
        "operator.inputs",
        "operator.inputs",
        "operator.follow.main.limit",
        "operator.follow.main.level.inverse",
        "operator.follow.main.LARGEST",
        "operator.step 2",
        "operator.step 2",
    ]
    assert "main.ok" in found[0]
    assert found[1].endswith("tag main.LARGEST is CONSTANT")
    assert found[3].endswith("is BOOL, and main.level is UDINT")


@pytest.mark.parametrize(
    ("table", "text"),
    [
        ("[[operator.step]]\nafter = '1s'\n", "operator.step.set: is missing"),
        ("[[operator.step]]\nset = {}\nfor = '0s'\n", "operator.step.for: must be above 0"),
        ("[operator.follow]\n'a.b' = 'c.d'\n", "operator.follow.a.b: 'c.d' is not a table"),
        ("[operator]\nstep = 5\n", "operator.step: 5 is not a list"),
        ("[operator]\nsteps = []\n", "operator.steps: unknown key"),
    ],
)
def test_a_wrong_table_is_told_with_its_field(project, table, text):
    folder = project({"plc.toml": f'[task_class.1]\nprograms = ["main"]\n{table}'})
    with pytest.raises(ConfigurationError) as raised:
        read_project(folder)
    assert text in str(raised.value)


def test_check_finds_what_the_table_has_wrong(controller):
    plc = controller()
    assert EXTENSION.check(OperatorSettings(inputs={"main.ok": True}), plc) == ()
    wrong = OperatorSettings(
        follow={"main.ok": FollowSettings(of="main.no")},
        steps=(StepSettings(values={"main.start": "x"}),),
    )
    with pytest.raises(ConfigurationError) as raised:
        EXTENSION.check(wrong, plc)
    assert len(raised.value.findings) == 2
