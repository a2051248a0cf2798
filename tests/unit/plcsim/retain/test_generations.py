"""Two files, one of which is whole whenever the writer dies."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.tag import Tag
from plcsim.retain.errors import RetainError
from plcsim.retain.generations import NAMES, Generations, decode, describe, encode
from st_types import ARRAY, BOOL, INT, LREAL, STRING, Struct, var
from st_types.types.views import type_of


class Part(Struct):
    weight = var(LREAL)
    good = var(BOOL)


VARIABLES = (
    Tag("gCount", INT, 0x120000),
    Tag("m.parts", ARRAY(type_of(Part), (1, 2)), 0x120010),
    Tag("m.name", STRING(5), 0x120050),
)
SIZE = sum(tag.data_type.size for tag in VARIABLES)
FILE = encode(7, describe(VARIABLES), bytes(range(SIZE)))


def test_a_file_gives_back_what_it_was_given():
    found = decode(FILE)
    assert (found.number, found.data) == (7, bytes(range(SIZE)))
    assert [(v.path, str(v.data_type)) for v in found.variables] == [
        (v.path, str(v.data_type)) for v in VARIABLES
    ]
    assert [v.address for v in found.variables] == [0, 2, 2 + VARIABLES[1].data_type.size]


@given(st.integers(0, len(FILE) - 1))
def test_no_truncated_file_is_taken(length):
    with pytest.raises(ValueError, match=r"truncated|plcsim|checksum"):
        decode(FILE[:length])


@given(st.integers(0, len(FILE) - 1), st.integers(1, 255))
def test_no_changed_file_is_taken(at, change):
    wrong = bytearray(FILE)
    wrong[at] ^= change
    with pytest.raises(ValueError, match=r"truncated|plcsim|checksum"):
        decode(bytes(wrong))


@pytest.mark.parametrize(
    ("described", "data", "text"),
    [
        (b'[["x","NONSENSE"]]', b"", "types cannot be read"),
        (b'[["x","INT"]]', b"123", "do not fit"),
        (b'[["x",{"odd":1}]]', b"", "types cannot be read"),
        (b'["x"]', b"", "types cannot be read"),
        (b"{", b"", "Expecting"),
    ],
)
def test_what_somebody_else_has_written_is_refused(described, data, text):
    with pytest.raises(ValueError, match=text):
        decode(encode(1, described, data))


def test_generations_are_written_in_turn(tmp_path):
    generations = Generations(tmp_path)
    assert generations.latest() == (None, [])
    described = describe(VARIABLES)
    for number in range(1, 4):
        generations.write(described, bytes([number]) * SIZE)
    numbers = [decode((tmp_path / name).read_bytes()).number for name in NAMES]
    assert numbers == [3, 2]
    again = Generations(tmp_path)
    latest, wrong = again.latest()
    assert (latest.number, latest.data, wrong) == (3, b"\3" * SIZE, [])
    again.write(described, bytes(SIZE))
    assert [decode((tmp_path / name).read_bytes()).number for name in NAMES] == [3, 4]


def test_where_the_newer_is_torn_the_older_is_taken_and_kept(tmp_path):
    generations = Generations(tmp_path)
    described = describe(VARIABLES)
    generations.write(described, bytes(SIZE))
    generations.write(described, b"\1" * SIZE)
    newer = tmp_path / NAMES[1]
    newer.write_bytes(newer.read_bytes()[:-40])
    again = Generations(tmp_path)
    latest, wrong = again.latest()
    assert (latest.number, wrong) == (1, [f"{newer}: it is truncated"])
    again.write(described, b"\2" * SIZE)
    assert decode((tmp_path / NAMES[0]).read_bytes()).number == 1
    assert Generations(tmp_path).latest()[0].data == b"\2" * SIZE


def test_only_one_may_write(tmp_path):
    with (
        Generations(tmp_path).locked(),
        pytest.raises(RetainError, match="another run keeps its variables here"),
        Generations(tmp_path).locked(),
    ):
        pass
    with Generations(tmp_path).locked():
        pass


def test_a_folder_that_cannot_be_used_is_told(tmp_path):
    file = tmp_path / "file"
    file.touch()
    with (
        pytest.raises(RetainError, match="file/retain: cannot be written"),
        Generations(file / "retain").locked(),
    ):
        pass
    (tmp_path / NAMES[0]).mkdir()
    with pytest.raises(RetainError, match="cannot be read"):
        Generations(tmp_path).latest()
    with pytest.raises(RetainError, match="cannot be written"):
        Generations(tmp_path).write(b"[]", b"")


def test_cleared_is_as_never_written(tmp_path):
    generations = Generations(tmp_path)
    generations.write(describe(VARIABLES), bytes(SIZE))
    generations.clear()
    assert Generations(tmp_path).latest() == (None, [])
