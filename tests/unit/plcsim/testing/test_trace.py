"""Traces: rows where something changes, CSV that plays back, pictures."""

import xml.etree.ElementTree as ET

import pytest

from plcsim.testing import PlcTestError

MS = 1_000_000


@pytest.fixture
def trace(cell_plc):
    recorded = cell_plc.record("Cell.light", "Cell.motor")
    cell_plc.run("55ms")
    cell_plc["Cell.start"] = True
    cell_plc.run("65ms")
    return recorded


def test_only_changes_are_kept(trace):
    assert trace["Cell.light"] == [(0, 0), (35 * MS, 1), (75 * MS, 2), (115 * MS, 0)]
    assert trace.values("cell.MOTOR.ON") == [False, True]
    assert trace.end_ns == 115 * MS


def test_the_value_at_a_time(trace):
    assert trace.at("74.9ms", "Cell.light") == 1
    assert trace.at("75ms", "Cell.light") == 2


def test_unknown_tags_and_times(cell_plc, trace):
    with pytest.raises(PlcTestError, match=r"no tag 'Cell.count'; it has Cell.light, Cell.motor"):
        trace.values("Cell.count")
    late = cell_plc.record("Cell.count")
    with pytest.raises(PlcTestError, match="not recorded yet at 1ms"):
        late.at("1ms", "Cell.count")


def test_csv_names_tags_and_values(trace):
    lines = trace.to_csv().splitlines()
    assert lines[0] == "time_ns,task_class,cycle,Cell.light,Cell.motor.on,Cell.motor.speed"
    assert lines[1] == "0,0,0,RED,FALSE,0"
    assert lines[2] == "35000000,1,4,GREEN,FALSE,0"


def test_a_recorded_trace_can_be_played_back(trace, new_plc, tmp_path):
    table, _ = trace.save(tmp_path / "new" / "folder", "light")
    plc = new_plc(10)
    plc.controller.tasks[0].cyclic = lambda: None
    plc.stimulate(table)
    again = plc.record("Cell.light", "Cell.motor")
    plc.run("120ms")
    assert again.values("Cell.light") == trace.values("Cell.light")
    assert [t // (10 * MS) for t, _ in again["Cell.light"]] == [0, 3, 7, 11]


def test_the_picture_is_well_formed_and_names_all_tags(trace, tmp_path):
    _, picture = trace.save(tmp_path, "light", "<light> & co")
    texts = [e.text for e in ET.parse(picture).iter() if e.tag.endswith("text")]
    assert {"Cell.light", "Cell.motor.on", "Cell.motor.speed", "<light> & co"} <= set(texts)
    assert {"RED", "GREEN", "YELLOW"} <= set(texts)


def test_as_text_every_lane_has_its_width(trace):
    lines = trace.to_text(80).splitlines()
    assert [line.split()[0] for line in lines] == [
        "Cell.light",
        "Cell.motor.on",
        "Cell.motor.speed",
    ]
    assert len(lines[1]) == 80


def test_a_whole_struct_or_array_is_recorded_by_its_elements(cell_plc):
    trace = cell_plc.record("Cell.history", "Cell.motor")
    assert [tag.path for tag in trace.tags][:3] == [f"Cell.history[{n}]" for n in (1, 2, 3)]


def test_tags_of_two_classes_come_in_the_order_of_time(new_plc):
    plc = new_plc(10, 20)
    plc.cost("Cell2", "12ms", cycle=2)
    trace = plc.record("Cell.count", "Cell2.count")
    plc.run("100ms")
    times = [row.time_ns for row in trace.rows]
    assert times == sorted(times)
