import ctypes

import pytest

from st_types.syntax.declarations import parse_text
from st_types.syntax.printer import print_item
from st_types.types.elementary import ELEMENTARY
from st_types.writers.c_types import C_TO_ST, alias_name, c_type_block

from ..checked import checked

FIXED = {f"{sign}int{bits}_t": bits // 8 for bits in (8, 16, 32, 64) for sign in ("", "u")}


@pytest.mark.parametrize("c_type", FIXED)
def test_integers_of_fixed_size(c_type: str) -> None:
    data_type = ELEMENTARY[C_TO_ST[c_type]]
    assert data_type.size == FIXED[c_type] == ctypes.sizeof(getattr(ctypes, f"c_{c_type[:-2]}"))
    assert (data_type.minimum == 0) == c_type.startswith("u")


def test_the_rows_that_the_figure_has_wrong() -> None:
    assert (C_TO_ST["int64_t"], C_TO_ST["uint64_t"]) == ("LINT", "ULINT")


def test_names_are_those_of_the_figure() -> None:
    assert [alias_name(c) for c in ("int", "unsigned int", "uint64_t", "double")] == [
        *["_int", "unsignedInt", "_uint64_t", "_double"],
    ]


def test_the_block_resolves() -> None:
    table = checked([parse_text(print_item(c_type_block()))], strict=True)
    sizes = {data_type.name: data_type.size for data_type in table.data_types()}
    assert sizes == {alias_name(c): ELEMENTARY[st].size for c, st in C_TO_ST.items()}
