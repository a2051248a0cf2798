import gc
from enum import IntEnum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import (
    ARRAY,
    BOOL,
    DATE_AND_TIME,
    DINT,
    DWORD,
    ENUM,
    INT,
    LINT,
    REAL,
    SINT,
    STRING,
    TIME,
    UDINT,
    UINT,
    ULINT,
    USINT,
    WSTRING,
    Array,
    DataBlock,
    DeclarationError,
    Struct,
    Union,
    ValueRangeError,
    var,
    var_in_out,
    var_input,
    var_output,
)
from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    Member,
    ReferenceType,
    Section,
    StructType,
    SubrangeType,
    UnionType,
)
from st_types.types.values import decode, encode
from st_types.types.views import address_of, assign, context_of, reset, type_of, view_class

from ..random_types import struct_types, structs_with, typed_bytes, typed_values


class Color(IntEnum):
    RED = 1
    GREEN = 5


class Axis(Struct):
    on = var(BOOL)
    speed = var(REAL, 1.5)


class Machine(Struct):
    counter = var(UINT, 3)
    color = var(ENUM(Color))
    name = var(STRING(5), "cell")
    title = var(WSTRING(3), "ab")
    main = var(Axis, {"on": True})
    axes = var(ARRAY(Axis, (1, 2)))
    grid = var(ARRAY(INT, (0, 1), (1, 2)), [1, 2])


class Elementary(Struct):
    sint = var(SINT)
    int_ = var(INT)
    dint = var(DINT)
    lint = var(LINT)
    usint = var(USINT)
    uint = var(UINT)
    udint = var(UDINT)
    ulint = var(ULINT)
    time = var(TIME)
    moment = var(DATE_AND_TIME)
    part = var(SubrangeType("Part", SINT, -5, 5))
    pointer = var(ReferenceType(INT))
    alias = var(AliasType("Speed", INT))


def plain(view):
    """Return the value of a view as `decode` gives it."""
    if isinstance(view, Struct):
        return {m.name: plain(getattr(view, m.name)) for m in type_of(view).members}
    if isinstance(view, Array):
        return [plain(element) for element in view]
    return int(view) if isinstance(view, IntEnum) else view


def test_a_new_view_has_the_initial_values():
    assert plain(Machine()) == {
        "counter": 3,
        "color": 1,
        "name": "cell",
        "title": "ab",
        "main": {"on": True, "speed": 1.5},
        "axes": [{"on": False, "speed": 1.5}] * 2,
        "grid": [1, 2, 0, 0],
    }


def test_members_are_read_and_written_like_attributes():
    machine = Machine()
    machine.counter += 1
    machine.color = Color.GREEN
    machine.name = "x"
    machine.title = "\u20ac"
    machine.main.speed = 2.5
    machine.axes[2].on = True
    machine.grid[1, 2] = -4
    assert plain(machine) == {
        "counter": 4,
        "color": 5,
        "name": "x",
        "title": "\u20ac",
        "main": {"on": True, "speed": 2.5},
        "axes": [{"on": False, "speed": 1.5}, {"on": True, "speed": 1.5}],
        "grid": [1, 2, 0, -4],
    }


def test_values_can_be_given_to_the_constructor():
    machine = Machine(counter=9, main={"speed": 0.5}, grid=[7])
    assert (machine.counter, machine.main.on, machine.main.speed) == (9, False, 0.5)
    assert list(machine.grid) == [7, 0, 0, 0]


@pytest.mark.parametrize(
    ("name", "value", "stored"),
    [
        ("sint", 128, -128),
        ("int_", -32769, 32767),
        ("dint", 2**31, -(2**31)),
        ("lint", 2**63, -(2**63)),
        ("usint", -1, 255),
        ("uint", 65536, 0),
        ("udint", 2**32 + 1, 1),
        ("ulint", -1, 2**64 - 1),
        ("time", 2**31, -(2**31)),
        ("moment", -1, 2**32 - 1),
        ("part", 300, 44),
        ("pointer", -1, 2**32 - 1),
        ("alias", 40000, 40000 - 65536),
    ],
)
def test_integers_wrap_as_on_the_controller(name, value, stored):
    view = Elementary()
    setattr(view, name, value)
    assert getattr(view, name) == stored


def test_strings_are_cut_and_end_at_their_first_nul():
    machine = Machine()
    machine.name = "abcdefgh"
    assert machine.name == "abcde"
    machine.name = b"ab\0cd"
    assert machine.name == "ab"
    machine.title = "abcdef"
    assert machine.title == "abc"
    with pytest.raises(ValueRangeError, match=r"one byte a character \(Latin-1\)"):
        machine.name = "\u20ac"
    with pytest.raises(ValueRangeError, match=r"5 is not a WSTRING\."):
        machine.title = 5


