import ctypes

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types import ARRAY, BOOL, DINT, INT, LINT, LREAL, REAL, SINT, STRING, UDINT
from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
    SubrangeType,
    WStringType,
    data_block_order,
)
from st_types.types.elementary import ELEMENTARY
from st_types.types.layout import align_up, lay_out

from ..random_types import structs_with

IN, OUT, IN_OUT, VAR = Section

INTERNALS = "i_state UINT, i_result UINT, i_tmp UDINT"

# Inputs, outputs, internals in the order of the .fun files; size and offsets as gcc -m32 measures
# them in the headers that Automation Studio generates.
DATA_BLOCKS = {
    "TcpOpen": (
        "enable BOOL, pIfAddr UDINT, port UINT, options UDINT",
        "status UINT, ident UDINT",
        INTERNALS,
        32,
        """pIfAddr 0, port 4, options 8, status 12, ident 16,
        i_state 20, i_result 22, i_tmp 24, enable 28""",
    ),
    "TcpOpenSsl": (
        "enable BOOL, pIfAddr UDINT, port UINT, sslCfgIdent UDINT, options UDINT",
        "status UINT, ident UDINT",
        INTERNALS,
        36,
        """pIfAddr 0, port 4, sslCfgIdent 8, options 12, status 16, ident 20,
        i_state 24, i_result 26, i_tmp 28, enable 32""",
    ),
    "TcpServer": (
        "enable BOOL, ident UDINT, backlog UDINT, pIpAddr UDINT",
        "status UINT, identclnt UDINT, portclnt UINT",
        INTERNALS,
        36,
        """ident 0, backlog 4, pIpAddr 8, status 12, identclnt 16, portclnt 20,
        i_state 22, i_result 24, i_tmp 28, enable 32""",
    ),
    "TcpClient": (
        "enable BOOL, ident UDINT, pServer UDINT, portserv UINT",
        "status UINT",
        INTERNALS,
        24,
        """ident 0, pServer 4, portserv 8, status 10,
        i_state 12, i_result 14, i_tmp 16, enable 20""",
    ),
    "TcpClose": (
        "enable BOOL, ident UDINT, how UDINT",
        "status UINT",
        INTERNALS,
        24,
        "ident 0, how 4, status 8, i_state 10, i_result 12, i_tmp 16, enable 20",
    ),
    "TcpSend": (
        "enable BOOL, ident UDINT, pData UDINT, datalen UDINT, flags UDINT",
        "status UINT, sentlen UDINT",
        INTERNALS,
        36,
        """ident 0, pData 4, datalen 8, flags 12, status 16, sentlen 20,
        i_state 24, i_result 26, i_tmp 28, enable 32""",
    ),
    "TcpRecv": (
        "enable BOOL, ident UDINT, pData UDINT, datamax UDINT, flags UDINT",
        "status UINT, recvlen UDINT",
        INTERNALS,
        36,
        """ident 0, pData 4, datamax 8, flags 12, status 16, recvlen 20,
        i_state 24, i_result 26, i_tmp 28, enable 32""",
    ),
    "TcpIoctl": (
        "enable BOOL, ident UDINT, ioctl UDINT, pData UDINT, datalen UDINT",
        "status UINT, outlen UDINT",
        INTERNALS,
        36,
        """ident 0, ioctl 4, pData 8, datalen 12, status 16, outlen 20,
        i_state 24, i_result 26, i_tmp 28, enable 32""",
    ),
    "TON": (
        "IN BOOL, PT TIME",
        "Q BOOL, ET TIME",
        "StartTime TIME, M BOOL, Restart UDINT",
        20,
        "PT 0, ET 4, StartTime 8, Restart 12, IN 16, Q 17, M 18",
    ),
}


def pairs(text):
    return [tuple(pair.split()) for pair in text.split(",")]


@pytest.mark.parametrize("name", DATA_BLOCKS)
def test_data_block_is_the_generated_c_struct(name):
    *sections, size, offsets = DATA_BLOCKS[name]
    data_type = DataBlockType(
        name,
        [
            Member(member, ELEMENTARY[type_name], None, section)
            for section, text in zip((IN, OUT, VAR), sections, strict=True)
            for member, type_name in pairs(text)
        ],
    )
    assert (data_type.size, data_type.alignment) == (size, 4)
    found = sorted(zip(data_type.offsets, (m.name for m in data_type.members), strict=True))
    assert [(member, str(offset)) for offset, member in found] == pairs(offsets)


