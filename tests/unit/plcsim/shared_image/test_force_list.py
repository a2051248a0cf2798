"""The list of forced tags between two processes."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.forces import Force
from plcsim.core.tag import Tag
from plcsim.shared_image import ImageError, layout
from plcsim.shared_image.force_list import (
    ForcedTag,
    encode_forces,
    read_forces,
    write_forces,
)
from st_types import UINT


def ends() -> tuple[memoryview, memoryview]:
    cells = memoryview(bytearray(layout.HEADER_SIZE)).cast("Q")
    return cells, memoryview(bytearray(layout.FORCES_SIZE))


def test_before_anything_is_forced_the_list_is_empty() -> None:
    assert read_forces(*ends()) == []


@given(st.lists(st.tuples(st.text(max_size=20), st.integers(0, 2**32 - 1), st.binary(max_size=9))))
def test_a_list_is_read_as_it_was_written(rows: list[tuple[str, int, bytes]]) -> None:
    cells, region = ends()
    for count in (len(rows), len(rows) // 2):
        forces = [Force(Tag(path, UINT, at), data, "me") for path, at, data in rows[:count]]
        write_forces(cells, region, encode_forces(forces))
        assert read_forces(cells, region) == [
            ForcedTag(path, at, data, "me") for path, at, data in rows[:count]
        ]


def test_a_list_that_was_not_finished_is_not_taken() -> None:
    cells, region = ends()
    cells[layout.FORCE_CELLS.begin] = 1
    with pytest.raises(ImageError, match="not complete"):
        read_forces(cells, region)
