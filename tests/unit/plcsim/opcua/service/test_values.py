"""Values of IEC types as OPC UA has them, both ways."""

import struct
from datetime import UTC, datetime

import pytest

pytest.importorskip("asyncua")
from asyncua import ua

from plcsim.core.tag import Tag
from plcsim.opcua.model import Leaf, Note
from plcsim.opcua.service.values import MismatchError, VariableCodec
from st_types.types.derived import (
    ArrayType,
    EnumerationType,
    ReferenceType,
    StringType,
    SubrangeType,
    WStringType,
)
from st_types.types.elementary import ELEMENTARY, INT, REAL

MODE = EnumerationType("Mode", {"OFF": 0, "ON": 5})
KIND = ua.VariantType
CODES = ua.StatusCodes


def codec(data_type, note=None):
    return VariableCodec(Leaf("x", Tag("p.x", data_type, 0), is_writable=True, note=note or Note()))


EXAMPLES = [
    (ELEMENTARY["BOOL"], KIND.Boolean, True, b"\1"),
    (ELEMENTARY["SINT"], KIND.SByte, -1, b"\xff"),
    (ELEMENTARY["USINT"], KIND.Byte, 255, b"\xff"),
    (ELEMENTARY["BYTE"], KIND.Byte, 1, b"\1"),
    (INT, KIND.Int16, -2, struct.pack("<h", -2)),
    (ELEMENTARY["UINT"], KIND.UInt16, 65535, b"\xff\xff"),
    (ELEMENTARY["WORD"], KIND.UInt16, 1, b"\1\0"),
    (ELEMENTARY["DINT"], KIND.Int32, -3, struct.pack("<i", -3)),
    (ELEMENTARY["UDINT"], KIND.UInt32, 1 << 31, struct.pack("<I", 1 << 31)),
    (ELEMENTARY["DWORD"], KIND.UInt32, 7, struct.pack("<I", 7)),
    (ELEMENTARY["LINT"], KIND.Int64, -(1 << 40), struct.pack("<q", -(1 << 40))),
    (ELEMENTARY["ULINT"], KIND.UInt64, 1 << 63, struct.pack("<Q", 1 << 63)),
    (REAL, KIND.Float, 1.5, struct.pack("<f", 1.5)),
    (ELEMENTARY["LREAL"], KIND.Double, 0.1, struct.pack("<d", 0.1)),
    (ELEMENTARY["TIME"], KIND.Double, 1500.0, struct.pack("<i", 1500)),
    (
        ELEMENTARY["DATE_AND_TIME"],
        KIND.DateTime,
        datetime(2016, 3, 1, 12, tzinfo=UTC),
        struct.pack("<I", 1456833600),
    ),
    (
        ELEMENTARY["TIME_OF_DAY"],
        KIND.DateTime,
        datetime(1970, 1, 1, 0, 0, 1, 500_000, tzinfo=UTC),
        struct.pack("<I", 1500),
    ),
    (MODE, KIND.Int32, 5, struct.pack("<i", 5)),
    (SubrangeType("Percent", INT, 0, 100), KIND.Int16, 50, struct.pack("<h", 50)),
    (StringType(4), KIND.String, "Käse", "Käse".encode("latin-1") + b"\0"),
    (WStringType(2), KIND.String, "αβ", "αβ".encode("utf-16-le") + b"\0\0"),
    (ArrayType(INT, [(0, 2)]), KIND.Int16, [1, 2, 3], struct.pack("<3h", 1, 2, 3)),
    (
        ArrayType(INT, [(0, 1), (1, 3)]),
        KIND.Int16,
        [[1, 2, 3], [4, 5, 6]],
        struct.pack("<6h", 1, 2, 3, 4, 5, 6),
    ),
]


@pytest.mark.parametrize(
    ("data_type", "kind", "value", "data"), EXAMPLES, ids=[str(e[0]) for e in EXAMPLES]
)
def test_bytes_and_back(data_type, kind, value, data):
    found = codec(data_type).variant(data)

    assert (found.VariantType, found.Value) == (kind, value)
    assert codec(data_type).data(ua.Variant(value, kind)) == data


def test_an_array_says_its_dimensions():
    found = codec(ArrayType(INT, [(0, 1), (1, 3)])).variant(bytes(12))

    assert found.Dimensions == [2, 3]
    assert codec(ArrayType(INT, [(5, 5)])).variant(bytes(2)).is_array


def test_an_address_is_a_number():
    assert codec(ReferenceType(None)).variant(struct.pack("<I", 9)).Value == 9


@pytest.mark.parametrize(
    ("data_type", "variant", "code"),
    [
        (INT, ua.Variant(1, KIND.Int32), CODES.BadTypeMismatch),
        (INT, ua.Variant([1], KIND.Int16), CODES.BadTypeMismatch),
        (ArrayType(INT, [(0, 1)]), ua.Variant(1, KIND.Int16), CODES.BadTypeMismatch),
        (ArrayType(INT, [(0, 1)]), ua.Variant([1], KIND.Int16), CODES.BadOutOfRange),
        (ArrayType(INT, [(0, 1)]), ua.Variant([], KIND.Int16), CODES.BadOutOfRange),
        (MODE, ua.Variant(3, KIND.Int32), CODES.BadOutOfRange),
        (SubrangeType("P", INT, 0, 9), ua.Variant(10, KIND.Int16), CODES.BadOutOfRange),
        (REAL, ua.Variant(float("nan"), KIND.Float), CODES.BadOutOfRange),
        (ELEMENTARY["TIME"], ua.Variant(float("inf"), KIND.Double), CODES.BadOutOfRange),
        (ELEMENTARY["TIME"], ua.Variant(1e12, KIND.Double), CODES.BadOutOfRange),
        (ELEMENTARY["DATE"], ua.Variant(datetime(1969, 1, 1), KIND.DateTime), CODES.BadOutOfRange),  # noqa: DTZ001
        (StringType(2), ua.Variant("abc", KIND.String), CODES.BadOutOfRange),
        (StringType(2), ua.Variant("a\0", KIND.String), CODES.BadOutOfRange),
        (StringType(2), ua.Variant("π", KIND.String), CODES.BadOutOfRange),
        (WStringType(1), ua.Variant("\U0001f600", KIND.String), CODES.BadOutOfRange),
        (StringType(2), ua.Variant(None, KIND.String), CODES.BadTypeMismatch),
        (ELEMENTARY["DATE"], ua.Variant(None, KIND.DateTime), CODES.BadTypeMismatch),
    ],
)
def test_what_does_not_fit_has_its_status_code(data_type, variant, code):
    with pytest.raises(MismatchError) as caught:
        codec(data_type).data(variant)

    assert caught.value.code == code


@pytest.mark.parametrize(
    ("value", "fits"), [(0.0, True), (10.0, True), (10.5, False), (-1.0, False)]
)
def test_limits_of_the_tag_map(value, fits):
    limited = codec(REAL, Note(minimum=0.0, maximum=10.0))

    if fits:
        limited.data(ua.Variant(value, KIND.Float))
    else:
        with pytest.raises(MismatchError):
            limited.data(ua.Variant(value, KIND.Float))
