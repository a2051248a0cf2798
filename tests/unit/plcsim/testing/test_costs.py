"""Measured and planned costs."""

import gc

import pytest

from plcsim.testing import PlcTestError
from plcsim.testing.costs import Costs, garbage_held, overhead_ns
from plcsim.testing.errors import ExpectationFailed


def test_each_cycle_is_measured(cell_plc):
    cell_plc.cycles(50)
    costs = cell_plc.costs.measured_ns["Cell"]
    assert len(costs) == 50
    assert all(cost > 0 for cost in costs)
    assert cell_plc.costs.total_ns == sum(costs)


def test_measuring_does_not_reach_the_virtual_clock(cell_plc):
    cell_plc.cycles(50)
    assert cell_plc.controller.classes[0].response.maximum_ns == 0


def test_planned_costs_are_spent_in_their_cycle_only(cell_plc):
    cell_plc.cost("cell", "3ms", cycle=2)
    cell_plc.cycles(4)
    assert cell_plc.controller.classes[0].execution.maximum_ns == 3_000_000
    assert cell_plc.controller.classes[0].execution.total_ns == 3_000_000


def test_a_standing_cost_is_spent_in_each_cycle(cell_plc):
    cell_plc.cost("Cell", "1ms")
    cell_plc.cycles(4)
    assert cell_plc.controller.classes[0].execution.total_ns == 4_000_000


def test_cycles_are_counted_anew_after_a_restart(cell_plc):
    cell_plc.cycles(2)
    cell_plc.restart()
    cell_plc.cost("Cell", "3ms", cycle=2)
    cell_plc.cycles(2)
    assert cell_plc.controller.classes[0].execution.maximum_ns == 3_000_000


def test_overhead_is_small_and_not_negative():
    assert 0 <= overhead_ns() < 1_000_000


def test_garbage_is_held_inside_and_as_before_outside():
    before = gc.isenabled()
    with garbage_held():
        assert not gc.isenabled()
    assert gc.isenabled() == before


def test_instructions_of_each_cycle_are_those_counted_while_it_ran(cell_plc):
    """A compiled program, as far as costs are concerned: one that counts."""
    counted = [1000]
    (task,) = cell_plc.controller.tasks
    cyclic, task.instructions = task.cyclic, lambda: counted[0]

    def compiled():
        counted[0] += 10 * len(counted)
        counted.append(0)
        cyclic()

    task.cyclic = compiled
    cell_plc.costs = Costs(cell_plc.controller)
    counted[0] += 5  # INIT, or another program
    cell_plc.cycles(3)
    assert cell_plc.costs.instructions == {"Cell": [10, 20, 30]}
    cell_plc.assert_cost("cell", worst=30, p50=20)
    with pytest.raises(ExpectationFailed, match="worst of 3 cycles is 30 instructions"):
        cell_plc.assert_cost("cell", worst=29)


def test_programs_in_python_have_no_instructions(cell_plc):
    cell_plc.cycles(2)
    assert cell_plc.costs.instructions == {}
    with pytest.raises(PlcTestError, match="assert_cost: no instructions are counted of cell"):
        cell_plc.assert_cost("cell", worst=5)
