import pytest

from plcsim.cli.exact_costs import Cost, Range, changes, costs_of, differences

A = [(1, 10, "a;"), (2, 20, "b;"), (3, 30, "c;"), (5, 50, "e;")]


def changed(**costs):
    return [(line, costs.get(text[0], cost), text) for line, cost, text in A]


@pytest.mark.parametrize(
    ("after", "expected"),
    [
        (A, []),
        (changed(b=25), [(2, 2, 5)]),
        (changed(b=25, c=20), [(2, 3, -5)]),
        (changed(a=11, c=31), [(1, 1, 1), (3, 3, 1)]),
        ([(line + 7, cost, text) for line, cost, text in A], []),
        ([*A[:2], (3, 7, "new;"), (4, 8, "newer;"), (5, 30, "c;"), (7, 50, "e;")], [(3, 4, 15)]),
        ([A[0], *A[2:]], [(3, 3, -20)]),
        (A[:3], [(5, 5, -50)]),
        ([*A[:3], (5, 70, "other;")], [(5, 5, 20)]),
        ([], [(1, 1, -110)]),
    ],
)
def test_lines_are_compared_by_their_text(after, expected):
    assert changes(A, after) == expected


def test_lines_that_are_all_new():
    assert changes([], A) == [(1, 5, 110)]


def cost(cycles, total, **lines):
    return Cost(
        cycles,
        total,
        total // cycles,
        {"Main.st": [(n, c, t) for n, (t, c) in enumerate(lines.items(), 1)]},
    )


def test_only_what_both_runs_have_and_what_changed_is_told():
    before = {
        ("t", "p"): cost(10, 100, a=60, b=40),
        ("t", "q"): cost(10, 100),
        ("t", "gone"): cost(1, 1),
    }
    after = {
        ("t", "p"): cost(10, 130, a=60, b=70),
        ("t", "q"): cost(10, 100),
        ("t", "new"): cost(1, 1),
    }
    (found,) = differences(before, after, smallest=0.1)
    assert (found.test, found.program, found.worse) == ("t", "p", True)
    assert found.ranges == [Range("Main.st", 2, 2, 30)]


MEANS = [
    (110, 10, False),
    (111, 10, True),
    (200, 20, False),
    (210, 20, False),
    (230, 20, True),
    (90, 10, False),
]


@pytest.mark.parametrize(("total", "cycles", "worse"), MEANS)
def test_an_alarm_is_for_the_mean_of_a_cycle(total, cycles, worse):
    (found,) = differences({("t", "p"): cost(10, 100)}, {("t", "p"): cost(cycles, total)}, 0.1)
    assert found.worse == worse


def test_the_largest_changes_come_first_and_not_all():
    before = cost(1, 100, a=1, b=1, c=1, d=1, e=1, f=1, g=1, h=1)
    after = cost(1, 200, a=3, b=1, c=9, d=1, e=4, f=1, g=5, h=1)
    (found,) = differences({("t", "p"): before}, {("t", "p"): after}, 0.1)
    assert [one.change for one in found.ranges] == [8, 4, 3]


def test_a_range_in_words():
    assert str(Range("Main.st", 48, 60, 1)) == "Main.st line 48 to 60"
    assert str(Range("Main.st", 48, 48, 1)) == "Main.st line 48"


def test_costs_of_a_report():
    counted = {"total": 50, "maximum": 11}
    program = {"name": "p", "cycles": 5, "instructions": counted, "lines": {"P": [[2, 9, "b;"]]}}
    other = {"name": "q", "cycles": 5, "instructions": None}
    test = {
        "group": "t",
        "outcome": "passed",
        "programs": [program, other],
        "lines": {"M": [[1, 50, "a;"]]},
    }
    again = {**test, "programs": [program | {"cycles": 6}]}
    skipped = {**test, "group": "s", "outcome": "skipped"}
    without = {"group": "w", "outcome": "passed", "programs": [{"name": "p", "cycles": 5}]}
    found = costs_of([test, again, skipped, without])
    lines = {"M": [(1, 50, "a;")], "P": [(2, 9, "b;")]}
    assert found == {("t", "p"): Cost(5, 50, 11, lines)}


def test_without_lines_of_both_runs_nobody_says_where():
    before, after = {("t", "p"): Cost(1, 5, 5, {})}, {("t", "p"): cost(1, 9, a=9)}
    for one, other in (before, after), (after, before):
        (found,) = differences(one, other, 0.1)
        assert found.ranges == []
