"""Formatted texts and numbers in texts: the exact ones, as the host and Python have them."""

import ctypes
import math
import struct

import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from tests.unit.plcsim.ansi_c.c_library_world import AREA, HOST, World

WORLD = World()

ints = st.integers(-(2**31), 2**31 - 1)
doubles = st.floats(allow_nan=False, allow_infinity=False)
flags = st.sampled_from(["", "-", "0", "+", " ", "-+", "+0", "#"])
widths = st.sampled_from(["", "1", "8", "20"])
precisions = st.sampled_from(["", ".0", ".1", ".3", ".10"])


@given(ints, flags, widths, precisions, st.sampled_from("di"))
def test_whole_numbers(value, flag, width, precision, kind):
    flag = flag.replace("#", "")
    if precision:
        flag = flag.replace("0", "")
    if (precision, value) == (".0", 0):
        return  # C writes nothing for it, and Python a 0
    text = f"%{flag}{width}{precision}{kind}"
    assert WORLD.formatted(text.encode(), value)[0] == text % value


@given(st.integers(0, 2**32 - 1), flags, widths, st.sampled_from("xX"))
def test_hexadecimal_numbers(value, flag, width, kind):
    flag = flag.replace("+", "").replace(" ", "")
    expected = f"%{flag if value else flag.replace('#', '')}{width}{kind}" % value
    assert WORLD.formatted(f"%{flag}{width}{kind}".encode(), value)[0] == expected


@given(doubles, flags, widths, precisions, st.sampled_from("feEgG"))
@example(2.5, "", "", ".0", "f")
@example(5e-324, "", "", ".10", "e")
@example(1.7976931348623157e308, "", "", ".10", "f")
@example(9.9999995, "", "", "", "g")
@example(0.0, "#", "", "", "g")
def test_floating_point_numbers(value, flag, width, precision, kind):
    text = f"%{flag}{width}{precision}{kind}"
    assert WORLD.formatted(text.encode(), value)[0] == text % value


@given(doubles)
def test_hexadecimal_floating_point_numbers(value):
    text, _ = WORLD.formatted(b"%a", value)
    assert float.fromhex(text) == value


@pytest.mark.parametrize(
    ("text", "values", "result"),
    [
        (b"%d of %s%%", (7, "abc"), "7 of abc%"),
        (b"%lld", ((-(2**63), 64),), "-9223372036854775808"),
        (b"%llu %u", ((2**64 - 1, 64), 5), "18446744073709551615 5"),
        (b"%hd %hhd", (70000, 300), "4464 44"),
        (b"%c%c", (65, 66), "AB"),
        (b"%5c|%-3c|", (65, 66), "    A|B  |"),
        (b"%.2s|%5s|%-5s|", ("abc", "xy", "z"), "ab|   xy|z    |"),
        (b"%*d|%-*d|%.*f", (5, 42, 4, 7, 1, 2.25), "   42|7   |2.2"),
        (b"%f %F %e", (math.inf, -math.inf, math.nan), "inf -INF nan"),
        (b"%p", (0x1234,), "0x1234"),
        (b"%#o %o", (8, 8), "010 10"),
        (b"%s", (None,), "(null)"),
        (b"%y %", (), "%y %"),
    ],
)
def test_a_format(text, values, result):
    given_, at = [], AREA
    for value in values:
        if isinstance(value, str):
            given_.append(WORLD.text(at, value.encode()))
            at += 100
        else:
            given_.append(0 if value is None else value)
    assert WORLD.formatted(text, *given_) == (result, len(result))


@given(st.integers(0, 12))
def test_snprintf_cuts_off_and_tells_the_whole_length(size):
    WORLD.memory.write(AREA + 0x2000, b"\x55" * 20)
    text, count = WORLD.formatted(b"%s", WORLD.text(AREA, b"0123456789"), size=size)
    assert count == 10
    if size:
        assert text == "0123456789"[: size - 1]
    assert WORLD.memory.read(AREA + 0x2000 + size, 8) == b"\x55" * 8


def number_of(text, name="strtod", results="d"):
    end = AREA + 0x1FF0
    value = WORLD.call(name, WORLD.text(AREA, text), end, results=results)
    return value, int.from_bytes(WORLD.memory.read(end, 4), "little") - AREA


@given(doubles)
@example(2.2250738585072011e-308)
@example(5e-324)
@example(1.7976931348623157e308)
def test_a_number_comes_back_from_its_text(value):
    assert number_of(repr(value).encode()) == (value, len(repr(value)))


@given(st.text("0123456789", min_size=1, max_size=40), st.integers(-340, 320))
def test_digits_without_end_are_rounded_once(digits, exponent):
    text = f"{digits[0]}.{digits[1:]}e{exponent}"
    assert number_of(text.encode())[0] == float(text)


@given(st.floats(width=32, allow_nan=False, allow_infinity=False), st.floats(-1, 1))
def test_a_real_is_the_nearest(value, part):
    """Also close to the middle between two, where rounding by way of double would go wrong."""
    exact = repr(value + part * math.ulp(value) * 2.0**28)
    HOST.strtof.restype = ctypes.c_float
    expected = HOST.strtof(exact.encode(), None)
    assert number_of(exact.encode(), "strtof", "f")[0] == expected


