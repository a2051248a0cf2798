import math

import pytest

from plcsim.program.structured_text.codegen.mathematics import FUNCTIONS
from plcsim.program.structured_text.codegen.runtime import MATHEMATICS

NAN, INF = math.nan, math.inf


def test_there_is_every_function_that_modules_import():
    assert {f"rt.{name}" for name in FUNCTIONS} == set(MATHEMATICS)


@pytest.mark.parametrize(
    ("name", "arguments", "result"),
    [
        ("sin", (0.5,), math.sin(0.5)),
        ("sin", (INF,), NAN),
        ("cos", (-INF,), NAN),
        ("tan", (INF,), NAN),
        ("asin", (1.5,), NAN),
        ("acos", (-1.5,), NAN),
        ("acos", (1.0,), 0.0),
        ("atan", (INF,), math.pi / 2),
        ("exp", (1000.0,), INF),
        ("exp", (-1000.0,), 0.0),
        ("log", (0.0,), -INF),
        ("log", (-0.0,), -INF),
        ("log", (-1.0,), NAN),
        ("log", (INF,), INF),
        ("log", (NAN,), NAN),
        ("log10", (1000.0,), 3.0),
        ("log10", (-1.0,), NAN),
        ("pow", (2.0, 0.5), 2**0.5),
        ("pow", (0.0, -1.0), INF),
        ("pow", (-0.0, -1.0), -INF),
        ("pow", (-0.0, -2.0), INF),
        ("pow", (-8.0, 1 / 3), NAN),
        ("pow", (1e300, 2.0), INF),
        ("pow", (-1e300, 3.0), -INF),
        ("pow", (-1e300, 2.0), INF),
        ("pow", (NAN, 0.0), 1.0),
        ("fmod", (5.5, 2.0), 1.5),
        ("fmod", (-5.5, 2.0), -1.5),
        ("fmod", (1.0, 0.0), NAN),
        ("fmod", (INF, 2.0), NAN),
    ],
)
def test_values_are_those_of_c(name, arguments, result):
    found = FUNCTIONS[name](*arguments)
    assert math.isnan(found) if math.isnan(result) else found == result
    assert math.copysign(1, found) == math.copysign(1, result) or math.isnan(result)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_nothing_raises(name):
    values = (0.0, -0.0, 1.0, -1.0, 0.5, 2.0, 3.0, -3.0, 1e308, -1e308, 5e-324, INF, -INF, NAN)
    for one in values:
        for other in values:
            arguments = (one, other) if name in ("pow", "fmod") else (one,)
            assert isinstance(FUNCTIONS[name](*arguments), float)
