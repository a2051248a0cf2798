"""Durations that a test gives."""

import pytest

from plcsim.testing import PlcTestError
from plcsim.testing.times import duration_ns


@pytest.mark.parametrize(
    ("given", "expected"), [("250ms", 250_000_000), ("0s", 0), (7, 7), (0, 0), ("1.5us", 1500)]
)
def test_strings_with_a_unit_and_nanoseconds(given, expected):
    assert duration_ns(given) == expected


@pytest.mark.parametrize("given", ["250", "ms", "", -1, 1.5, None, True, "0.1ns"])
def test_everything_else_is_refused_by_name(given):
    with pytest.raises(PlcTestError, match=r"^within: "):
        duration_ns(given, "within")
