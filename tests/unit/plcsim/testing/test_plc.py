"""The controller under test: time, tags, restart, stop, faults, invariants."""

import pytest

from plcsim.core.errors import TagError
from plcsim.core.system import State
from plcsim.testing import ControllerFault, ExpectationFailed, PlantError, PlcTestError
from plcsim.testing.plc import Plc

MS = 1_000_000


def test_run_moves_the_time_and_only_that(cell_plc):
    assert (cell_plc.time_ns, cell_plc["Cell.count"]) == (0, 0)
    cell_plc.run("250ms")
    assert (cell_plc.time_ns, cell_plc["Cell.count"]) == (250 * MS, 25)


def test_cycles_counts_cycles_of_the_class_under_test(new_plc):
    plc = new_plc(10, 50, task_class=2)
    plc.cycles(3)
    assert plc["Cell2.count"] == 3
    assert plc["Cell.count"] == 13


@pytest.mark.parametrize("count", [0, -1])
def test_cycles_needs_a_number_above_0(cell_plc, count):
    with pytest.raises(PlcTestError, match="not a number above 0"):
        cell_plc.cycles(count)


def test_written_tags_are_seen_in_the_next_cycle(cell_plc):
    cell_plc["cell.START"] = True
    assert cell_plc["Cell.motor"] == {"on": False, "speed": 0.0}
    cell_plc.cycles()
    assert cell_plc["Cell.motor"] == {"on": True, "speed": 0.5}


@pytest.mark.parametrize(
    ("path", "value", "text"),
    [
        ("Cell.coutn", 1, "did you mean Cell.count"),
        ("Zell.count", 1, "no program 'Zell'"),
        ("Cell.start", 3, "3 is not a BOOL"),
        ("Cell.count", "x", "'x' is not a DINT"),
        ("Cell.initial", 70_000, "70000 is outside 0..65535 of UINT"),
        ("Cell.light", "BLUE", "BLUE is not a value of Light"),
        ("Cell.history[4]", 1, "index 4 is outside 1..3"),
    ],
)
def test_bad_writes_say_what_is_wrong(cell_plc, path, value, text):
    with pytest.raises(TagError, match=text.replace("[", r"\[")):
        cell_plc[path] = value


def test_restart_gives_initial_values_and_time_0(cell_plc):
    cell_plc["Cell.initial"] = 1
    cell_plc.run("100ms")
    cell_plc.restart()
    assert (cell_plc["Cell.count"], cell_plc["Cell.initial"]) == (0, 7)
    assert (cell_plc.time_ns, cell_plc.cycle_count) == (0, 0)
    cell_plc.cycles(2)
    assert cell_plc["Cell.count"] == cell_plc.cycle_count == 2


def test_stop_runs_the_exits_and_nothing_runs_any_more(cell_plc):
    cell_plc.stop()
    assert cell_plc["Cell.exits"] == 1
    with pytest.raises(PlcTestError, match="stopped"):
        cell_plc.run("10ms")


def test_close_runs_the_exits_once(new_plc):
    plc = new_plc(10)
    plc.close()
    plc.close()
    assert plc["Cell.exits"] == 1


def test_a_program_that_raises_is_a_fault_with_its_place_and_cycles(cell_plc):
    cell_plc["Cell.crash_at"] = 3
    with pytest.raises(ControllerFault, match=r"SERVICE.*division by zero \(.*cell.py:") as caught:
        cell_plc.run("1s")
    assert "Cell.count" in caught.value.__notes__[0]
    with pytest.raises(ControllerFault):
        cell_plc.run("1s")


def test_a_restart_leads_out_of_service(cell_plc):
    cell_plc["Cell.crash_at"] = 1
    with pytest.raises(ControllerFault):
        cell_plc.run("1s")
    cell_plc.restart()
    cell_plc.run("1s")
    assert cell_plc.controller.state is State.RUN


