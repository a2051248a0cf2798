"""What a snapshot holds, what is copied, and that nothing is ever half of a cycle or older."""

import os

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from plcsim import Program
from plcsim.core.memory import FIRST
from plcsim.program.python.language import PythonCode
from plcsim.program.setup import ProgramSetup, TaskClassSetup
from plcsim.shared_image import ImageError, layout
from plcsim.shared_image.snapshot import (
    MOST_PIECES,
    NEAR,
    REFRESH_NS,
    WHOLE,
    Snapshots,
    Span,
    spans_of,
    whole_or,
)
from st_types import ARRAY, BYTE, UDINT, UINT, var

from .conftest import MS, Fast, Make, Slow


class Huge(Program):
    first = var(UINT, 1)
    waste = var(ARRAY(BYTE, (0, 100_000)))
    last = var(UINT, 2)

    def cyclic(self) -> None:
        self.first += 1
        self.last += 1


def huge(number: int = 1, cycle_ms: int = 1, name: str = "huge") -> TaskClassSetup:
    return TaskClassSetup(number, cycle_ms * MS, [ProgramSetup(name, PythonCode(Huge))])


def test_a_small_project_is_published_whole() -> None:
    areas = [(FIRST, WHOLE // 2), (FIRST + WHOLE, WHOLE // 2)]
    assert whole_or(areas, [(FIRST, 4)]) == areas
    assert whole_or([*areas, (0, 1)], [(FIRST, 4)]) == [(FIRST, 4)]


def test_of_a_large_project_the_exported_tags_are_published(make: Make) -> None:
    world = make(huge(), exports=("huge.last", "huge.first"))
    world.controller.run(cycles=2)
    assert (world.read("huge.first"), world.read("huge.last")) == (3, 4)
    with pytest.raises(ImageError, match="does not hold"):
        world.read("huge.waste[50000]")


def test_a_large_project_of_which_nothing_is_asked_for_has_an_empty_snapshot(make: Make) -> None:
    world = make(huge())
    world.controller.run(cycles=1)
    assert world.writer.directory.bank_size == 0
    assert world.reader.latest == 1


def test_tags_that_lie_near_each_other_are_one_piece(make: Make) -> None:
    world = make(huge())
    owners, find = world.controller.owners, world.controller.tags.find
    tags = [find("huge.last"), find("huge.first"), find("huge.waste[0]"), find("huge.waste[20]")]
    spans = spans_of([(tag.address, tag.data_type.size) for tag in tags], owners)
    address = find("huge.first").address
    assert [span[1:] for span in spans] == [(address, 23), (find("huge.last").address, 2)]


def test_pieces_may_overlap_and_repeat(make: Make) -> None:
    owners = make(huge()).controller.owners
    pieces = [(FIRST, 10), (FIRST + 4, 2), (FIRST + 8, 4), (FIRST, 10)]
    assert [span[1:] for span in spans_of(pieces, owners)] == [(FIRST, 12)]


def test_variables_of_two_classes_never_share_a_piece(make: Make) -> None:
    world = make(
        TaskClassSetup(1, MS, [ProgramSetup("fast", PythonCode(Fast))]),
        TaskClassSetup(2, 2 * MS, [ProgramSetup("slow", PythonCode(Slow))]),
    )
    find = world.controller.tags.find
    tags = [find("fast.name"), find("slow.level")]
    pieces = [(tag.address, tag.data_type.size) for tag in tags]
    assert len(spans_of(pieces, world.controller.owners)) == 2


def test_very_many_pieces_are_whole_words(make: Make) -> None:
    world = make(TaskClassSetup(1, MS, [ProgramSetup("field", PythonCode(Field))]))
    step = NEAR + 11
    pieces = [(FIRST + 1 + i * 7, 1) for i in range(3)]
    few = spans_of(pieces, world.controller.owners)
    assert [span[1:] for span in few] == [(FIRST + 1, 15)]
    owners = world.controller.owners
    far = [(FIRST + 1 + i * step, 3) for i in range(MOST_PIECES + 1)]
    many = spans_of(far, owners)
    assert len(many) == MOST_PIECES + 1
    assert all(span.address % 4 == 0 and span.size % 4 == 0 for span in many)


class Field(Program):
    """Large enough for more pieces than are copied one by one."""

    values = var(ARRAY(UDINT, (0, (MOST_PIECES + 100) * 80)))

    def cyclic(self) -> None:
        for number in range(0, (MOST_PIECES + 100) * 80, 80):
            self.values[number] += number


def test_very_many_scattered_tags_are_published_like_any_others(make: Make) -> None:
    paths = tuple(f"field.values[{n}]" for n in range(0, (MOST_PIECES + 100) * 80, 80))
    world = make(TaskClassSetup(1, MS, [ProgramSetup("field", PythonCode(Field))]), exports=paths)
    assert len(world.writer.directory.spans) == len(paths)
    assert world.writer.directory.bank_size == 4 * len(paths)
    for cycle in (1, 2, 3):
        world.controller.run(cycles=1)
        assert [world.read(path) for path in paths] == [
            cycle * number for number in range(0, len(paths) * 80, 80)
        ]


def test_what_nobody_is_known_to_have_changed_is_copied_now_and_then(make: Make) -> None:
    """A program of class 1 writes a variable of class 2 through its address."""
    world = make(huge(), huge(2, 1000, "idle"), exports=("huge.first", "huge.waste", "idle.first"))
    world.controller.run(cycles=1)
    address = world.address("idle.first")
    world.controller.memory.write(address, b"\x2a\0")
    world.controller.run(cycles=1)
    assert (world.read("huge.first"), world.read("idle.first")) == (3, 1)
    world.controller.run_for(REFRESH_NS)
    assert world.read("idle.first") == 42


def test_after_a_restart_everything_is_new(make: Make) -> None:
    world = make(huge(), huge(2, 1000, "idle"), exports=("huge.waste", "idle.first"))
    world.controller.run(cycles=1)
    world.controller.memory.write(world.address("idle.first"), b"\x2a\0")
    world.controller.shutdown()
    world.controller.boot()
    world.controller.run(cycles=1)
    assert world.read("idle.first") == 1


owner_bits = [2, 4, 8]
steps = st.lists(
    st.tuples(
        st.sampled_from(owner_bits),  # who publishes
        st.sets(st.sampled_from(owner_bits)),  # who is in the middle of a cycle
        st.integers(0, 2 * REFRESH_NS),  # since the last one
    ),
    max_size=30,
)


@settings(max_examples=200)
@given(steps, st.booleans())
def test_every_snapshot_shows_the_last_finished_cycle_of_every_class(
    steps: list[tuple[int, set[int], int]], many: bool
) -> None:
    """Each class writes a counter only when it publishes; half of a cycle has an odd one."""
    from plcsim.core.memory import Memory

    memory = Memory()
    memory.allocate(WHOLE + 4096)
    spans = [Span(bit, FIRST + 1000 * bit, 8) for bit in (1, *owner_bits)]
    if many:  # too much to be copied whole each time
        spans.append(Span(1 << 4, FIRST + 16_000, WHOLE))
    size = sum(span.size for span in spans)
    cells = memoryview(bytearray(layout.HEADER_SIZE)).cast("Q")
    banks = [memoryview(bytearray(size)) for _ in range(2)]
    snapshots = Snapshots(memory, spans, cells, banks)
    finished = dict.fromkeys(owner_bits, 0)
    now_ns = 0
    for current, middle, passed_ns in steps:
        held = middle - {current}
        now_ns += passed_ns
        finished[current] += 2
        for bit in owner_bits:
            value = finished[bit] + (1 if bit in held else 0)
            memory.write(FIRST + 1000 * bit, value.to_bytes(8, "little"))
        snapshots.publish(current, sum(held), now_ns)
        bank = banks[cells[layout.CELL_LATEST] & 1]
        for place, span in enumerate(spans[1:4], 1):
            shown = int.from_bytes(bank[8 * place : 8 * place + 8], "little")
            assert shown == finished[span.owner]
        for bit in held:  # the half cycle ends without a change
            memory.write(FIRST + 1000 * bit, finished[bit].to_bytes(8, "little"))


def test_numpy_is_loaded_only_for_very_many_pieces() -> None:
    import subprocess
    import sys

    code = "import sys, plcsim.shared_image; assert 'numpy' not in sys.modules"
    subprocess.run([sys.executable, "-c", code], check=True, env=os.environ)
