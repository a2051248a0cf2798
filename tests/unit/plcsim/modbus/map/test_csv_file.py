import csv
import io
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.modbus.map import Area, MapRow, TagMapError
from plcsim.modbus.map.csv_file import COLUMNS, read_file, read_rows, write_rows
from plcsim.modbus.map.point import ACCESSES, KINDS, ORDERS

FILE = Path("tags.csv")

reals = st.floats(allow_nan=False, allow_infinity=False)
texts = st.text(st.characters(codec="utf-8", exclude_characters="\r\n\0"), max_size=9).map(
    str.strip
)
rows = st.builds(
    MapRow,
    tag=texts.filter(lambda t: t and not t.startswith("#")),
    area=st.sampled_from(Area),
    offset=st.integers(0, 65535),
    bit=st.none() | st.integers(0, 15),
    type=st.sampled_from(["", *KINDS]),
    length=st.integers(1, 125),
    order=st.sampled_from(["", *ORDERS]),
    access=st.sampled_from(["", *ACCESSES]),
    scale=reals.filter(bool),
    offset_eu=reals,
    unit=texts,
    minimum=st.none() | reals,
    maximum=st.none() | reals,
    alias=st.booleans(),
    partial=st.booleans(),
    group=texts,
    description=texts,
)


@given(st.lists(rows, max_size=8))
def test_rows_survive_being_written(given_rows: list[MapRow]) -> None:
    read = read_rows(write_rows(given_rows), FILE)
    assert [row.line for row in read] == list(range(2, len(read) + 2))
    unnumbered = [MapRow(**{**vars(row), "line": 0}) for row in read]
    assert unnumbered == given_rows


def error_of(text: str) -> str | None:
    try:
        read_rows(text, FILE)
    except TagMapError as err:
        return str(err)
    return None


@given(st.text(max_size=200))
def test_any_text_is_rows_or_an_error_that_names_the_file(text: str) -> None:
    error = error_of(text)
    assert error is None or error.startswith("tags.csv:")


@given(st.lists(st.lists(texts, min_size=1, max_size=4), max_size=5))
def test_any_fields_below_a_header_are_rows_or_an_error_with_the_line(
    lines: list[list[str]],
) -> None:
    out = io.StringIO()
    csv.writer(out).writerows([["tag", "area", "offset", "bit"], *lines])
    error = error_of(out.getvalue())
    assert error is None or error.split(":")[1].isdecimal()


def test_defaults_comments_and_a_byte_order_mark() -> None:
    text = "\ufeff# map\n\ntag,area,offset,scale,max\np.a, HR ,7,0.1,\n,,,,\n"
    assert read_rows(text, FILE) == [MapRow("p.a", Area.HOLDING_REGISTERS, 7, scale=0.1, line=4)]


@pytest.mark.parametrize(
    ("text", "error"),
    [
        ("", "tags.csv: holds no line that names the columns"),
        ("tag,area", "tags.csv:1: column offset is missing"),
        ("tag,area,ofset", r"tags.csv:1: unknown column 'ofset'; did you mean offset\?"),
        ("tag,area,offset,zzzz", "unknown column 'zzzz'; known are tag, area"),
        ("tag,area,offset,tag", "two columns are called tag"),
        ("tag,area,offset\np,hr,1,2", "tags.csv:2: 4 fields for 3 columns"),
        ("tag,area,offset\n,hr,1", "tags.csv:2: tag: a tag is needed"),
        ("tag,area,offset\np,xx,1", "tags.csv:2: area: 'xx' is not co, di, ir or hr"),
        ("tag,area,offset\np,hr,65536", "offset: '65536' is not a number from 0 to 65535"),
        ("tag,area,offset\np,hr,-1", "offset: '-1' is not a number"),
        ("tag,area,offset\np,hr,40001x", "offset: '40001x' is not a number"),
        ("tag,area,offset\np,hr", "tags.csv:2: offset is missing"),
        ("tag,area,offset,bit\np,hr,1,16", "bit: '16' is not a number from 0 to 15"),
        ("tag,area,offset,type\np,hr,1,int8", "type: 'int8' is not one of bool, int16"),
        ("tag,area,offset,order\np,hr,1,ACBD", "order: 'ACBD' is not one of ABCD"),
        ("tag,area,offset,access\np,hr,1,r", "access: 'r' is not one of ro, rw, wo"),
        ("tag,area,offset,scale\np,hr,1,0", "scale: must not be 0"),
        ("tag,area,offset,scale\np,hr,1,x", "scale: 'x' is not a number"),
        ("tag,area,offset,min\np,hr,1,nan", "min: 'nan' is not a finite number"),
        ("tag,area,offset,alias\np,hr,1,2", "alias: '2' is neither 0 nor 1"),
        ("tag,area,offset,length\np,hr,1,126", "length: '126' is not a number from 1 to 125"),
        ('tag,area,offset\n"p,hr,1', "tags.csv:2: "),
    ],
)
def test_what_is_wrong_is_named_with_its_line(text: str, error: str) -> None:
    with pytest.raises(TagMapError, match=error):
        read_rows(text, FILE)


def test_all_columns_are_written() -> None:
    assert write_rows([]).strip().split(",") == list(COLUMNS)


EXCEL = """# Ofen, Linie 3;;;;;
tag;area;offset;scale;max;description
p.a;hr;7;0,1;1,5e3;"Temperatur; in °C, 1,5 genau"
;;;;;
p.b;hr;8;-2,25;;
"""
EXCEL_ROWS = [
    MapRow("p.a", Area.HOLDING_REGISTERS, 7, scale=0.1, maximum=1500.0,
        description="Temperatur; in °C, 1,5 genau", line=3),
    MapRow("p.b", Area.HOLDING_REGISTERS, 8, scale=-2.25, line=5),
]  # fmt: skip


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252"])
@pytest.mark.parametrize("newline", ["\n", "\r\n", "\r"])
def test_what_a_german_spreadsheet_saves_is_read(
    tmp_path: Path, encoding: str, newline: str
) -> None:
    file = tmp_path / "tags.csv"
    file.write_bytes(EXCEL.replace("\n", newline).encode(encoding))
    assert read_file(file) == EXCEL_ROWS


def test_tabs_and_the_mark_of_excel_are_understood() -> None:
    expected = [MapRow("p.a", Area.COILS, 1, line=3)]
    for delimiter in ",;\t":
        text = f"sep={delimiter}\ntag,area,offset\np.a,co,1\n".replace(",", delimiter)
        assert read_rows(text, FILE) == expected


def test_a_comma_in_a_number_is_refused_where_commas_separate() -> None:
    assert "'1,000' is not a number" in str(error_of('tag,area,offset,scale\np,hr,1,"1,000"'))
    assert "'1,5' is not a number" in str(error_of("tag;area;offset\np;hr;1,5"))
