"""Text diagrams."""

from plcsim.core.tag import Tag
from plcsim.testing.diagram import draw, foot_of, shorten, step_for, table
from st_types import BOOL, DINT, REAL, STRING

lamp, level, name = Tag("p.lamp", BOOL, 0), Tag("p.level", REAL, 0), Tag("p.name", STRING(9), 0)


def test_levels_values_and_curves():
    text = draw(
        [
            (lamp, [False, False, True, False]),
            (Tag("p.n", DINT, 0), [7, 7, 7, 8]),
            (level, [0.5, 10.25, 20.0, 70.5]),
            (name, ["open", "open", "open", "a long name\n"]),
        ],
        2,
        foot_of([9, 10, 11, 12], 2),
    )
    assert text.splitlines() == [
        "p.lamp   ▁▁▁▁▇▇▁▁",
        "p.n      │7    │8",
        "p.level  ▁▁▂▂▃▃██  0.5 to 70.5",
        "p.name   │open │a long name·",
        "cycle      |10",
    ]


def test_what_does_not_fit_is_shortened():
    assert shorten("abcdef", 4) == "abc…"
    assert draw([(name, ["abcdef", "x"])], 4, "") == "p.name  │ab…│x"


def test_a_constant_number_is_a_value_not_a_curve():
    assert draw([(level, [1.5, 1.5])], 1, "") == "p.level  │1.5"


def test_the_diagram_keeps_its_width():
    assert step_for([lamp], 20) == 4
    assert step_for([Tag("x" * 60, BOOL, 0)], 20) == 1


def test_numbers_under_the_lanes_never_overlap():
    assert foot_of(list(range(95, 111)), 1) == "|95  |100 |105 |110 "


def test_columns_are_right_aligned_under_their_heads():
    assert table([["1", "TRUE"], ["10", "FALSE"]], ["cycle", "p.lamp"]).splitlines() == [
        "cycle  p.lamp",
        "    1    TRUE",
        "   10   FALSE",
    ]
