import pytest

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.places import NEAR, THIS, ScalarPlace, indexed, key_of

from .build import PROGRAM, address, load, number, op, place

OTHER = ir.Segment("other")


def key(offset, width="w32", root=1, base=5):
    return ScalarPlace(root, base, offset, width)


@pytest.mark.parametrize(
    ("one", "other", "meets"),
    [
        (key(0), key(4), False),
        (key(0), key(3, "u8"), True),
        (key(4), key(3, "u8"), False),
        (key(0, "w64"), key(4), True),
        (key(0, base=5), key(0, base=6), False),
        (key(0, base=5, root=0), key(0, base=6, root=0), False),
        (key(0, base=THIS, root=3), key(0, base=5, root=0), True),
        (key(0, base=THIS, root=0), key(90, base=5, root=4), True),
        (key(0, base=THIS, root=3), key(0, base=5, root=4), False),
    ],
)
def test_scalars_meet_where_bytes_are_common(one, other, meets):
    assert one.meets(other) == other.meets(one) == meets


@pytest.mark.parametrize(
    ("root", "changed", "this", "is_in"),
    [
        (1, {1}, False, True),
        (1, {0, 2}, False, False),
        (0, {2}, False, False),
        (1, {0}, True, True),
        (0, {2}, True, True),
        (1, {2}, True, False),
        (0, set(), True, False),
    ],
)
def test_in_a_block_what_an_address_reaches_may_be_its_data(root, changed, this, is_in):
    assert key(0, root=root).is_in(changed, this=this) == is_in


def test_only_fixed_places_have_keys():
    assert key_of(place(8, 3), "u8", this=False) == ScalarPlace(3, id(PROGRAM), 8, "u8")
    member = ir.Place(ir.Local("i32", 0), 4, 2)
    assert key_of(member, "w32", this=True) == ScalarPlace(2, THIS, 4, "w32")
    assert key_of(member, "w32", this=False) is None
    assert key_of(ir.Place(ir.Local("i32", 1), 4, 2), "w32", this=True) is None
    assert key_of(ir.Place(load(0), 4, 2), "w32", this=True) is None


def element(index, offset=0):
    return ir.Place(op("add", address(100, 7), index), offset, 7)


SMALL = load(0, "u8")


def test_constants_of_an_index_go_into_the_offset():
    found = indexed(element(op("mul", op("sub", SMALL, 1), 12), 8))
    assert found == (PROGRAM, 100 - 12 + 8, [(SMALL, 12)])


def test_a_shift_is_a_factor():
    found = indexed(element(op("shl", SMALL, 3)))
    assert found == (PROGRAM, 100, [(SMALL, 8)])


def test_two_dimensions_are_two_terms():
    other = ir.Checked(load(4), 10)
    inner = op("add", address(100, 7), op("mul", SMALL, 40))
    place_ = ir.Place(op("add", inner, op("mul", op("sub", other, 2), 4)), 0, 7)
    assert indexed(place_) == (PROGRAM, 100 - 8, [(SMALL, 40), (other, 4)])


@pytest.mark.parametrize(
    "place_",
    [
        element(load(0, "s16")),
        element(op("mul", load(0), 4)),
        element(op("mul", SMALL, 0x0100_0000)),
        element(op("mul", SMALL, -4)),
        element(op("sub", SMALL, NEAR + 101)),
        place(0),
        ir.Place(op("mul", SMALL, 4), 0, 7),
        ir.Place(op("add", load(4), SMALL), 0, 7),
        ir.Place(op("add", address(0), address(4)), 0, 7),
    ],
)
def test_sums_that_may_wrap_stay_as_they_are(place_):
    assert indexed(place_) is None


def test_a_constant_index_leaves_no_term_but_itself():
    found = indexed(element(number(24)))
    assert found is not None
    assert (found.segment, found.offset) == (PROGRAM, 100)
    assert [(index.value, factor) for index, factor in found.terms] == [(24, 1)]
