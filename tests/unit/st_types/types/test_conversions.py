import ctypes
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from st_types.types.conversions import convert, saturate
from st_types.types.elementary import ELEMENTARY, LINT, ElementaryType, Kind

TYPES = sorted(set(ELEMENTARY.values()), key=str)
INTEGERS = [t for t in TYPES if t.is_integer]
SIGNED = {"b": ctypes.c_int8, "h": ctypes.c_int16, "i": ctypes.c_int32, "q": ctypes.c_int64}
UNSIGNED = {"B": ctypes.c_uint8, "H": ctypes.c_uint16, "I": ctypes.c_uint32, "Q": ctypes.c_uint64}
C_TYPES = SIGNED | UNSIGNED


@pytest.mark.parametrize(
    ("value", "target", "expected"),
    [
        (300, "USINT", 44),
        (-1, "UINT", 65535),
        (40000, "INT", -25536),
        (True, "DINT", 1),
        (0, "BOOL", False),
        (-7, "BOOL", True),
        (0.1, "BOOL", True),
        (2.5, "INT", 3),
        (-2.5, "INT", -3),
        (2.4, "DINT", 2),
        (0.49999999999999994, "DINT", 1),  # adding a half rounds up to 1, in C as well
        (65537.0, "UINT", 1),
        (-1.0, "UDINT", 2**32 - 1),
        (5e9, "UDINT", 5_000_000_000 - 2**32),
        (5e9, "DINT", -(2**31)),
        (5e9, "INT", 0),
        (1e30, "LINT", -(2**63)),
        (2.0**63, "ULINT", 2**63),
        (1e30, "UDINT", 0),
        (math.nan, "DINT", -(2**31)),
        (-math.inf, "SINT", 0),
        (1500, "TIME", 1500),
        (-1, "TIME", -1),
        (0.1, "REAL", 0.10000000149011612),
        (0.1, "LREAL", 0.1),
        (1e39, "REAL", math.inf),
        (-1e39, "REAL", -math.inf),
        (16777217, "REAL", 16777216.0),
    ],
)
def test_conversions(value: float, target: str, expected: object) -> None:
    found = convert(value, ELEMENTARY[target])
    assert found == expected
    assert type(found) is type(expected)


@pytest.mark.parametrize(
    ("value", "target", "expected"),
    [
        (300, "USINT", 255),
        (-1, "USINT", 0),
        (40000, "INT", 32767),
        (1e30, "DINT", 2**31 - 1),
        (-math.inf, "DINT", -(2**31)),
        (math.inf, "UINT", 65535),
        (math.nan, "UINT", 0),
        (2.5, "SINT", 3),
        (5, "BOOL", True),
        (1e39, "REAL", 3.4028234663852886e38),
        (-1e39, "REAL", -3.4028234663852886e38),
        (math.inf, "REAL", math.inf),
        (1e300, "LREAL", 1e300),
    ],
)
def test_saturation(value: float, target: str, expected: object) -> None:
    found = saturate(value, ELEMENTARY[target])
    assert found == expected
    assert type(found) is type(expected)


@given(st.sampled_from(INTEGERS), st.integers(-(2**70), 2**70))
def test_integers_wrap_as_in_c(target: ElementaryType[int], value: int) -> None:
    assert convert(value, target) == C_TYPES[target.code](value).value


@given(
    st.sampled_from(TYPES),
    st.one_of(st.booleans(), st.integers(-(2**64), 2**64), st.floats()),
)
def test_what_comes_out_is_a_value_of_the_type(target: ElementaryType, value: float) -> None:
    for change in (convert, saturate):
        found = change(value, target)
        if target.kind is Kind.BOOL:
            assert isinstance(found, bool)
        elif target.kind is Kind.REAL:
            assert isinstance(found, float)
        else:
            assert isinstance(found, int)
            assert target.minimum <= found <= target.maximum
        again = change(found, target)
        assert again == found or (math.isnan(found) and math.isnan(again))


@given(st.sampled_from(INTEGERS), st.floats(allow_nan=False, allow_infinity=False))
def test_within_the_range_both_round_alike(target: ElementaryType[int], value: float) -> None:
    if target.minimum <= value <= target.maximum - 1:
        found = convert(value, target)
        assert found == saturate(value, target)
        # the controller adds 0.5 and truncates: the sum itself is rounded to the next LREAL
        assert abs(found - value) <= 0.5 + math.ulp(value) / 2
        assert found == int(value + math.copysign(0.5, value))


@pytest.mark.parametrize(
    ("value", "expected"), [(0.49999999999999994, 1), (4503599627370497.0, 4503599627370498)]
)
def test_the_sum_with_a_half_is_rounded_as_on_the_controller(value: float, expected: int) -> None:
    assert convert(value, LINT) == expected
