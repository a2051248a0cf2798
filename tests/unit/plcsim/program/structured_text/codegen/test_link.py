import struct

import pytest

from plcsim.ansi_c.c_library import CLibrary
from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.link import Linker
from plcsim.program.structured_text.codegen.runtime import MATHEMATICS

from .build import address, call, evaluate, function, load, module, op, store, unit

CALLED = ir.Import("block", "COUNTER", ir.Signature(("i32",), None))


@pytest.fixture
def memory():
    memory = Memory(4 * PAGE)
    memory.allocate(64)
    return memory


@pytest.fixture
def machine(memory):
    machine = Machine(memory, cache=CodeCache(None))
    yield machine
    machine.close()


def nothing(wanted):
    raise LookupError(wanted.name)


def counter_library():
    """A library with a block that counts its calls at the start of its data."""
    value = ir.Place(ir.Local("i32", 0), 0, 1)
    count = ir.Store(5, "w32", value, op("add", ir.Load("i32", "w32", value), 1))
    block = function("COUNTER", ("i32",), None, count, kind="block")
    return generate(ir.Module("library", [block], {}, (), ("COUNTER.st",)))


def user():
    body = evaluate(call("COUNTER", address(8)))
    return generate(module(unit(body), imports={"COUNTER": CALLED}))


def linked(linker, code, addresses, provide):
    return linker.link(code, linker.compiled(code, addresses), provide)


def word(memory, address):
    return struct.unpack("<I", memory.read(address, 4))[0]


def test_one_program_runs_with_several_sets_of_variables(memory, machine):
    code = generate(module(unit(store(0, op("add", load(0), 1)))))
    linker = Linker(machine)
    starts = [memory.allocate(64) for _ in range(2)]
    first, second = (linked(linker, code, {"program": start}, nothing) for start in starts)
    first.function("CYCLIC")()
    for _ in range(3):
        second.function("CYCLIC")()
    assert [word(memory, start) for start in starts] == [1, 3]


def test_modules_call_each_other(memory, machine):
    def provide(wanted):
        assert wanted == CALLED
        return linked(linker, counter_library(), {}, nothing).extern(wanted.name)

    linker = Linker(machine)
    start = memory.allocate(64)
    cyclic = linked(linker, user(), {"program": start}, provide).function("CYCLIC")
    cyclic()
    cyclic()
    assert word(memory, start + 8) == 2


def test_modules_call_blocks_of_other_languages(memory, machine):
    called = []
    linker = Linker(machine)
    start = memory.allocate(64)
    linked(
        linker, user(), {"program": start}, lambda wanted: machine.host_function(called.append, "I")
    ).function("CYCLIC")()
    assert called == [start + 8]


def test_what_nobody_provides_is_told_by_who_provides(machine):
    with pytest.raises(LookupError, match="COUNTER"):
        linked(Linker(machine), user(), {"program": 0x11_0000}, nothing)


def test_mathematics_is_there_by_itself(memory, machine):
    power = call("rt.pow", load(0, "f64"), load(8, "f64"), result="f64")
    start = memory.allocate(64)
    instance = linked(
        Linker(machine),
        generate(module(unit(store(16, power, "f64")))),
        {"program": start},
        nothing,
    )
    memory.write(start, struct.pack("<dd", 2.0, 10.0))
    instance.function("CYCLIC")()
    assert struct.unpack("<d", memory.read(start + 16, 8)) == (1024.0,)


def test_names_of_modules_are_unique(machine):
    linker = Linker(machine)
    code = counter_library()
    linked(linker, code, {}, nothing)
    linked(linker, code, {}, nothing)
    with pytest.raises(ValueError, match="two modules are called library"):
        linked(linker, counter_library(), {}, nothing)


def test_the_c_library_has_every_mathematical_function():
    library = Machine(Memory(32 * PAGE), cache=CodeCache(None)).shared(CLibrary)
    for name in MATHEMATICS:
        assert library.extern(name.removeprefix("rt.")) is not None, name
