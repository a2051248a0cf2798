"""AsBrStr: values by hand; what it shares with C is tested with the C library."""

import pytest


def test_copies_and_fills(plc):
    source, target = plc.text("abcdef"), plc.text("#########")
    assert plc.function("brsmemcpy")(target, source, 3) == target
    assert plc.string(target) == "abc######"
    assert plc.function("brsmemset")(target, ord("x"), 2) == target
    assert plc.string(target) == "xxc######"
    assert plc.function("brsmemmove")(target + 1, target, 4) == target + 1
    assert plc.string(target) == "xxxc#####"


def test_comparisons(plc):
    a, b = plc.text("abc"), plc.text("abd")
    for compare in (
        plc.function("brsstrcmp"),
        lambda x, y: plc.function("brsmemcmp")(x, y, 3),
    ):
        assert compare(a, b) < 0 < compare(b, a)
        assert compare(a, a) == 0
    assert plc.function("brsmemcmp")(a, b, 2) == 0


def test_copying_and_appending_give_the_address_of_the_end(plc):
    target = plc.text("")
    end = plc.function("brsstrcpy")(target, plc.text("one"))
    assert end == target + 3
    assert plc.function("brsstrcat")(end, plc.text(" two")) == target + 7
    assert plc.function("brsstrcat")(target, plc.text("!")) == target + 8
    assert plc.string(target) == "one two!"
    assert plc.function("brsstrlen")(target) == 8


@pytest.mark.parametrize("number", [0, 7, -1, 2147483647, -2147483648])
def test_whole_numbers(plc, number):
    target = plc.text("")
    assert plc.function("brsitoa")(number, target) == len(str(number))
    assert plc.string(target) == str(number)
    assert plc.function("brsatoi")(target) == number


@pytest.mark.parametrize(
    ("number", "text"),
    [
        (0.0, "0"),
        (115.4, "115.4"),
        (-0.5, "-0.5"),
        (1 / 3, "0.3333333"),
        (1.5e10, "1.5e+10"),
        (1234567.0, "1234567"),
        (1e-7, "1e-07"),
    ],
)
def test_real_numbers(plc, number, text):
    target = plc.text("")
    assert plc.function("brsftoa")(number, target) == len(text)
    assert plc.string(target) == text


@pytest.mark.parametrize(
    ("text", "number"), [("1.5", 1.5), (" -2e3x", -2000.0), ("", 0.0), ("x", 0.0), (".25", 0.25)]
)
def test_reading_numbers(plc, text, number):
    assert plc.function("brsatof")(plc.text(text)) == number
    assert plc.function("brsatod")(plc.text(text)) == number
    assert plc.function("brsatod")(plc.text("0.1")) == 0.1


@pytest.mark.parametrize(("text", "number"), [(" 42abc", 42), ("-7", -7), ("abc", 0), ("+3.9", 3)])
def test_reading_whole_numbers(plc, text, number):
    assert plc.function("brsatoi")(plc.text(text)) == number
