"""Values as text and back."""

from enum import IntEnum

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.library.value_text import text_of, value_of
from plcsim.testing.strategies import values_of
from st_types import BOOL, DINT, ENUM, LREAL, REAL, STRING, TIME, ULINT
from st_types.types.values import decode, encode


class Light(IntEnum):
    RED = 0
    GREEN = 1


LIGHT = ENUM(Light)


@pytest.mark.parametrize("data_type", [BOOL, DINT, ULINT, TIME, REAL, LREAL, LIGHT])
@given(st.data())
def test_text_gives_the_same_bytes_back(data_type, data):
    value = decode(data_type, encode(data_type, data.draw(values_of(data_type))))
    assert encode(data_type, value_of(data_type, text_of(data_type, value))) == encode(
        data_type, value
    )


@pytest.mark.parametrize(
    ("data_type", "text", "value"),
    [
        (BOOL, "true", True),
        (BOOL, "0", False),
        (DINT, "-1_000", -1000),
        (DINT, "16#FF", 255),
        (TIME, "250ms", 250),
        (TIME, "1.5s", 1500),
        (TIME, "250", 250),
        (LIGHT, "GREEN", 1),
        (LIGHT, "0", 0),
        (STRING(5), "GREEN", "GREEN"),
        (REAL, "1e3", 1000.0),
    ],
)
def test_notations(data_type, text, value):
    assert value_of(data_type, text) == value


@pytest.mark.parametrize(
    ("data_type", "text"),
    [(BOOL, "2"), (BOOL, "on"), (DINT, "x"), (DINT, "1.5"), (TIME, "1us"), (LIGHT, "BLUE")],
)
def test_what_is_no_value_is_refused(data_type, text):
    with pytest.raises(ValueError, match=r"."):
        value_of(data_type, text)