@pytest.mark.parametrize(
    ("types", "offsets", "size", "alignment"),
    [
        ((), (), 0, 1),
        ((StructType("Empty", ()), BOOL), (0, 0), 1, 1),
        ((BOOL,), (0,), 1, 1),
        ((UDINT, UDINT), (0, 4), 8, 4),  # tcpLINGER_typ, tcpSO_ADDRESS_typ
        ((BOOL, UDINT), (0, 4), 8, 4),
        ((UDINT, BOOL), (0, 4), 8, 4),
        ((BOOL, INT, BOOL), (0, 2, 4), 6, 2),
        ((BOOL, LREAL), (0, 4), 12, 4),
        ((INT, LINT, SINT), (0, 4, 12), 16, 4),
        ((STRING(4), STRING(1), INT), (0, 5, 8), 10, 2),
        ((STRING(4), BOOL), (0, 5), 6, 1),
        ((BOOL, ARRAY(INT, (1, 3)), BOOL), (0, 2, 8), 10, 2),
        ((BOOL, REAL, BOOL, DINT), (0, 4, 8, 12), 16, 4),
    ],
)
def test_members_lie_one_after_another(types, offsets, size, alignment):
    assert lay_out(types) == (offsets, size, alignment)


def test_a_nested_struct_keeps_its_own_alignment():
    inner = StructType("Inner", [Member("a", BOOL), Member("b", INT)])
    outer = StructType("Outer", [Member("x", BOOL), Member("i", inner), Member("y", BOOL)])
    assert (outer.offsets, outer.size, outer.alignment) == ((0, 2, 6), 8, 2)


@pytest.mark.parametrize(
    ("offset", "alignment", "expected"), [(0, 4, 0), (1, 4, 4), (4, 4, 4), (5, 1, 5), (7, 2, 8)]
)
def test_align_up(offset, alignment, expected):
    assert align_up(offset, alignment) == expected


def test_bools_arrays_of_them_and_their_aliases_go_to_the_end_of_a_data_block():
    flags = AliasType("Flags", ARRAY(AliasType("Flag", BOOL), (0, 1)))
    members = [
        Member("on", BOOL, None, IN),
        Member("flags", flags, None, IN),
        Member("where", ReferenceType(BOOL), None, IN),
        Member("n", INT, None, OUT),
    ]
    assert data_block_order(members) == (2, 3, 0, 1)


@given(st.lists(st.tuples(st.sampled_from([BOOL, INT, UDINT]), st.sampled_from(Section))))
def test_data_block_order_is_groups_in_order_of_declaration(declared):
    members = [Member(f"m{i}", t, None, section) for i, (t, section) in enumerate(declared)]
    groups = [
        [i for i, (t, s) in enumerate(declared) if (t is BOOL) is digital and s is section]
        for digital in (False, True)
        for section in (IN, OUT, IN_OUT, VAR)
    ]
    assert list(data_block_order(members)) == [i for group in groups for i in group]


# An independent check: ctypes with _pack_ = 4 aligns as the i386 ABI does.

C_TYPES = {
    "b": ctypes.c_int8,
    "B": ctypes.c_uint8,
    "h": ctypes.c_int16,
    "H": ctypes.c_uint16,
    "i": ctypes.c_int32,
    "I": ctypes.c_uint32,
    "q": ctypes.c_int64,
    "Q": ctypes.c_uint64,
    "f": ctypes.c_float,
    "d": ctypes.c_double,
}


def c_type(data_type):
    match data_type:
        case AliasType(target=target):
            return c_type(target)
        case StringType(length=length):
            return ctypes.c_char * (length + 1)
        case WStringType(length=length):
            return ctypes.c_uint16 * (length + 1)
        case EnumerationType() | ReferenceType():
            return ctypes.c_uint32
        case SubrangeType(base=base):
            return C_TYPES[base.code]
        case ArrayType(element=element, count=count):
            return c_type(element) * count
        case StructType():
            return c_struct(data_type)
    return C_TYPES[data_type.code]


def is_digital(data_type):
    if isinstance(data_type, AliasType):
        return is_digital(data_type.target)
    if isinstance(data_type, ArrayType):
        return is_digital(data_type.element)
    return data_type is BOOL


def c_struct(data_type):
    members = data_type.members
    if isinstance(data_type, DataBlockType):
        members = sorted(members, key=lambda m: (is_digital(m.data_type), m.section.value))
    fields = [(m.name, c_type(m.data_type)) for m in members]
    body = {"_pack_": 4, "_layout_": "ms", "_fields_": fields}
    return type("C", (ctypes.Structure,), body)


@given(structs_with(1))
def test_random_types_lie_as_in_c(data_type):
    expected = c_struct(data_type)
    assert data_type.size == ctypes.sizeof(expected)
    for member, offset in zip(data_type.members, data_type.offsets, strict=True):
        assert offset == getattr(expected, member.name).offset, member
        assert offset % member.data_type.alignment == 0