def test_an_assigned_string_leaves_the_bytes_behind_its_terminator():
    class Name(Struct):
        text = var(STRING(3), "abc")

    name = Name()
    name.text = "x"
    assert bytes(name) == b"x\0c\0"


def test_an_unknown_enumeration_value_reads_as_a_number():
    machine = Machine()
    machine.color = 77
    assert machine.color == 77
    assert not isinstance(machine.color, Color)
    with pytest.raises(TypeError):
        machine.color = 2.5


@pytest.mark.parametrize("view", [Machine(), Machine().main, Elementary()])
def test_a_name_that_was_not_declared_is_refused(view):
    with pytest.raises(AttributeError, match="speeed"):
        view.speeed = 1
    with pytest.raises(AttributeError, match="speeed"):
        _ = view.speeed


def test_a_number_takes_no_text_and_no_fraction():
    machine = Machine()
    for value in ("5", 2.5, None):
        with pytest.raises(TypeError):
            machine.counter = value
    assert machine.counter == 3


def test_a_bound_view_writes_through_to_its_buffer():
    buffer = bytearray(100)
    machine = Machine.bind(buffer, 8, 0x1008, "context")
    assert plain(machine)["axes"] == [{"on": False, "speed": 0.0}] * 2
    machine.counter = 0x0102
    machine.axes[1].on = True
    assert buffer[8:10] == b"\2\1"
    again = Machine.bind(buffer, 8, 0x1008)
    assert plain(again) == plain(machine)
    assert (address_of(machine), context_of(machine)) == (0x1008, "context")
    assert context_of(machine.axes[1]) == context_of(machine.main) == "context"


def test_addresses_of_parts_follow_the_view_and_are_0_outside_plc_memory():
    offset = type_of(Machine).find("axes")[1]
    machine = Machine.bind(bytearray(100), 0, 0x2000)
    assert address_of(machine.axes) == 0x2000 + offset
    assert address_of(machine.axes[2]) == 0x2000 + offset + 8
    own = Machine()
    assert [address_of(view) for view in (own, own.main, own.axes, own.axes[1])] == [0] * 4
    assert context_of(own) is None


def test_two_views_of_own_memory_do_not_share_it():
    first, second = Machine(), Machine()
    first.main.speed = 9.0
    assert second.main.speed == 1.5


def test_an_inner_view_keeps_the_memory_alive():
    inner = Machine().axes[2]
    gc.collect()
    assert plain(inner) == {"on": False, "speed": 1.5}


def test_assigning_a_struct_copies_its_bytes():
    machine = Machine()
    axis = Axis(on=True, speed=3.0)
    machine.main = axis
    axis.speed = 4.0
    assert machine.main.speed == 3.0
    machine.axes = [axis_values(True, 2.0)]
    assert plain(machine.axes) == [axis_values(True, 2.0), axis_values(False, 1.5)]
    other = Machine()
    other.axes = machine.axes
    assert plain(other.axes) == plain(machine.axes)


def axis_values(on, speed):
    return {"on": on, "speed": speed}


def test_assign_replaces_all_members():
    machine = Machine(counter=9, name="x")
    assign(machine, {"counter": 4})
    assert plain(machine) == plain(Machine(counter=4))
    assign(machine, Machine(counter=5))
    assert machine.counter == 5
    assign(machine.grid, [8])
    assert list(machine.grid) == [8, 0, 0, 0]


class Twin(Struct):
    on = var(BOOL)
    speed = var(REAL)


def test_two_structs_of_one_shape_are_two_types():
    axis = Axis()
    with pytest.raises(TypeError, match=r"Axis cannot take Twin\("):
        assign(axis, Twin(speed=9.0))
    assert axis.speed == 1.5


@pytest.mark.parametrize("value", [5, None, [1], Axis()])
def test_assign_refuses_another_type(value):
    with pytest.raises(TypeError, match="Machine cannot take "):
        assign(Machine(), value)


def test_a_value_that_does_not_fit_changes_nothing():
    machine = Machine()
    with pytest.raises(ValueRangeError, match=r"\.counter: 70000 is outside 0\.\.65535 of UINT\."):
        assign(machine, {"name": "x", "counter": 70000})
    with pytest.raises(ValueRangeError, match="Machine has no member speeed"):
        assign(machine, {"speeed": 1})
    assert plain(machine) == plain(Machine())


def test_reset_gives_the_initial_values_again():
    machine = Machine(counter=9, grid=[5, 6, 7, 8])
    machine.axes[1].on = True
    reset(machine)
    assert plain(machine) == plain(Machine())


def test_repr_shows_the_members():
    assert repr(Axis(on=True)) == "Axis(on=True, speed=1.5)"
    assert repr(Machine.from_buffer(bytearray(100))).startswith("Machine(not bound")


