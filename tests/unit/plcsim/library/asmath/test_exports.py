"""Mathematics of REAL: values by hand; the C library's own tests go on from there."""

import math
import struct

import pytest

from plcsim.library.asmath import amPI_4

PREFIX = ""


def real(number):
    return struct.unpack("f", struct.pack("f", number))[0]


@pytest.mark.parametrize(
    ("name", "arguments", "result"),
    [
        ("floor", (-1.5,), -2.0),
        ("ceil", (-1.5,), -1.0),
        ("fmod", (-7.5, 2.0), -1.5),
        ("pow", (2.0, 0.5), math.sqrt(2)),
        ("atan2", (1.0, -1.0), 3 * math.pi / 4),
        ("sinh", (1.0,), math.sinh(1)),
        ("cosh", (1.0,), math.cosh(1)),
        ("tanh", (1.0,), math.tanh(1)),
        ("ldexp", (1.5, 4), 24.0),
    ],
)
def test_values(plc, name, arguments, result):
    assert plc.function(PREFIX + name)(*arguments) == pytest.approx(real(result), rel=1e-7)


def test_mantissa_and_exponent(plc):
    place = plc.bytes(bytes(4))
    assert plc.function(PREFIX + "frexp")(-12.0, place) == -0.75
    assert plc.memory.read(place, 4) == struct.pack("i", 4)


def test_fraction_and_whole_part(plc):
    place = plc.bytes(bytes(4))
    assert plc.function(PREFIX + "modf")(-3.25, place) == -0.25
    assert plc.memory.read(place, 4) == struct.pack("f", -3.0)


def test_constants():
    assert pytest.approx(math.pi / 4, rel=1e-5) == amPI_4
