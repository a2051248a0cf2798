"""Expected values are those of gcc 12 -m32 -O0 -msse2 -mfpmath=sse."""

import pytest

from plcsim.ansi_c.conversions import as_gcc_converts, may_convert
from plcsim.ansi_c.module import CModule
from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine
from plcsim.machine.shared_module import read_shared

NUMBERS = ["3.99e9", "-3.99e9", "1e20", "2147483648.0", "65535.75", "-1.5", "70000.0", "-0.0 / 0"]
EXPECTED = {
    "signed char": [0, 0, 0, 0, -1, -1, 112, 0],
    "short": [0, 0, 0, 0, -1, -1, 4464, 0],
    "int": [*[-(1 << 31)] * 4, 65535, -1, 70000, -(1 << 31)],
    "unsigned char": [0, 0, 0, 0, 255, 255, 112, 0],
    "unsigned short": [0, 0, 0, 0, 65535, 65535, 4464, 0],
    "unsigned": [3990000000, 1 << 31, 0, 1 << 31, 65535, 2**32 - 1, 70000, 1 << 31],
    "long long": [3990000000, -3990000000, -(1 << 63), 1 << 31, 65535, -1, 70000, -(1 << 63)],
    "unsigned long long": [
        *(3990000000, 2**64 - 3990000000, 0, 1 << 31, 65535, 2**64 - 1, 70000, 1 << 63)
    ],
}
TEXT = """
static const double numbers[] = {%s};
volatile float single;
volatile double wide;
long long convert(int n)
{
	%s whole;
	wide = numbers[n];
	if (n == 0 || n == 1) return (whole = wide);
	single = numbers[n];
	whole = single;
	return whole == (%s)wide ? whole : -99;
}
"""


class Alone:
    """What a module without needs finds."""

    def variable(self, _name):
        return None

    def function(self, _name, _wanted=None):
        return None


@pytest.fixture
def loaded(built, each_toolchain):
    """``loaded(text)``: a module of C by each compiler."""

    def loaded(text):
        machine = Machine(Memory(16 * PAGE), cache=CodeCache(None))
        wasm = built(text, with_=each_toolchain).wasm
        module = CModule("unit", read_shared(wasm), machine, Alone()).link()
        module.reset()
        return module

    return loaded


@pytest.mark.parametrize("kind", EXPECTED)
def test_what_does_not_fit_becomes_what_the_controller_makes_of_it(loaded, kind):
    convert = loaded(TEXT % (", ".join(NUMBERS), kind, kind)).function("convert", "i", "q")
    signed = [x - (1 << 64) if x >= 1 << 63 else x for x in EXPECTED[kind]]
    assert [convert(n) for n in range(len(NUMBERS))] == signed


def test_they_are_the_same_in_loops_and_constants_saturate(loaded):
    text = """
    static double list[] = {70000.0, -1.5, 3.5};
    int sum(int n) { int s = 0; for (int i = 0; i < n; i++) s += (short)list[i]; return s; }
    int constant(void) { return (int)3.99e9f - (short)-1e9; }
    """
    module = loaded(text)
    assert module.function("sum", "i", "i")(3) == 4464 - 1 + 3
    assert module.function("constant", "", "i")() == -(1 << 31) + 32767


def test_what_converts_nothing_is_compiled_as_it_was(each_toolchain, built):
    real = built("double f(float x) { return x * 2147483648.5; }", with_=each_toolchain).wasm
    assert not may_convert(real)
    assert may_convert(built("int f(float x) { return x; }", with_=each_toolchain).wasm)
    text = "define i32 @f() {\n  %1 = call i32 @llvm.fptosi.sat.i32.f32(float 1.0)\n}\n"
    assert as_gcc_converts(text) == text