def test_a_data_block_has_sections_and_the_order_of_the_c_struct():
    class Block(DataBlock):
        enable = var_input(BOOL)
        size = var_input(UINT, 4)
        status = var_output(UINT)
        state = var(UDINT)

    data_type = type_of(Block)
    assert isinstance(data_type, DataBlockType)
    assert [m.section for m in data_type.members] == [
        Section.INPUT,
        Section.INPUT,
        Section.OUTPUT,
        Section.INTERNAL,
    ]
    assert bytes(Block(enable=True, state=9)) == b"\4\0\0\0\x09\0\0\0\1\0\0\0"


def test_a_var_in_out_stands_before_the_internals_and_takes_an_address_only():
    class Block(DataBlock):
        state = var(UDINT)
        axis = var_in_out(ReferenceType(type_of(Axis)))
        anything = var_in_out(UDINT)

    assert [m.section for m in type_of(Block).members[1:]] == [Section.IN_OUT, Section.IN_OUT]
    assert bytes(Block(axis=1, anything=2, state=3)).hex() == "010000000200000003000000"
    with pytest.raises(DeclarationError, match="BOOL is no address; a reference or UDINT"):
        var_in_out(BOOL)


def test_type_of_a_class_a_view_and_a_type():
    machine = Machine()
    assert type_of(machine) is type_of(Machine)
    assert type_of(machine.axes) is type_of(Machine).find("axes")[0].data_type
    assert type_of(INT) is INT


def test_a_subclass_adds_methods_to_the_same_variables():
    class Drive(Axis):
        def stop(self):
            self.speed = 0.0

    drive = Drive()
    drive.stop()
    assert plain(drive) == {"on": False, "speed": 0.0}
    assert (type_of(Drive).name, type_of(Drive).members) == ("Drive", type_of(Axis).members)
    with pytest.raises(AttributeError):
        drive.other = 1


def test_a_struct_without_members_takes_no_byte():
    class Empty(Struct):
        pass

    class Pair(Struct):
        first = var(Empty)
        second = var(SINT)

    class Row(Struct):
        axes = var(ARRAY(Empty, (0, 2)))
        last = var(Empty)

    assert (type_of(Empty).size, repr(Empty())) == (0, "Empty()")
    assert (type_of(Pair).offsets, type_of(Pair).size) == ((0, 0), 1)
    assert (len(Row().axes), repr(Row().last)) == (3, "Empty()")
    assert decode(type_of(Row), b"") == {"axes": [{}, {}, {}], "last": {}}
    reset(Empty())


@pytest.mark.parametrize(
    ("base", "body", "message"),
    [
        (Struct, {"n": lambda: var(INT, 40000)}, "New.n: 40000 is outside -32768..32767 of INT."),
        (
            Struct,
            {"axes": lambda: var(ARRAY(Axis, (1, 2)), [{}, {"speed": "fast"}])},
            "New.axes[1].speed: 'fast' is not a REAL.",
        ),
        (Struct, {"bind": lambda: var(INT)}, "New.bind: a method of "),
        (Axis, {"n": lambda: var(INT)}, "New: "),
        (Struct, {"n": lambda: var(int)}, "<class 'int'> is not a data type."),
        (Struct, {"n": lambda: var("INT")}, "'INT' is not a data type."),
    ],
)
def test_a_wrong_declaration_says_what_is_wrong(base, body, message):
    with pytest.raises(DeclarationError) as caught:
        type(base)("New", (base,), {name: declare() for name, declare in body.items()})
    assert str(caught.value).startswith(message)


def test_the_view_class_of_a_type_is_made_once():
    data_type = StructType("Point", [Member("x", INT, 1)])
    assert view_class(data_type) is view_class(data_type)
    assert view_class(type_of(Machine)) is Machine
    assert isinstance(view_class(DataBlockType("Fb", []))(), DataBlock)


def test_a_face_has_the_type_that_its_body_names():
    data_type = DataBlockType("Ramp", [Member("x", INT, 3)])

    class Face(DataBlock):
        _plc_type = data_type

    assert type_of(Face) is data_type
    assert view_class(data_type) is Face
    assert Face().x == 3


def test_what_a_face_stands_for_takes_its_place():
    data_type = DataBlockType("Ramp", [Member("x", INT, 3)])
    face = type("Ramp", (DataBlock,), {"_plc_type": data_type})

    class Mixin(DataBlock):
        def double(self):
            return 2 * self.x

    class Ramp(face, Mixin):
        pass

    assert type_of(Ramp) is data_type
    assert view_class(data_type) is Ramp
    assert Ramp().double() == 6

    class Steeper(Ramp):
        pass

    class Other(face):
        pass

    for derived in (Steeper, Other):
        assert type_of(derived) is not data_type
        assert type_of(derived).members == data_type.members
    assert view_class(data_type) is Ramp


