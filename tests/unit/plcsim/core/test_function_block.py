import pytest

from plcsim.core.context import Context
from plcsim.core.function_block import FunctionBlock
from plcsim.core.memory import PAGE, Memory, adr
from st_types import ARRAY, BOOL, INT, UDINT, DeclarationError, Struct, var, var_input, var_output
from st_types.types.derived import DataBlockType
from st_types.types.views import type_of


class Adder(FunctionBlock):
    enable = var_input(BOOL)
    step = var_input(INT, 1)
    total = var_output(INT)
    released_ns = var(UDINT)

    def execute(self):
        if self.enable:
            self.total += self.step
            self.released_ns = self.context.release_ns


class Station(Struct):
    adder = var(Adder)
    adders = var(ARRAY(Adder, (1, 2)))


@pytest.fixture
def context():
    return Context(Memory(2 * PAGE), network=None)


def test_a_call_assigns_inputs_by_name_and_runs_once(context):
    adder = context.memory.new(Adder, context)
    adder(enable=True)
    adder(step=5)
    adder()
    assert adder.total == 1 + 5 + 5
    adder(enable=False)
    assert adder.total == 11


def test_an_unknown_input_is_refused_and_the_block_does_not_run(context):
    adder = context.memory.new(Adder, context)
    with pytest.raises(AttributeError, match="stepp"):
        adder(enable=True, stepp=5)
    assert adder.total == 0


def test_blocks_inside_a_variable_work_with_its_context(context):
    station = context.memory.new(Station, context)
    context.release_ns = 7
    station.adder(enable=True)
    station.adders[2](enable=True)
    assert (station.adder.released_ns, station.adders[2].released_ns) == (7, 7)
    assert station.adder.context is context


def test_all_that_a_block_remembers_lies_in_its_data_block(context):
    adder = context.memory.new(Adder, context)
    adder(enable=True, step=3)
    copy = context.memory.new(Adder, context)
    context.memory.write(adr(copy), bytes(adder))
    copy()
    assert copy.total == 6


def test_the_data_block_is_laid_out_as_the_c_struct():
    data_type = type_of(Adder)
    assert isinstance(data_type, DataBlockType)
    assert [data_type.find(n)[1] for n in ("step", "total", "released_ns", "enable")] == [
        0,
        2,
        4,
        8,
    ]


def test_a_block_outside_a_controller_says_so():
    with pytest.raises(RuntimeError, match=r"Adder runs only inside a controller\."):
        Adder(enable=True)()


def test_a_block_without_execute_says_so(context):
    class Lazy(FunctionBlock):
        enable = var_input(BOOL)

    with pytest.raises(NotImplementedError, match=r"Lazy has no execute method\."):
        context.memory.new(Lazy, context)()


def test_who_knows_libraries_runs_a_block_without_execute(context):
    class Lazy(FunctionBlock):
        enable = var_input(BOOL)

    ran = []
    context.run_block = ran.append
    block = context.memory.new(Lazy, context)
    block(enable=True)
    assert ran == [block]


@pytest.mark.parametrize("name", ["context", "execute"])
def test_a_member_cannot_have_the_name_of_a_method(name):
    with pytest.raises(DeclarationError, match=f"New.{name}: a method of .*FunctionBlock"):
        type(FunctionBlock)("New", (FunctionBlock,), {name: var(INT)})
