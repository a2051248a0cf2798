import pytest

from plcsim.ansi_c.module import CModule
from plcsim.core.errors import ConfigurationError
from plcsim.core.memory import FIRST, PAGE, Memory
from plcsim.machine import CodeCache, Machine, MachineFault
from plcsim.machine.shared_module import read_shared

TEXT = """
#include <bur/plctypes.h>
_LOCAL UDINT declared = 11;
_LOCAL UDINT undeclared = 22;
static int list[3] = {1, 2, 3};
int *pointer = &list[1];
extern UDINT outside;
int twice(int a);
static int thrice(int a) { return a * 3; }
int half(int a) { return a / 2; }
int (*functions[])(int) = {twice, thrice, half};

UDINT sum(void) { return declared + undeclared + outside + *pointer; }
int call(int which, int a) { return functions[which](a); }
void spoil(void) { list[1] = 99; pointer = 0; undeclared = 0; functions[0] = 0; }
UDINT address(void) { return (UDINT)"127.0.0.1"; }

__attribute__((noinline)) int
divide(int a)
{
  return 100 / a;
}
int through(int a) { return divide(a) + 1; }
int recurse(int a)
{
  volatile char space[4096];
  space[a & 1] = a;
  return recurse(a + 1) + space[0];
}
"""


class World:
    """Surroundings with two variables and one function in Python."""

    def __init__(self):
        self.memory = Memory(16 * PAGE)
        self.machine = Machine(self.memory, cache=CodeCache(None))
        first = self.memory.allocate(8)
        self.memory.write(first, (100).to_bytes(4, "little") + (1000).to_bytes(4, "little"))
        self.addresses = {"declared": first, "outside": first + 4}
        self.functions = {"twice": self.machine.host_function(lambda a: 2 * a, "i", "i")}

    def variable(self, name):
        return self.addresses.get(name)

    def function(self, name, _wanted=None):
        return self.functions.get(name)


@pytest.fixture
def world():
    return World()


@pytest.fixture
def load(world, built):
    """``load(text)``: a module in the world, its data initialised."""

    def load(text=TEXT, name="conveyor"):
        module = CModule(name, read_shared(built(text).wasm), world.machine, world).link()
        module.reset()
        return module

    return load


def test_variables_are_those_outside_or_its_own(load, world):
    module = load()
    assert module.function("sum")() == 100 + 22 + 1000 + 2
    world.memory.write(world.addresses["declared"], b"\1\0\0\0")
    assert module.function("sum")() == 1 + 22 + 1000 + 2
    own = module.address_of("undeclared")
    assert world.memory.read(own, 4) == b"\x16\0\0\0"
    assert module.address_of("outside") is None


def test_pointers_to_functions_of_all_kinds_are_called(load):
    call = load().function("call")
    assert [call(n, 10) for n in range(3)] == [20, 30, 5]


def test_two_modules_of_one_source_have_data_of_their_own(load):
    one, two = load(name="one"), load(name="two")
    one.function("spoil")()
    assert two.function("sum")() == 1124
    assert [two.function("call")(n, 10) for n in range(3)] == [20, 30, 5]
    with pytest.raises(MachineFault, match="function pointer that is nil"):
        one.function("call")(0, 10)


def test_a_reset_gives_all_initial_values_again(load):
    module = load()
    module.function("spoil")()
    with pytest.raises(MachineFault):
        module.function("sum")()
    module.reset()
    assert module.function("sum")() == 1124
    assert module.function("call")(0, 10) == 20


def test_literals_have_addresses_that_python_reads(load, world):
    address = load().function("address", results="I")()
    assert address >= FIRST
    assert world.memory.string(address, 100) == b"127.0.0.1"


def test_a_fault_leads_to_its_line(load):
    module = load()
    with pytest.raises(MachineFault, match="division by zero") as caught:
        module.function("through")(0)
    lines = [module.location(frame).rpartition(":")[2] for frame in caught.value.frames]
    text = TEXT.splitlines()
    assert text[int(lines[0]) - 1] == "  return 100 / a;"
    assert "through" in text[int(lines[-1]) - 1]


def test_a_stack_that_is_eaten_is_a_fault_and_the_next_call_runs(load, world):
    world.memory.open_stack(4 * PAGE)
    module = load()
    for _ in range(3):
        with pytest.raises(MachineFault, match="stack overflow"):
            module.function("recurse")(0)
        assert module.function("divide")(5) == 20


def test_everything_that_is_missing_is_told(load):
    text = "extern int a, b; int f(void); int g(void) { return a + b + f(); }"
    with pytest.raises(ConfigurationError) as caught:
        load(text)
    assert caught.value.findings == (
        "conveyor: uses variable a, which is nowhere",
        "conveyor: uses variable b, which is nowhere",
    )
    with pytest.raises(ConfigurationError, match="conveyor: uses function f, which is nowhere"):
        load("int f(void); int g(void) { return f(); }")


def test_static_construction_of_cpp_runs_at_each_reset(world, built):
    text = """
    static int made;
    struct Part { int number; Part() : number(++made) {} };
    static Part first, second;
    extern "C" int numbers(void) { return made * 100 + first.number * 10 + second.number; }
    extern "C" void spoil(void) { made = 50; first.number = 0; }
    """
    module = CModule("p", read_shared(built(text, "main.cpp").wasm), world.machine, world).link()
    for _ in range(2):
        module.reset()
        assert module.function("numbers")() == 212
        module.function("spoil")()
