"""The flight recorder: the last cycles of each class, for any tag, in bounded memory."""

import pytest

from plcsim.testing.history import SHOWN, History


def test_any_tag_can_be_shown_afterwards(cell_plc):
    cell_plc.run("50ms")
    text = cell_plc.history.explain(
        [cell_plc.tags.find("Cell.light"), *cell_plc.tags.leaves("Cell.motor")]
    )
    assert text.splitlines()[2].split() == [
        "cycle",
        "time",
        "Cell.light",
        "Cell.motor.on",
        "Cell.motor.speed",
    ]
    assert text.splitlines()[6].split() == ["4", "35", "ms", "GREEN", "FALSE", "0"]


def test_a_tag_that_is_named_twice_is_shown_once(cell_plc):
    cell_plc.cycles(3)
    tag = cell_plc.tags.find("Cell.count")
    again = cell_plc.tags.find("cell.COUNT")
    assert cell_plc.history.explain([tag, again]).splitlines()[2].split() == [
        "cycle",
        "time",
        "Cell.count",
    ]


def test_no_more_cycles_than_the_table_holds(cell_plc):
    cell_plc.run("1s")
    lines = cell_plc.history.explain([cell_plc.tags.find("Cell.count")]).splitlines()
    assert lines[0] == f"the last {SHOWN} cycles"
    assert [line.split()[0] for line in lines[3:23]] == [str(n) for n in range(81, 101)]


def test_without_cycles_or_tags_there_is_nothing_to_show(cell_plc):
    tag = cell_plc.tags.find("Cell.count")
    assert cell_plc.history.explain([tag]) == ""
    cell_plc.cycles()
    assert cell_plc.history.explain([]) == ""
    assert cell_plc.history.explain([tag]).startswith("the only cycle\n")


@pytest.mark.parametrize(("images", "kept"), [(1, SHOWN), (SHOWN + 3, SHOWN + 3), (9_999, 1_000)])
def test_the_ring_is_bounded_by_bytes_but_keeps_what_is_shown(cell_plc, monkeypatch, images, kept):
    size = cell_plc.controller.memory.used
    monkeypatch.setattr("plcsim.testing.history.MOST_BYTES", images * size)
    history = History(cell_plc.controller)
    for _ in range(1_010):
        history.add(cell_plc.controller.classes[0])
    assert [len(ring) for ring in history._rings.values()] == [kept]


def test_a_restart_begins_anew(cell_plc):
    cell_plc.cycles(5)
    cell_plc.restart()
    cell_plc.cycles(2)
    trace = cell_plc.history.trace([cell_plc.tags.find("Cell.count")])
    assert trace.values("Cell.count") == [1, 2]


@pytest.mark.parametrize(("tag", "classes"), [("Cell.count", {1}), ("Cell2.count", {2})])
def test_a_tag_is_shown_at_the_cycles_of_its_own_class(new_plc, tag, classes):
    plc = new_plc(10, 30)
    plc.run("100ms")
    assert {row.task_class for row in plc.history.trace([plc.tags.find(tag)]).rows} == classes
