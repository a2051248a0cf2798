from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.tag import Tag
from plcsim.modbus.map import Area, MapRow, TagMapError
from plcsim.modbus.map.automatic import (
    LOCK_FILE,
    all_tags,
    give_addresses,
    locked_rows,
    write_lock,
)
from plcsim.modbus.map.resolve import resolve
from st_types import BOOL, DINT, INT, LREAL, STRING, WSTRING

from ..plants import controller

TYPES = {"BOOL": BOOL, "INT": INT, "DINT": DINT, "LREAL": LREAL, "STRING": STRING(7)}
variables = st.dictionaries(st.sampled_from("abcdefgh"), st.sampled_from(sorted(TYPES)))


def tags(names: dict[str, str]) -> list[Tag]:
    return [Tag(f"p.{name}", TYPES[kind], 4096) for name, kind in names.items()]


@given(st.lists(variables, min_size=1, max_size=6))
def test_an_address_never_moves_and_never_has_two_tags(builds: list[dict[str, str]]) -> None:
    locked: list[MapRow] = []
    ever: dict[tuple[str, str, int], tuple[Area, int]] = {}
    for build in builds:
        rows, locked = give_addresses(tags(build), (), locked)
        assert [row.tag for row in rows] == [f"p.{name}" for name in build]
        for row in rows:
            place = (row.area, row.offset)
            assert ever.setdefault((row.tag, row.type, row.length), place) == place
    resolve_all(locked)


def resolve_all(rows: list[MapRow]) -> None:
    """Raise where two rows overlap."""
    kinds = {"bool": BOOL, "int16": INT, "int32": DINT, "float64": LREAL, "string": STRING(7)}
    by_place = {f"{row.tag}{i}": kinds[row.type] for i, row in enumerate(rows)}
    named = [MapRow(f"{r.tag}{i}", r.area, r.offset, type=r.type) for i, r in enumerate(rows)]
    resolve(named, lambda path: Tag(path, by_place[path], 4096), Path("f"), "ABCD")


def test_every_variable_of_the_programs_is_given_an_address() -> None:
    plc = controller()
    found = list(all_tags(plc.areas))
    for tag in found:
        assert plc.tags.find(tag.path)[1:] == tag[1:]
    paths = [tag.path for tag in found]
    assert "p.axes[2].ready" in paths
    assert "p.words[300]" in paths
    assert not any(path.startswith("p.timer") for path in paths)
    rows, lock = give_addresses(found, (), ())
    assert "p.wide" not in {row.tag for row in rows}
    assert len(resolve(rows, plc.tags.find, Path("f"), "ABCD")) == len(rows) == len(lock)


def test_what_tags_csv_names_gets_no_second_address() -> None:
    row = MapRow("P.A", Area.HOLDING_REGISTERS, 10, type="int32")
    fixed = resolve([row], lambda path: Tag(path, INT, 4096), Path("f"), "ABCD")
    rows, _ = give_addresses(tags({"a": "INT", "b": "INT", "c": "BOOL"}), fixed, ())
    assert [(row.tag, row.area.value, row.offset) for row in rows] == [
        ("p.b", "hr", 12),
        ("p.c", "co", 0),
    ]


def test_a_full_area_is_an_error() -> None:
    locked = [MapRow("p.z", Area.HOLDING_REGISTERS, 65534, type="int16")]
    give_addresses(tags({"a": "INT"}), (), locked)
    with pytest.raises(TagMapError, match=r"p\.b: area hr has no address left"):
        give_addresses(tags({"a": "INT", "b": "INT"}), (), locked)


def test_the_lock_file_keeps_the_rows(tmp_path: Path) -> None:
    assert locked_rows(tmp_path) == []
    names = {"a": "STRING", "b": "BOOL", "c": "LREAL"}
    rows, lock = give_addresses(tags(names), (), locked_rows(tmp_path))
    write_lock(tmp_path, lock)
    assert locked_rows(tmp_path) == lock == rows
    assert give_addresses(tags(names), (), locked_rows(tmp_path))[0] == rows
    assert [file.name for file in tmp_path.iterdir()] == [LOCK_FILE]


def test_a_damaged_lock_file_is_named(tmp_path: Path) -> None:
    (tmp_path / LOCK_FILE).write_bytes(b"\x81")
    with pytest.raises(TagMapError, match=r"tags\.lock: cannot be read"):
        locked_rows(tmp_path)
    (tmp_path / LOCK_FILE).write_text("tag,area,offset\np.a,hr,x\n")
    with pytest.raises(TagMapError, match=r"tags\.lock:2: offset"):
        locked_rows(tmp_path)


def test_a_folder_that_cannot_be_written_is_named(tmp_path: Path) -> None:
    with pytest.raises(TagMapError, match=r"tags\.lock: cannot be written"):
        write_lock(tmp_path / "missing", [])


def test_a_type_no_register_can_hold_is_left_out() -> None:
    assert give_addresses([Tag("p.w", WSTRING(3), 4096)], (), ()) == ([], [])


@pytest.mark.parametrize(
    ("row", "error"),
    [
        ("p.a,hr,1,,", "2: p.a: has no type"),
        ("p.a,hr,1,string,", "2: p.a: has no length"),
        ("<<<<<<< HEAD", "2: area is missing"),
        ("p.a,hr,x,int16,", "2: offset: 'x'"),
    ],
)
def test_a_lock_file_that_somebody_has_edited_is_named_with_its_line(
    tmp_path: Path, row: str, error: str
) -> None:
    (tmp_path / LOCK_FILE).write_text(f"tag,area,offset,type,length\n{row}\n")
    with pytest.raises(TagMapError, match=rf"tags\.lock:{error}"):
        give_addresses([], (), locked_rows(tmp_path))


def test_a_string_gets_no_more_registers_than_a_request_can_write() -> None:
    (row,), _ = give_addresses([Tag("p.text", STRING(300), 4096)], (), ())
    assert row.length == 123
    (point,) = resolve([row], lambda path: Tag(path, STRING(300), 4096), Path("f"), "ABCD")
    assert point.registers == 123
