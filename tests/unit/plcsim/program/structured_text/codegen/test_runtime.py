import pytest

from plcsim.core.memory import FIRST
from plcsim.machine import FaultKind, MachineFault
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.runtime import MATHEMATICS, SIGNATURES, helper

from .build import call, function, load, module
from .compiled import END


@pytest.fixture
def runtime(compiled):
    """All helpers that programs call, with addresses from here."""
    functions = []
    for name in SIGNATURES.keys() & ir.RUNTIME.keys():
        signature = SIGNATURES[name]
        given = [ir.Local(kind, n) for n, kind in enumerate(signature.parameters)]
        called = call(name, *given, result=signature.result)
        body = ir.Return(1, called) if signature.result else ir.Evaluate(1, called)
        functions.append(function(name[3:], signature.parameters, signature.result, body))
    return compiled(module(*functions))


def assigned(text, limit):
    return text.split(b"\0")[0][: max(limit, 0)] + b"\0"


@pytest.mark.parametrize("shift", range(9))
def test_string_assignment_of_every_length_and_limit(runtime, shift):
    for length in range(20):
        text = bytes(range(65, 65 + length)) + b"\0after"
        for limit in (-1, 0, 1, 3, 7, 8, 9, 15, 16, 17, 80):
            runtime.write(FIRST + shift, text)
            runtime.write(FIRST + 100, b"." * 40)
            runtime.run("string_assign", FIRST + 100, FIRST + shift, limit)
            expected = assigned(text, limit).ljust(40, b".")
            assert runtime.read(FIRST + 100, 40) == expected


@pytest.mark.parametrize("distance", [-9, -8, -1, 0, 1, 3, 8, 9])
def test_a_string_assigned_to_a_part_of_itself(runtime, distance):
    """Characters go one by one, from the front."""
    memory = bytearray(b"." * 30 + b"abcdefghijkl\0" + b"." * 40)
    runtime.write(FIRST, bytes(memory))
    runtime.run("string_assign", FIRST + 30 + distance, FIRST + 30, 20)
    target, source, left = 30 + distance, 30, 20
    while left and memory[source]:
        memory[target] = memory[source]
        target, source, left = target + 1, source + 1, left - 1
    memory[target] = 0
    assert runtime.read(FIRST, len(memory)) == bytes(memory)


@pytest.mark.parametrize("length", range(1, 19))
def test_strings_at_the_end_of_memory(runtime, length):
    text = bytes(range(65, 65 + length - 1)) + b"\0"
    runtime.write(END - length, text)
    runtime.run("string_assign", FIRST, END - length, 80)
    assert runtime.read(FIRST, length) == text
    assert runtime.run("string_compare", END - length, FIRST) == 0
    assert runtime.run("string_compare", FIRST, END - length) == 0
    runtime.run("string_assign", END - length, FIRST, length - 1)
    assert runtime.read(END - length, length) == text


def test_a_string_without_end_is_a_fault(runtime):
    runtime.write(END - 20, b"x" * 20)
    for name, more in (("string_assign", [100]), ("string_compare", [])):
        runtime.write(FIRST, b"x" * 200)
        with pytest.raises(MachineFault) as caught:
            runtime.run(name, FIRST, END - 20, *more)
        assert caught.value.kind is FaultKind.PAGE_FAULT
        assert caught.value.address == END


def difference(left, right):
    pairs = zip(left + b"\0", right + b"\0", strict=False)
    return next((a - b for a, b in pairs if a != b), 0)


@pytest.mark.parametrize("shift", [0, 1, 5])
def test_string_comparison(runtime, shift):
    texts = [b"", b"a", b"b", b"\x80", b"ab", b"abcdefg", b"abcdefgh", b"abcdefghi", b"abcdefgz"]
    texts += [
        b"abcdefgh\xff",
        b"abcdefghij" * 3,
        b"abcdefghij" * 2 + b"abcdefghiJ",
        b"\x01\xff\x7f",
    ]
    for left in texts:
        for right in texts:
            runtime.write(FIRST, left + b"\0L")
            runtime.write(FIRST + 100 + shift, right + b"\0R")
            found = runtime.run("string_compare", FIRST, FIRST + 100 + shift)
            assert found == difference(left, right), (left, right)


def wide(text):
    return b"".join(one.to_bytes(2, "little") for one in text)


WIDE = [(), (1,), (0x100,), (0x8000, 1), (0x8000, 2), (65, 66, 67), (65, 66)]


@pytest.mark.parametrize("left", WIDE)
@pytest.mark.parametrize("right", WIDE)
def test_wide_strings(runtime, left, right):
    runtime.write(FIRST, wide((*left, 0, 5)))
    runtime.write(FIRST + 100, wide((*right, 0, 6)))
    found = runtime.run("wstring_compare", FIRST, FIRST + 100)
    assert (found > 0) - (found < 0) == ((*left, 0) > (*right, 0)) - ((*left, 0) < (*right, 0))
    for limit in (0, 1, 2, 9):
        runtime.write(FIRST + 200, b"." * 12)
        runtime.run("wstring_assign", FIRST + 200, FIRST, limit)
        assert runtime.read(FIRST + 200, 12) == wide((*left[:limit], 0)).ljust(12, b".")


def test_helpers_are_those_that_the_representation_names():
    assert {*SIGNATURES, *MATHEMATICS} - {"rt.copy", "rt.fill"} == set(ir.RUNTIME)
    for name in SIGNATURES:
        assert helper(name).parameters == SIGNATURES[name].parameters
    with pytest.raises(KeyError):
        helper("rt.nothing")


@pytest.mark.parametrize("name", MATHEMATICS)
def test_mathematics_is_called_by_name(compiled, name):
    given = [load(8 * n, "f64") for n in range(len(ir.RUNTIME[name].parameters))]
    machine = compiled(
        module(function("F", (), "f64", ir.Return(1, call(name, *given, result="f64"))))
    )
    assert machine.run("F") == 1.0
