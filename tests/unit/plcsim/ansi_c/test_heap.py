import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule

from plcsim.ansi_c.heap import ProgramHeap, is_of_heap
from plcsim.machine import MachineFault
from tests.unit.plcsim.ansi_c.c_library_world import World

WORLD = World()
SIZE = 8000
HEAP = ProgramHeap("test", WORLD.machine, WORLD.library, SIZE)


def function(name, params, results="I"):
    return HEAP._instance.function(name, params, results)


malloc, calloc = function("malloc", "I"), function("calloc", "II")
realloc, free = function("realloc", "II"), function("free", "I", "")


@pytest.fixture(autouse=True)
def fresh():
    HEAP.reset()


class HeapMachine(RuleBasedStateMachine):
    """Areas keep their contents, never overlap, and are counted."""

    def __init__(self):
        super().__init__()
        HEAP.reset()
        self.areas = {}
        self.number = 0

    def fill(self, address, size):
        self.number += 1
        content = bytes((self.number + i) % 256 for i in range(size))
        WORLD.memory.write(address, content)
        self.areas[address] = content

    @rule(size=st.integers(0, 900))
    def allocate(self, size):
        address = malloc(size)
        assert address % 8 == 0
        if address:
            self.fill(address, size)
        else:
            assert sum(map(len, self.areas.values())) + size > SIZE / 4

    @rule(pick=st.randoms(use_true_random=False), size=st.integers(1, 900))
    def resize(self, pick, size):
        if self.areas:
            address = pick.choice(sorted(self.areas))
            moved = realloc(address, size)
            if moved:
                before = self.areas.pop(address)
                kept = min(size, len(before))
                assert WORLD.memory.read(moved, kept) == before[:kept]
                self.fill(moved, size)

    @rule(pick=st.randoms(use_true_random=False))
    def release(self, pick):
        if self.areas:
            address = pick.choice(sorted(self.areas))
            free(address)
            del self.areas[address]

    @invariant()
    def contents_are_kept(self):
        for address, content in self.areas.items():
            assert WORLD.memory.read(address, len(content)) == content

    @invariant()
    def use_is_counted(self):
        use = HEAP.use()
        assert use.areas == len(self.areas)
        assert sum(map(len, self.areas.values())) <= use.used <= use.most <= SIZE

    def teardown(self):
        for address in self.areas:
            free(address)
        assert HEAP.use().used == 0
        if HEAP.use().most:
            assert malloc(SIZE - 100), "all of it is one area again"


HeapMachine.TestCase.settings = settings(max_examples=25, stateful_step_count=40, deadline=None)
TestHeap = HeapMachine.TestCase


def test_what_does_not_fit_is_refused_and_counted():
    assert malloc(SIZE) == malloc(0xFFFF_FFFF) == calloc(0x1_0000, 0x1_0001) == 0
    assert HEAP.use().refused == 3


def test_calloc_clears():
    address = malloc(64)
    WORLD.memory.write(address, b"\x55" * 64)
    free(address)
    assert WORLD.memory.read(calloc(8, 8), 64) == bytes(64)


@pytest.mark.parametrize(
    ("wrong", "reason"),
    [
        (lambda a: (free(a), free(a)), "freed before"),
        (lambda a: free(a + 8), "is freed|is no area|is damaged"),
        (lambda a: free(0x20_0000), "is no area"),
        (lambda a: (WORLD.memory.write(a + 16, b"\x55" * 16), free(a)), "damaged"),
    ],
)
def test_what_is_done_wrong_with_it_is_a_fault(wrong, reason):
    address = malloc(16)
    malloc(16)
    with pytest.raises(MachineFault, match=reason):
        wrong(address)


def test_a_reset_frees_everything():
    malloc(5000)
    HEAP.reset()
    assert HEAP.use() == (SIZE, 0, 0, 0, 0)
    assert malloc(5000)


def test_copies_of_texts_are_areas():
    text = WORLD.text(WORLD.memory.allocate(40), b"abcdef")
    copy = function("strdup", "I")(text)
    assert WORLD.read_text(copy) == b"abcdef"
    assert WORLD.read_text(function("strndup", "II")(text, 3)) == b"abc"
    assert HEAP.use().areas == 2


def test_new_without_room_is_a_fault():
    assert function("_Znwm", "I")(100)
    with pytest.raises(MachineFault, match="no room"):
        function("_Znam", "I")(SIZE)


def test_functions_of_the_heap_are_known_by_name():
    assert is_of_heap("malloc")
    assert not is_of_heap("plc_malloc")