@pytest.mark.parametrize("name", ["bind", "from_buffer", "from_buffer_copy", "in"])
def test_members_of_a_declared_struct_may_have_any_name(name):
    inner = StructType("Inner", [Member(name, INT, 5), Member("other", INT, 6)])
    outer = view_class(StructType("Outer", [Member("inner", inner)]))()
    assert plain(outer) == {"inner": {name: 5, "other": 6}}
    array = view_class(StructType("Rows", [Member("rows", ArrayType(inner, [(0, 1)]))]))()
    assert getattr(array.rows[1], name) == 5


@given(typed_bytes(struct_types))
def test_views_and_decode_agree_on_any_bytes(typed):
    data_type, image = typed
    view = view_class(data_type).bind(bytearray(image), 0, 0)
    assert repr(plain(view)) == repr(decode(data_type, image))  # repr: NaN is not equal to itself


@given(typed_values(struct_types))
def test_what_is_written_through_a_view_decodes_again(typed):
    data_type, value = typed
    buffer = bytearray(data_type.size)
    view = view_class(data_type).bind(buffer, 0, 0)
    for name, member in value.items():
        setattr(view, name, member)
    assert decode(data_type, bytes(buffer)) == value
    assert bytes(buffer) == encode(data_type, value)


@given(typed_values(structs_with(1)), st.randoms())
def test_members_do_not_touch_their_neighbours(typed, random):
    data_type, value = typed
    view = view_class(data_type)()
    before = plain(view)
    name = random.choice(sorted(before))
    setattr(view, name, value[name])
    assert plain(view) == before | {name: value[name]}


PAIR = ": each dimension is a pair, (low, high)"


@pytest.mark.parametrize(
    ("declare", "error"),
    [
        (lambda: ARRAY(BOOL, 10), f"ARRAY(BOOL, 10){PAIR}; 10 elements are ARRAY(BOOL, (0, 9))."),
        (
            lambda: ARRAY(BOOL, (0, 9), (0, 1, 2)),
            f"ARRAY(BOOL, (0, 9), (0, 1, 2)){PAIR}.",
        ),
        (lambda: ARRAY(BOOL, ("a", 9)), f"ARRAY(BOOL, ('a', 9)){PAIR}."),
        (lambda: STRING("x"), "STRING('x'): a number of characters was expected."),
        (lambda: WSTRING(1.5), "WSTRING(1.5): a number of characters was expected."),
    ],
)
def test_a_malformed_type_is_told_in_plain_words(declare, error):
    with pytest.raises(DeclarationError) as raised:
        declare()
    assert str(raised.value).startswith(error)


def test_a_member_that_cannot_take_a_value_is_told_by_name():
    class Named(Struct):
        x = var(UINT)

    with pytest.raises(ValueRangeError, match=r"x is UINT and cannot be 'a'\."):
        Named(x="a")
    with pytest.raises(AttributeError):
        Named(y=1)


def test_elements_and_enumerations_tell_what_they_cannot_take():
    class Mode(IntEnum):
        OFF = 0

    class Cell(Struct):
        bits = var(ARRAY(BOOL, (0, 1)))
        numbers = var(ARRAY(UINT, (0, 1)))
        mode = var(ENUM(Mode))

    cell = Cell()
    for act, error in (
        (lambda: cell.bits.__setitem__(0, "x"), "'x' is not a BOOL."),
        (lambda: cell.bits.__setitem__(0, 5), "5 is not a BOOL."),
        (lambda: cell.numbers.__setitem__(0, 1.5), "1.5 is not a UINT."),
        (lambda: setattr(cell, "mode", "OFF"), "'OFF' is not a Mode."),
    ):
        with pytest.raises((ValueRangeError, TypeError)) as raised:
            act()
        assert str(raised.value) == error
    cell.bits[1] = 1
    assert list(cell.bits) == [False, True]


def test_the_members_of_a_union_are_views_of_one_place():
    inner = StructType("P", [Member("x", INT), Member("y", INT, 7)])
    members = [Member("real", REAL, 1.0), Member("bits", DWORD, 5), Member("p", inner)]
    union = UnionType("U", members)
    assert (union.size, union.alignment, union.offsets) == (4, 4, (0, 0, 0))
    view = view_class(union)()
    assert (view.real, view.bits, view.p.y) == (1.0, 0x3F800000, 0x3F80)
    view.p.x = -1
    assert view.bits == 0x3F80FFFF
    assert decode(union, encode(union, {"bits": 3}))["p"] == {"x": 3, "y": 0}


def test_a_class_declares_a_union():
    class Both(Union):
        real = var(REAL, 2.0)
        bits = var(DWORD)

    assert Both().bits == 0x40000000
