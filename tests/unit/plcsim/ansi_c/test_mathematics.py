"""Mathematics of the C library: right to the last place but one, and the same everywhere."""

import hashlib
import math
import random
import struct
from fractions import Fraction

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.unit.plcsim.ansi_c.c_library_world import World

WORLD = World()

ANY = (-1e300, -1e5, -700.0, -2.0, -0.7, -1e-5, -0.0, 0.0, 1e-300, 0.3, 1.0, 3.5, 170.0, 1e9, 1e300)
UNIT = (-1.0, -0.9, -0.5, -1e-9, -0.0, 0.0, 1e-300, 0.3, 0.5, 0.99999, 1.0)
SMALL = (-700.0, -30.0, -1.0, -1e-9, -0.0, 0.0, 1e-300, 0.5, 1.0, 20.0, 700.0)
ABOVE_0 = (5e-324, 1e-300, 1e-9, 0.5, 0.999, 1.0, 1.001, 2.0, 10.0, 1e9, 1e300)
ONE = {
    **dict.fromkeys(("sin", "cos", "tan", "atan", "cbrt", "erf", "erfc", "asinh", "tanh"), ANY),
    **dict.fromkeys(("floor", "ceil", "trunc", "fabs"), ANY),
    **dict.fromkeys(("asin", "acos"), UNIT),
    "atanh": tuple(x for x in UNIT if abs(x) < 1),
    **dict.fromkeys(("exp", "exp2", "expm1", "sinh", "cosh"), SMALL),
    **dict.fromkeys(("log", "log2", "log10", "sqrt"), ABOVE_0),
    "log1p": (-0.999, -1e-9, *ABOVE_0),
    "acosh": tuple(x for x in ABOVE_0 if x >= 1),
    "tgamma": (-3.5, -0.1, 0.1, 1.0, 4.5, 100.5, 170.0),
}
TWO = ("atan2", "pow", "fmod", "hypot", "remainder", "copysign")
_PYTHON = {"tgamma": "gamma"}


def host(name):
    function = getattr(math, _PYTHON.get(name, name))

    def call(*values):
        try:
            return float(function(*values))
        except OverflowError:
            return math.inf

    return call


def near(a, b, places=2):
    return a == b or abs(a - b) <= places * math.ulp(b)


def numbers(values, count=400):
    """Return given numbers and random ones between their ends."""
    source = random.Random(len(values))
    low, high = min(values), max(values)
    return [*values, *(source.uniform(max(low, -1e6), min(high, 1e6)) for _ in range(count))]


@pytest.mark.parametrize("name", ONE)
def test_it_is_what_the_host_has(name):
    ours, theirs = WORLD.library.function(name), host(name)
    places = 16 if name == "tgamma" else 2
    found = [(x, ours(x), theirs(x)) for x in numbers(ONE[name])]
    assert [row for row in found if not near(*row[1:], places)] == []


def test_lgamma_is_what_the_host_has():
    """Near to its zeros it is close to them, not to the last place."""
    for x in numbers(ABOVE_0):
        found = WORLD.library.function("lgamma")(x)
        assert found == pytest.approx(math.lgamma(x), rel=1e-14, abs=1e-14)


@pytest.mark.parametrize("name", TWO)
@given(x=st.floats(-1e9, 1e9), y=st.floats(-30, 30))
def test_of_two_numbers_it_is_what_the_host_has(name, x, y):
    if name == "pow":
        x = abs(x) or 1.0
    if y == 0 and name in ("fmod", "remainder"):
        y = 1.0
    assert near(WORLD.library.function(name)(x, y), host(name)(x, y))


NAN, INF = math.nan, math.inf


@pytest.mark.parametrize(
    ("name", "values", "result"),
    [
        ("sin", (INF,), NAN),
        ("asin", (1.5,), NAN),
        ("log", (0.0,), -INF),
        ("log", (-0.0,), -INF),
        ("log", (-1.0,), NAN),
        ("log10", (INF,), INF),
        ("exp", (1000.0,), INF),
        ("exp", (-1000.0,), 0.0),
        ("exp", (-INF,), 0.0),
        ("sqrt", (-1.0,), NAN),
        ("pow", (0.0, -1.0), INF),
        ("pow", (-0.0, -1.0), -INF),
        ("pow", (-0.0, -2.0), INF),
        ("pow", (-8.0, 1 / 3), NAN),
        ("pow", (NAN, 0.0), 1.0),
        ("pow", (1.0, NAN), 1.0),
        ("pow", (-1.0, INF), 1.0),
        ("pow", (10.0, 400.0), INF),
        ("pow", (-10.0, 401.0), -INF),
        ("fmod", (5.0, 0.0), NAN),
        ("fmod", (INF, 2.0), NAN),
        ("fmod", (5.0, INF), 5.0),
        ("fmod", (-6.0, 3.0), -0.0),
        ("atan2", (-0.0, -1.0), -math.pi),
        ("atan2", (0.0, -0.0), math.pi),
        ("atan", (INF,), math.pi / 2),
        ("round", (2.5,), 3.0),
        ("round", (-0.4,), -0.0),
        ("rint", (2.5,), 2.0),
        ("fmax", (NAN, 1.0), 1.0),
        ("fmin", (0.0, -0.0), -0.0),
    ],
)
def test_where_it_is_not_defined_it_gives_what_the_standard_says(name, values, result):
    """Source: ISO C99, annex F.9."""
    found = WORLD.library.function(name)(*values)
    if math.isnan(result):
        assert math.isnan(found)
    else:
        assert struct.pack("<d", found) == struct.pack("<d", result)


@pytest.mark.parametrize("name", ["sinf", "expf", "logf", "atanf"])
def test_of_a_real_it_is_the_nearest_real(name):
    wide, ours = WORLD.library.function(name[:-1]), WORLD.library.function(name)
    for x in (0.1, 0.5, 1.25, 3.0, 80.0):
        real = struct.unpack("<f", struct.pack("<f", x))[0]
        assert ours(real) == struct.unpack("<f", struct.pack("<f", wide(real)))[0]


def test_numbers_are_taken_apart_and_put_together():
    at = WORLD.memory.allocate(8, 8)
    assert WORLD.library.function("frexp", "dI", "d")(20.0, at) == 0.625
    assert WORLD.memory.read(at, 4) == (5).to_bytes(4, "little")
    assert WORLD.library.function("ldexp", "di", "d")(0.625, 5) == 20.0
    assert WORLD.library.function("modf", "dI", "d")(-3.25, at) == -0.25
    assert struct.unpack("<d", WORLD.memory.read(at, 8)) == (-3.0,)


@given(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4), st.floats(-1e4, 1e4))
def test_fma_rounds_once(x, y, z):
    exact = Fraction(x) * Fraction(y) + Fraction(z)
    assert WORLD.library.function("fma")(x, y, z) == float(exact)


def test_all_of_it_is_bit_equal_on_every_machine():
    """A hash of results: a machine that computes another one breaks that promise."""
    state = hashlib.blake2b(digest_size=8)
    for name in sorted(ONE):
        ours = WORLD.library.function(name)
        for x in numbers(ONE[name]):
            state.update(struct.pack("<d", ours(x)))
    pairs = [(x, y) for x in numbers(ABOVE_0, 60) for y in numbers(SMALL, 30)]
    for name in sorted(TWO):
        ours = WORLD.library.function(name)
        for x, y in pairs:
            result = ours(x, y)
            state.update(b"NaN" if math.isnan(result) else struct.pack("<d", result))
    assert state.hexdigest() == "c52644a807cdd119"
