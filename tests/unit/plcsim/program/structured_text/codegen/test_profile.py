import numpy as np

from plcsim.program.structured_text.codegen.profile import Arc, LineCost, Profile

COSTS = [
    LineCost(0, 0, 1, 1, is_entry=True),
    LineCost(0, 0, 3, 5),
    LineCost(1, 0, 3, 2),
    LineCost(1, 0, 4, 0),
    LineCost(2, 1, 3, 10),
]
ARCS = [Arc(1, 0, 3, 4), Arc(2, 1, 3, -1), Arc(0, 0, 3, 6)]


def counts(*values):
    return np.array(values, np.int64)


def test_costs_of_a_line_are_summed_over_its_counters():
    profile = Profile(["A.st", "B.st"], 3, COSTS, ARCS)
    assert profile.cost_of_lines(counts(2, 3, 0)) == {("A.st", 1): 2, ("A.st", 3): 16}
    assert profile.cost_of_lines(counts(0, 0, 1)) == {("B.st", 3): 10}


def test_lines_and_ways_are_told_by_file():
    profile = Profile(["A.st", "B.st"], 3, COSTS, ARCS)
    assert profile.lines(0) == {3, 4}
    assert profile.lines_run(0, counts(1, 0, 0)) == {3}
    assert profile.lines_run(0, counts(0, 1, 0)) == {3, 4}
    assert profile.lines(1) == {3}
    assert profile.ways(0) == {(3, 4), (3, 6)}
    assert profile.ways_gone(0, counts(0, 7, 1)) == {(3, 4)}
    assert profile.ways_gone(1, counts(0, 7, 1)) == {(3, -1)}
