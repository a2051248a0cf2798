"""The host's part; for what C sees of it see the test of the same name of programs in C."""

import pytest

from plcsim.ansi_c.nonlocal_jumps import NonlocalJump, NonlocalJumps
from plcsim.core.memory import PAGE, Memory
from plcsim.machine import CodeCache, Machine, MachineFault
from plcsim.machine.encoder import ModuleWriter, Signature
from plcsim.machine.errors import Frame, note_frames
from plcsim.machine.opcodes import CALL, F32, F64, I32, I64, LOCAL_GET

TYPES = {"i": I32, "q": I64, "f": F32, "d": F64}


@pytest.fixture
def machine():
    return Machine(Memory(16 * PAGE), cache=CodeCache(None))


@pytest.fixture
def invoke(machine):
    """``invoke("invoke_vi", function, "i", "")``: what calls the function by its pointer."""

    def invoke(name, function, params, results):
        entry = machine.reserve_functions(1)
        machine.set_function(entry, machine.host_function(function, params, results))
        writer = ModuleWriter("caller")
        kinds = [bytes(TYPES[code] for code in codes) for codes in (f"i{params}", results)]
        imported = writer.import_function("env", name, Signature(*kinds))
        index = writer.function(Signature(*kinds), "call")
        values = b"".join(LOCAL_GET + bytes([number]) for number in range(len(params) + 1))
        writer.body(index, values + CALL + bytes([imported]))
        writer.export_function("call", index)
        code = machine.compile(writer.encode().wasm)
        extern = machine.shared(NonlocalJumps).extern(name)
        call = machine.instantiate(code, {("env", name): extern}).function("call")
        return lambda *values, pointer=entry: call(pointer, *values)

    return invoke


@pytest.mark.parametrize("name", ["invoke", "invoke_", "invoke_x", "invoke_iv", "invoker", "jump"])
def test_other_names_are_not_its_own(machine, name):
    assert machine.shared(NonlocalJumps).extern(name) is None


def test_values_of_every_type_pass(invoke):
    call = invoke("invoke_jidjf", lambda *given: sum(map(int, given)), "idqf", "q")
    assert call(1, 2.0, 1 << 40, 8.0) == 11 + (1 << 40)
    assert invoke("invoke_d", lambda: 0.5, "", "d")() == 0.5


def test_a_jump_ends_the_call_and_all_else_passes(invoke, machine):
    jumps = machine.shared(NonlocalJumps)
    raised = [NonlocalJump(), ZeroDivisionError("x"), KeyboardInterrupt()]
    note_frames(raised[0], (Frame("inner", "g", 0, 0),))

    def end(number):
        if number >= 0:
            raise raised[number]

    call = invoke("invoke_vi", end, "i", "")
    call(-1)
    call(0)
    with pytest.raises(ZeroDivisionError):
        call(1)
    with pytest.raises(KeyboardInterrupt):
        call(2)
    with pytest.raises(NonlocalJump) as again:
        jumps.jump(1)
    again.value.with_traceback(None)
    note_frames(again.value, (Frame("outer", "f", 0, 0),))
    assert [frame.module for frame in again.value.frames] == ["inner", "outer"]
    assert isinstance(again.value, MachineFault)
    with pytest.raises(NonlocalJump, match="its own words") as new:
        jumps.jump(0, "its own words")
    note_frames(new.value, (Frame("outer", "f", 0, 0),))
    assert [frame.module for frame in new.value.frames] == ["outer"]


@pytest.mark.parametrize("pointer", [0, 1 << 30])
def test_a_pointer_to_no_function_is_a_fault(invoke, pointer):
    call = invoke("invoke_v", lambda: None, "", "")
    call()
    with pytest.raises(MachineFault, match="function pointer"):
        call(pointer=pointer)