def test_a_program_that_is_interrupted_from_the_keyboard_ends_the_test(new_plc):
    plc = new_plc(10)
    task = plc.controller.tasks[0]

    def interrupted():
        raise KeyboardInterrupt

    task.cyclic = interrupted
    with pytest.raises(KeyboardInterrupt):
        plc.run("10ms")


def test_a_number_without_a_unit_is_no_duration(cell_plc):
    with pytest.raises(PlcTestError, match=r'run: 3 has no unit; .*, such as "3ms"'):
        cell_plc.run(3)
    assert cell_plc.time_ns == 0


def test_always_fails_at_the_first_cycle_that_breaks_it(cell_plc):
    cell_plc.always(lambda: cell_plc["Cell.count"] < 5)
    with pytest.raises(ExpectationFailed, match=r'"Cell.count"] < 5 .* after cycle 5 at 45 ms'):
        cell_plc.run("1s")
    assert cell_plc["Cell.count"] == 5


def test_a_condition_that_raises_ends_the_run_with_its_own_error(cell_plc):
    cell_plc.always(lambda: 1 / (cell_plc["Cell.count"] - 2))
    with pytest.raises(ZeroDivisionError):
        cell_plc.run("1s")


def test_planned_acts_happen_before_the_cycle_they_are_planned_for(cell_plc):
    seen = []
    cell_plc.at("30ms", lambda: seen.append(("at", cell_plc["Cell.count"])))
    cell_plc.at_cycle(2, lambda: seen.append(("at_cycle", cell_plc["Cell.count"])))
    cell_plc.run("100ms")
    assert seen == [("at_cycle", 1), ("at", 3)]


def test_an_act_that_raises_is_named_with_its_cycle_and_place(cell_plc):
    cell_plc.at_cycle(2, lambda: {}["missing"])
    with pytest.raises(PlantError, match=r"in cycle 2 at 15 ms: KeyError.*test_plc.py:\d+"):
        cell_plc.run("1s")


def test_planned_cost_makes_a_violation_with_the_program_as_its_cause(cell_plc):
    cell_plc.cost("Cell", "25ms", cycle=4)
    with pytest.raises(ControllerFault, match="cycle 4, cause program: program Cell used 25 ms"):
        cell_plc.run("1s")


def test_cost_of_an_unknown_program(cell_plc):
    with pytest.raises(PlcTestError, match="no program 'X'; there are Cell"):
        cell_plc.cost("X", "1ms")


def test_unknown_task_class(new_plc):
    with pytest.raises(PlcTestError, match="no task class 3; there are 1"):
        new_plc(10, task_class=3)


def test_two_runs_give_the_same_trace(new_plc):
    def trace():
        plc = new_plc(10, 30, seed=3)
        plc.faults.noise("Cell.level", 2.0)
        plc.stimulate([("40ms", {"Cell.start": True})])
        recorded = plc.record("Cell", "Cell2")
        plc.run("500ms")
        return recorded.to_csv()

    assert trace() == trace()


def test_10_s_at_1_ms_are_10_000_cycles(new_plc):
    plc = new_plc(1)
    plc.run("10s")
    assert plc["Cell.count"] == 10_000


def test_what_is_planned_before_the_boot_counts_from_the_start(cell_plc):
    plc = Plc(cell_plc.application)
    plc.stimulate([("30ms", {"Cell.start": True})])
    assert plc.time_ns == 0
    plc.boot()
    plc.run("30ms")
    assert not plc["Cell.start"]
    plc.run("10ms")
    assert plc["Cell.start"]


def test_used_chance_tells_whether_the_seed_mattered(cell_plc):
    cell_plc.run("100ms")
    assert not cell_plc.used_chance
    cell_plc.faults.noise("Cell.level", 1)
    cell_plc.run("100ms")
    assert cell_plc.used_chance


def test_on_the_host_network_there_is_no_virtual_one(cell_plc):
    plc = Plc(cell_plc.application, host_network=True)
    with pytest.raises(PlcTestError, match="host's network"):
        plc.connect(1234)


def test_completion_offers_all_tags(cell_plc):
    assert "Cell.motor.speed" in cell_plc._ipython_key_completions_()
