import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from plcsim.machine import MachineError

from .units import Rig

ECHO = """
(func (export "i") (param i32) (result i32) (local.get 0))
(func (export "q") (param i64) (result i64) (local.get 0))
(func (export "f") (param f32) (result f32) (local.get 0))
(func (export "d") (param f64) (result f64) (local.get 0))
(func (export "mixed") (param f64 i32 i64 f32) (result f64)
  (f64.add (local.get 0) (f64.add (f64.convert_i32_s (local.get 1))
    (f64.add (f64.convert_i64_s (local.get 2)) (f64.promote_f32 (local.get 3))))))
(func (export "nothing"))
"""


@pytest.fixture(scope="module")
def unit():
    return Rig().load(ECHO)


BITS = {"i": 32, "I": 32, "q": 64, "Q": 64}


@given(st.sampled_from("iIqQ"), st.sampled_from("iIqQ"), st.integers(-(2**70), 2**70))
def test_integers_wrap_both_ways(unit, code, result, value):
    if BITS[code] != BITS[result]:
        return
    bits = BITS[code]
    echo = unit.function(code.lower(), code, result)
    expected = value % (1 << bits)
    if result in "iq" and expected >> (bits - 1):
        expected -= 1 << bits
    assert echo(value) == expected


@given(st.floats(width=32), st.floats())
def test_numbers_pass_unchanged(unit, single, double):
    for name, value in ("f", single), ("d", double):
        found = unit.function(name)(value)
        assert found == value or (math.isnan(found) and math.isnan(value))
        assert math.copysign(1, found) == math.copysign(1, value) or math.isnan(value)


def test_several_parameters_keep_their_order(unit):
    assert unit.function("mixed")(0.5, -3, 2**40, 0.25) == 0.5 - 3 + 2**40 + 0.25


@pytest.mark.parametrize("values", [(), (1, 2), (1.5,), ("1",), (None,)])
def test_wrong_arguments_are_refused_before_the_call(unit, values):
    with pytest.raises(TypeError):
        unit.function("i")(*values)


def test_a_function_without_values_gives_none(unit):
    assert unit.function("nothing")() is None
    with pytest.raises(TypeError):
        unit.function("nothing")(1)


HOST = """
(import "host" "plain" (func $plain))
(import "host" "address" (func $address (param i32)))
(import "host" "sum" (func $sum (param i32 i64 f32 f64) (result f64)))
(import "host" "wraps" (func $wraps (param i32) (result i32)))
(func (export "plain") (call $plain))
(func (export "address") (param i32) (call $address (local.get 0)))
(func (export "sum") (param i32 i64 f32 f64) (result f64)
  (call $sum (local.get 0) (local.get 1) (local.get 2) (local.get 3)))
(func (export "wraps") (param i32) (result i32) (call $wraps (local.get 0)))
"""


class Host:
    def __init__(self):
        self.heard = []
        rig = self.rig = Rig()
        host_function = rig.machine.host_function
        self.unit = rig.load(
            HOST,
            {
                ("host", "plain"): host_function(lambda: self.heard.append("plain")),
                ("host", "address"): host_function(self.heard.append, "I"),
                ("host", "sum"): host_function(self.sum, "iQfd", "d"),
                ("host", "wraps"): host_function(lambda value: value * 3, "i", "I"),
            },
        )

    def sum(self, *values):
        self.heard.append(values)
        return sum(values)


@pytest.fixture
def host():
    return Host()


def test_compiled_code_calls_python_functions(host):
    host.unit.function("plain")()
    host.unit.function("address")(-1)
    assert host.unit.function("sum")(-1, -1, 0.5, 0.25) == float(2**64 - 2) + 0.75
    assert host.heard == ["plain", 0xFFFF_FFFF, (-1, 2**64 - 1, 0.5, 0.25)]


@pytest.mark.parametrize(("value", "result"), [(5, 15), (-1, -3), (2**31 - 1, 2**31 - 3)])
def test_results_of_python_functions_wrap(host, value, result):
    assert host.unit.function("wraps")(value) == result


def test_a_wrong_result_is_a_type_error_at_the_caller(host):
    wrong = host.rig.machine.host_function(lambda: "text", "", "i")
    unit = host.rig.load(
        '(import "host" "f" (func $f (result i32)))(func (export "run") (result i32) (call $f))',
        {("host", "f"): wrong},
    )
    with pytest.raises(TypeError):
        unit.function("run")()


def test_calls_nest(host):
    """The slots of a function that is called again inside its own call are used twice."""
    machine = host.rig.machine

    def again(n):
        return unit.function("factorial")(n)

    unit = host.rig.load(
        '(import "host" "again" (func $again (param i32) (result i32)))'
        '(func (export "factorial") (param i32) (result i32)'
        "  (if (result i32) (i32.eqz (local.get 0)) (then (i32.const 1))"
        "    (else (i32.mul (local.get 0)"
        "      (call $again (i32.sub (local.get 0) (i32.const 1)))))))",
        {("host", "again"): machine.host_function(again, "i", "i")},
    )
    factorial = unit.function("factorial")
    assert [factorial(n) for n in (0, 1, 5, 10)] == [1, 1, 120, 3628800]


def test_machines_of_different_settings_have_functions_of_the_same_type():
    for fuel in (False, True):
        Rig(fuel=fuel).machine.host_function(lambda given: given, "d", "d")


def test_unknown_codes_are_refused(host):
    with pytest.raises(KeyError):
        host.rig.machine.host_function(print, "x")
    with pytest.raises((KeyError, MachineError)):
        host.unit.function("plain", "x")
