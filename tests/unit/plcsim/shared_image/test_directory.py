from enum import IntEnum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.errors import TagError
from plcsim.core.tag import Tag
from plcsim.library.standard import TON
from plcsim.shared_image.directory import (
    Directory,
    describe_type,
    directory_from,
    hash_of,
    type_from,
)
from plcsim.shared_image.errors import ImageError
from st_types import ARRAY, BOOL, ENUM, INT, LREAL, STRING, WSTRING, DataType, Struct, var
from st_types.types.derived import (
    AliasType,
    ArrayType,
    Member,
    ReferenceType,
    StructType,
    SubrangeType,
    UnionType,
)
from st_types.types.elementary import ELEMENTARY
from st_types.types.views import type_of


class Colour(IntEnum):
    RED = 3
    GREEN = 5


class Inner(Struct):
    on = var(BOOL)
    value = var(LREAL)


class Everything(Struct):
    flag = var(BOOL)
    grid = var(ARRAY(Inner, (1, 2), (0, 1)))
    name = var(STRING(5))
    wide = var(WSTRING(3))
    colour = var(ENUM(Colour))
    timer = var(TON)


leaves = st.sampled_from(sorted(ELEMENTARY)).map(lambda name: ELEMENTARY[name]) | st.integers(
    1, 80
).map(STRING)
types = st.recursive(
    leaves,
    lambda inner: (
        st.lists(inner, min_size=1, max_size=4).map(
            lambda kinds: StructType("S", [Member(f"m{i}", kind) for i, kind in enumerate(kinds)])
        )
        | st.tuples(inner, st.integers(-3, 3), st.integers(0, 4)).map(
            lambda t: ArrayType(t[0], [(t[1], t[1] + t[2])])
        )
    ),
    max_leaves=8,
)


@given(types)
def test_a_described_type_is_laid_out_the_same(data_type: DataType[object]) -> None:
    text = describe_type(data_type)
    again = type_from(text)
    assert (again.size, again.alignment) == (data_type.size, data_type.alignment)
    assert describe_type(again) == text


def directory() -> Directory:
    kind = type_of(Everything)
    return Directory("p", 5, [Tag("prog", kind, 4096)], [(4096, kind.size)], {"modbus": [1]}, [64])


def test_a_directory_survives_its_bytes() -> None:
    before = directory()
    after = directory_from(before.to_bytes())
    for path in ("prog.flag", "PROG.grid[2,1].value", "prog.name", "prog.colour", "prog.timer.ET"):
        one, two = before.find(path), after.find(path)
        assert (one.address, one.data_type.size) == (two.address, two.data_type.size)
    assert after.services == {"modbus": [1]}
    assert after.streams == [64]
    assert after.to_bytes() == before.to_bytes()


def test_special_types_are_described() -> None:
    low = SubrangeType("Low", INT, 0, 9)
    assert describe_type(low) == {"subrange": "Low", "of": "INT", "bounds": [0, 9]}
    assert str(type_from(describe_type(low))) == "Low"
    union = UnionType("U", [Member("a", INT), Member("b", ELEMENTARY["LINT"])])
    assert type_from(describe_type(union)).offsets == (0, 0)
    assert describe_type(ReferenceType(INT)) == "UDINT"
    assert describe_type(AliasType("Speed", INT)) == "INT"


def test_what_describes_no_type_is_an_image_error() -> None:
    with pytest.raises(ImageError, match="does not describe"):
        type_from({"unknown": 1})


@pytest.mark.parametrize("path", ["other.flag", "prog.nothing", "prog.grid[9,9].on"])
def test_an_unknown_tag_is_named(path: str) -> None:
    with pytest.raises(TagError, match=path.split(".", maxsplit=1)[0]):
        directory().find(path)


def test_names_near_an_unknown_tag_are_offered_as_the_scan_process_offers_them() -> None:
    with pytest.raises(TagError, match=r"has no member flg; did you mean prog\.flag"):
        directory().find("prog.flg")


def test_an_offset_of_a_variable_in_the_snapshot() -> None:
    two = Directory("p", 5, [], [(8192, 16), (4096, 8)])
    assert two.offset_of(4100, 4) == 20
    assert two.offset_of(8192, 16) == 0
    with pytest.raises(ImageError, match="16#00001008"):
        two.offset_of(4104, 1)
    with pytest.raises(ImageError):
        two.offset_of(4100, 8)


def test_the_hash_changes_with_the_layout() -> None:
    other = Directory("p", 6, [], [])
    assert hash_of(directory().to_bytes()) != hash_of(other.to_bytes())
    assert hash_of(b"") == int.from_bytes(bytes.fromhex("e3b0c44298fc1c14"), "little")
