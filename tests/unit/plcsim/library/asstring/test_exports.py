"""asstring: as C has them; values by hand."""

import pytest


def test_copying_and_appending_give_the_target(plc):
    target = plc.text("")
    assert plc.function("strcpy")(target, plc.text("one")) == target
    assert plc.function("strcat")(target, plc.text(" two")) == target
    assert plc.string(target) == "one two"
    assert plc.function("strlen")(target) == 7
    assert plc.function("strcmp")(target, plc.text("one")) > 0


def test_bytes(plc):
    target = plc.text("abcdef")
    assert plc.function("memmove")(target + 2, target, 3) == target + 2
    assert plc.string(target) == "ababcf"
    assert plc.function("memset")(target, 0x178 & 0xFF, 2) == target
    assert plc.function("memcpy")(target + 4, target, 1) == target + 4
    assert plc.string(target) == "xxabxf"
    assert plc.function("memcmp")(target, plc.text("xxb"), 3) < 0


def test_a_length_wraps(plc):
    address = plc.bytes(b"x" * 65_540 + b"\0")
    assert plc.function("strlen")(address) == 4


@pytest.mark.parametrize("number", [0, -15, 2147483647])
def test_numbers(plc, number):
    target = plc.text("")
    assert plc.function("itoa")(number, target) == len(str(number))
    assert plc.function("atoi")(target) == number
    assert plc.function("atof")(target) == pytest.approx(number)


def test_real_numbers(plc):
    target = plc.text("")
    assert plc.function("ftoa")(2.5, target) == 3
    assert plc.string(target) == "2.5"
