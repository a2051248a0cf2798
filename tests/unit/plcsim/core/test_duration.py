"""Durations as people write and read them."""

import contextlib

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.core.duration import format_duration, parse_duration_ns


@pytest.mark.parametrize(
    ("text", "duration_ns"),
    [
        ("1ns", 1),
        ("500us", 500_000),
        ("500µs", 500_000),
        ("10ms", 10_000_000),
        (" 10 ms ", 10_000_000),
        ("10MS", 10_000_000),
        ("1.5s", 1_500_000_000),
        ("0.001us", 1),
        ("2min", 120_000_000_000),
        ("2m", 120_000_000_000),
        ("1.5h", 5_400_000_000_000),
        ("0s", 0),
    ],
)
def test_a_number_with_a_unit(text, duration_ns):
    assert parse_duration_ns(text) == duration_ns


@pytest.mark.parametrize(
    "text", ["", "10", "ms", "10 parsecs", "-1s", "+1s", "1e3s", "1,5s", ".5s", "1.s", "1h30m"]
)
def test_what_is_no_duration_says_what_one_looks_like(text):
    with pytest.raises(ValueError, match="is not a duration such as"):
        parse_duration_ns(text)


def test_a_fraction_of_a_nanosecond_is_refused():
    with pytest.raises(ValueError, match="not a whole number of nanoseconds"):
        parse_duration_ns("0.5ns")


@given(st.text(max_size=12))
def test_any_text_is_a_duration_or_a_value_error(text):
    with contextlib.suppress(ValueError):
        assert parse_duration_ns(text) >= 0


@pytest.mark.parametrize(
    ("duration_ns", "text"),
    [
        (0, "0 ns"),
        (999, "999 ns"),
        (1_000, "1 us"),
        (26_736, "26.7 us"),
        (999_499, "999 us"),
        (999_999, "1000 us"),
        (1_000_000, "1 ms"),
        (16_500_000, "16.5 ms"),
        (30_000_000_000, "30 s"),
        (1_234_000_000_000, "1234 s"),
        (7_200_500_000_000, "7200 s"),
        (86_400_700_000_000, "86401 s"),
    ],
)
def test_a_duration_reads_well(duration_ns, text):
    assert format_duration(duration_ns) == text


@given(st.integers(0, 10**18))
def test_what_is_read_is_what_was_meant_to_three_digits(duration_ns):
    text = format_duration(duration_ns)
    assert "e" not in text
    assert abs(parse_duration_ns(text) - duration_ns) <= duration_ns / 199


@given(st.integers(1, 999), st.sampled_from(["ns", "us", "ms", "s"]))
def test_whole_numbers_of_a_unit_are_exact(number, unit):
    duration_ns = parse_duration_ns(f"{number}{unit}")
    assert format_duration(duration_ns) == f"{number} {unit}"
