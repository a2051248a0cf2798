"""Kinds of values: what they take, what they make of it, what they say."""

from pathlib import Path

import pytest

from plcsim.settings.kinds import (
    Converted,
    Duration,
    IpAddress,
    OneOf,
    PathTo,
    SettingKind,
    Size,
    Whole,
    is_loopback,
)

FOLDER = Path()


@pytest.mark.parametrize(
    ("kind", "value", "result"),
    [
        (Whole(-1, 1), -1, -1),
        (Duration(), "1.5s", 1_500_000_000),
        (IpAddress(), "0:0::1", "::1"),
        (Duration(10, 20), "20ns", 20),
        (Size(0, 1 << 31), "16MiB", 16 << 20),
        (Size(0, 1 << 31), "1 KiB", 1024),
        (Size(0, 1 << 31), "2GiB", 1 << 31),
        (Size(0, 100, unit=4), "8", 8),
        (Converted(str.upper), "abc", "ABC"),
        (OneOf(1, "a"), "a", "a"),
        (PathTo(), "a/b", Path("a/b")),
    ],
)
def test_what_is_right_is_converted(kind: SettingKind, value: object, result: object) -> None:
    assert kind.convert(value, FOLDER) == result


@pytest.mark.parametrize(
    ("kind", "value", "text"),
    [
        (Whole(0, 9), 10, "10 is outside 0..9"),
        (Whole(0, 9), "1", "'1' is not a whole number"),
        (Duration(10), "9ns", "'9ns' is less than 10 ns"),
        (Duration(1), "0s", "must be above 0"),
        (Duration(0, 1000), "2us", "'2us' is more than 1 us"),
        (Duration(), "2", '\'2\' is not a duration such as "10ms", "500us" or "1.5s"'),
        (Size(4, 8, unit=4), "6", "'6' must be a multiple of 4 bytes, 4 at least and 8 at most"),
        (Size(4, 8, unit=4), "12", "'12' must be a multiple of 4 bytes, 4 at least and 8 at most"),
        (Size(4, 8), "much", "'much' is not a size such as \"16MiB\""),
        (Size(4, 8), 4, '4 is not a string such as "16MiB"'),
        (Converted(int, '"7"'), 7, '7 is not a string such as "7"'),
        (OneOf(1, 2), True, "True is not 1 or 2"),
        (OneOf("a", "b", "c"), "d", '\'d\' is not "a", "b" or "c"'),
        (PathTo("file"), "nowhere", "there is no such file, 'nowhere'"),
    ],
)
def test_what_is_wrong_is_told(kind: SettingKind, value: object, text: str) -> None:
    with pytest.raises(ValueError) as raised:  # noqa: PT011  # the whole text is compared
        kind.convert(value, FOLDER)
    assert str(raised.value) == text


@pytest.mark.parametrize(
    ("host", "is_own"),
    [("127.0.0.1", True), ("127.9.9.9", True), ("::1", True), ("0.0.0.0", False), ("::", False)],
)
def test_who_reaches_an_address(host: str, *, is_own: bool) -> None:
    assert is_loopback(host) is is_own
