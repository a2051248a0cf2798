from st_types.syntax.declarations import parse_text
from st_types.types.elementary import INT
from st_types.writers.layout_table import layout_rows

from ..checked import checked


def rows(text: str, name: str) -> list[tuple[int, int, str, str]]:
    found = checked([parse_text(text)], strict=True).find_type(name)
    assert found is not None
    return [(row.offset, row.size, row.path, str(row.data_type)) for row in layout_rows(found)]


def test_members_of_members() -> None:
    text = (
        "TYPE A : STRUCT x : BYTE; p : Alias; n : ARRAY[2..3, 1..2] OF P; END_STRUCT; "
        "P : STRUCT a : INT; b : BOOL; END_STRUCT; Alias : P; END_TYPE"
    )
    assert rows(text, "A") == [
        (0, 1, "x", "BYTE"),
        (2, 4, "p", "Alias"),
        (2, 2, "p.a", "INT"),
        (4, 1, "p.b", "BOOL"),
        (6, 16, "n", "ARRAY[2..3, 1..2] OF P"),
        (6, 2, "n[2,1].a", "INT"),
        (8, 1, "n[2,1].b", "BOOL"),
    ]


def test_a_data_block_is_shown_in_the_order_of_its_offsets() -> None:
    text = "FUNCTION_BLOCK F VAR_INPUT e : BOOL; n : INT; END_VAR END_FUNCTION_BLOCK"
    assert [row[2] for row in rows(text, "F")] == ["n", "e"]


def test_a_type_without_members_has_no_rows() -> None:
    assert list(layout_rows(INT)) == []
