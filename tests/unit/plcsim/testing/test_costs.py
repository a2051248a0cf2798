"""Measured and planned costs."""

import gc

from plcsim.testing.costs import garbage_held, overhead_ns


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
