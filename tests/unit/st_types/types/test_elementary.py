import ctypes

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.types.elementary import ELEMENTARY, Kind

# name: size, alignment, minimum, maximum; the C types are those of plctypes.h on the Intel target
TABLE = {
    "BOOL": (1, 1, 0, 1),
    "SINT": (1, 1, -128, 127),
    "INT": (2, 2, -32768, 32767),
    "DINT": (4, 4, -2147483648, 2147483647),
    "LINT": (8, 4, -9223372036854775808, 9223372036854775807),
    "USINT": (1, 1, 0, 255),
    "UINT": (2, 2, 0, 65535),
    "UDINT": (4, 4, 0, 4294967295),
    "ULINT": (8, 4, 0, 18446744073709551615),
    "BYTE": (1, 1, 0, 255),
    "WORD": (2, 2, 0, 65535),
    "DWORD": (4, 4, 0, 4294967295),
    "LWORD": (8, 4, 0, 18446744073709551615),
    "REAL": (4, 4, 0, 0),
    "LREAL": (8, 4, 0, 0),
    "TIME": (4, 4, -2147483648, 2147483647),
    "DATE": (4, 4, 0, 4294967295),
    "TIME_OF_DAY": (4, 4, 0, 4294967295),
    "TOD": (4, 4, 0, 4294967295),
    "DATE_AND_TIME": (4, 4, 0, 4294967295),
    "DT": (4, 4, 0, 4294967295),
}

INTEGERS = [t for t in set(ELEMENTARY.values()) if t.is_integer]


def test_every_keyword_is_in_the_table():
    assert ELEMENTARY.keys() == TABLE.keys()


@pytest.mark.parametrize("name", TABLE)
def test_size_alignment_and_range(name):
    data_type = ELEMENTARY[name]
    found = (data_type.size, data_type.alignment, data_type.minimum, data_type.maximum)
    assert found == TABLE[name]


def test_short_forms_are_the_same_type():
    assert ELEMENTARY["TOD"] is ELEMENTARY["TIME_OF_DAY"]
    assert ELEMENTARY["DT"] is ELEMENTARY["DATE_AND_TIME"]


def test_a_type_shows_its_name():
    assert (str(ELEMENTARY["UINT"]), repr(ELEMENTARY["UINT"])) == ("UINT", "<UINT>")


def test_values_of_bool_and_reals_are_no_integers():
    others = {t.name for t in ELEMENTARY.values() if not t.is_integer}
    assert others == {"BOOL", "REAL", "LREAL"}


@pytest.mark.parametrize(
    ("name", "value", "stored"),
    [
        ("USINT", 256, 0),
        ("USINT", -1, 255),
        ("SINT", 128, -128),
        ("INT", 32768, -32768),
        ("INT", -32769, 32767),
        ("UINT", 65536 * 3 + 7, 7),
        ("TIME", 2**31, -(2**31)),
        ("ULINT", 2**64, 0),
        ("LINT", 2**63, -(2**63)),
    ],
)
def test_a_store_wraps(name, value, stored):
    assert ELEMENTARY[name].wrap(value) == stored


@given(st.sampled_from(INTEGERS), st.integers(-(2**70), 2**70))
def test_wrap_is_what_c_does(data_type, value):
    sign = "u" if data_type.minimum == 0 else ""
    c_type = getattr(ctypes, f"c_{sign}int{8 * data_type.size}")
    assert data_type.wrap(value) == c_type(value).value


def test_kinds_tell_bit_strings_durations_and_dates_apart():
    kinds = {name: ELEMENTARY[name].kind for name in ("WORD", "TIME", "DT", "UINT", "INT")}
    assert kinds == {
        "WORD": Kind.BITS,
        "TIME": Kind.DURATION,
        "DT": Kind.DATE,
        "UINT": Kind.UNSIGNED,
        "INT": Kind.SIGNED,
    }
