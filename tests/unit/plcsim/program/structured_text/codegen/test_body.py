import pytest

from plcsim.machine.opcodes import BLOCK, BR, F64, I32, LOOP
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.accesses import Effects
from plcsim.program.structured_text.codegen.body import (
    HOLE,
    BranchLabel,
    FunctionWriter,
    GenerationContext,
)
from plcsim.program.structured_text.codegen.options import CodegenOptions
from plcsim.program.structured_text.codegen.statements import statements

from .build import PROGRAM, function, module, place

OTHER = ir.Segment("other")


@pytest.fixture
def body_of():
    def make(kind="function", **options):
        made = function("F", ("i32", "f64"), None, kind=kind, locals_=("i64",))
        context = GenerationContext({}, {id(PROGRAM): 0, id(OTHER): 1}, Effects(module(made)))
        return FunctionWriter(made, context, CodegenOptions(**options), statements)

    return make


def test_locals_come_after_the_parameters(body_of):
    body = body_of()
    assert body.local(I32) == 3
    assert body.scratch(F64) == body.scratch(F64) == 4
    assert body.scratch(F64, 1) == 5
    assert body.locals == bytes([0x7E, I32, F64, F64])


def test_only_a_change_of_line_is_marked(body_of):
    body = body_of()
    for line in (3, 3, 4):
        body.mark(line)
        body.code += b"\x01"
    assert body.lines == [(0, 1), (0, 3), (2, 4)]


def test_branches_count_the_blocks_between(body_of):
    body = body_of()
    outer = body.open(BLOCK)
    inner = body.open(LOOP)
    body.branch(BR, outer)
    body.branch(BR, inner)
    body.close()
    body.branch(BR, outer)
    body.close()
    assert bytes(body.code) == bytes.fromhex("0240 0340 0c01 0c00 0b 0c00 0b")
    assert body.depth == 0


def test_holes_know_their_segment(body_of):
    body = body_of()
    body.hole(OTHER, 8)
    body.hole(PROGRAM, -4)
    assert body.code == HOLE * 2
    assert body.holes == [0, 1, 8, 5, 0, -4]


def test_both_places_at_which_a_trap_may_be_reported_are_noted(body_of):
    body = body_of()
    body.trap_if("index")
    assert bytes(body.code) == bytes.fromhex("0440 00 0b")
    assert body.traps == [(0, "index"), (2, "index")]


def test_copies_are_kept_of_fixed_places_if_at_all(body_of):
    member = ir.Place(ir.Local("i32", 0), 4, 3)
    assert body_of().key_of(place(0), "w32") is not None
    assert body_of().key_of(member, "w32") is None
    assert body_of("block").key_of(member, "w32") is not None
    assert body_of("block", copies=False).key_of(member, "w32") is None


def test_paths_meet_at_a_label():
    label = BranchLabel(3)
    assert label.known is None
    label.arrive({1: 10, 2: 20})
    label.arrive(None)
    label.arrive({2: 20})
    assert label.known == {2: 20}