@pytest.mark.parametrize(
    ("text", "value", "length"),
    [
        (b"  +1.5e2x", 150.0, 8),
        (b"-.5", -0.5, 3),
        (b"1e", 1.0, 1),
        (b"1e+", 1.0, 1),
        (b"0x1.8p3", 12.0, 7),
        (b"-0", -0.0, 2),
        (b"infinity!", math.inf, 8),
        (b"-inf", -math.inf, 4),
        (b"1e999", math.inf, 5),
        (b"1e-999", 0.0, 6),
        (b"abc", 0.0, 0),
        (b".", 0.0, 0),
    ],
)
def test_a_number_ends_where_it_ends(text, value, length):
    found = number_of(text)
    assert found == (value, length)
    assert math.copysign(1, found[0]) == math.copysign(1, value)


@pytest.mark.parametrize(
    ("name", "text", "base", "value", "length"),
    [
        ("strtol", b" -42x", 10, -42, 4),
        ("strtol", b"0x1F", 0, 31, 4),
        ("strtol", b"017", 0, 15, 3),
        ("strtol", b"0x", 16, 0, 1),
        ("strtol", b"zz", 36, 1295, 2),
        ("strtol", b"2147483648", 10, 2**31 - 1, 10),
        ("strtol", b"-2147483649", 10, -(2**31), 11),
        ("strtoul", b"-1", 10, -1, 2),
        ("strtoul", b"4294967296", 10, -1, 10),
        ("strtol", b"+", 10, 0, 0),
    ],
)
def test_a_whole_number_ends_where_it_ends(name, text, base, value, length):
    end = AREA + 0x1FF0
    found = WORLD.call(name, WORLD.text(AREA, text), end, base, params="III")
    assert (found, int.from_bytes(WORLD.memory.read(end, 4), "little") - AREA) == (value, length)


def scanned(text, pattern, *sizes):
    """Return what sscanf returns, and the bytes of its targets."""
    targets = [AREA + 0x800 + 0x80 * n for n in range(len(sizes))]
    for target in targets:
        WORLD.memory.write(target, b"\x55" * 0x80)
    at = WORLD.arguments(AREA + 0x1800, targets)
    where = WORLD.text(AREA, text), WORLD.text(AREA + 0x400, pattern)
    count = WORLD.call("sscanf", *where, at, params="III")
    return count, *(WORLD.memory.read(t, s) for t, s in zip(targets, sizes, strict=True))


def test_sscanf_reads_what_its_format_says():
    number = struct.pack("<i", 12)
    assert scanned(b"12 3.5 abc", b"%d %f %s", 4, 4, 4) == (
        3,
        number,
        struct.pack("<f", 3.5),
        b"abc\0",
    )
    assert scanned(b"127.0.0.1", b"%u.%u.%u.%u", 1, 1, 1, 1) == (4, b"\x7f", b"\0", b"\0", b"\1")
    assert scanned(b"12345", b"%2d%3d", 4, 4) == (2, number, struct.pack("<i", 345))
    assert scanned(b"key=value;", b"%[^=]=%[a-z]", 4, 6) == (2, b"key\0", b"value\0")
    assert scanned(b"7 8", b"%*d %d", 1) == (1, b"\x08")
    assert scanned(b"x", b"%d", 1) == (0, b"\x55")
    assert scanned(b"", b"%d", 1) == (-1, b"\x55")
    assert scanned(b"1.5", b"%lf%n", 8, 4) == (1, struct.pack("<d", 1.5), struct.pack("<i", 3))
    assert scanned(b"ab", b"%c%c", 1, 1) == (2, b"a", b"b")
    assert scanned(b"ff FE", b"%x %hhX", 4, 2) == (2, b"\xff\0\0\0", b"\xfe\x55")


def test_what_is_printed_goes_to_the_scan_s_output(capsys):
    at = WORLD.arguments(AREA + 0x1800, [5, 1.5])
    WORLD.call("printf", WORLD.text(AREA, b"%d %g\n"), at)
    WORLD.call("puts", WORLD.text(AREA, b"x" * 700))
    WORLD.call("fputs", WORLD.text(AREA, b"wrong\xff"), 2)
    out, err = capsys.readouterr()
    assert out == "5 1.5\n" + "x" * 700 + "\n"
    assert err == "wrong\\xff"


@pytest.mark.parametrize(
    ("text", "wide", "result"),
    [
        (b"%ls|", "wide", b"wide|"),
        (b"%8ls|", "gr\xfcn", b"   gr\xc3\xbcn|"),
        (b"%-6.3ls|", "gr\xfcn", b"gr    |"),  # no half character
        (b"%.2ls|", "wide", b"wi|"),
        (b"%ls|", "", b"|"),
    ],
)
def test_wide_texts(text, wide, result):
    at = AREA + 0x1C00
    WORLD.memory.write(at, f"{wide}\0".encode("utf-32-le"))
    found, count = WORLD.formatted(text, at)
    assert (found.encode("latin-1"), count) == (result, len(result))


def test_wide_characters_and_a_wide_text_that_is_nowhere():
    assert WORLD.formatted(b"%lc%3lc|%ls", 0x41, 0xE4, 0)[0] == "A \xc3\xa4|(null)"
