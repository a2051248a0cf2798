import pytest

from plcsim.machine import opcodes as op
from plcsim.program.structured_text.codegen.accesses import Effects
from plcsim.program.structured_text.codegen.body import FunctionWriter, GenerationContext
from plcsim.program.structured_text.codegen.decode import instructions
from plcsim.program.structured_text.codegen.flow import Flow
from plcsim.program.structured_text.codegen.options import CodegenOptions
from plcsim.program.structured_text.codegen.statements import statements

from .build import function, module

ENTRY = 1
CONST = op.I32_CONST + b"\0"
BLOCK, LOOP, IF = (code + op.EMPTY for code in (op.BLOCK, op.LOOP, op.IF))


def br(depth, code=op.BR):
    return code + bytes([depth])


@pytest.fixture
def flow_of():
    """``flow_of((3, code), (4, code), ...)``: the flow of a function, by line."""

    def flow_of(*parts):
        made = function("F", (), None)
        context = GenerationContext({}, {}, Effects(module(made)))
        body = FunctionWriter(made, context, CodegenOptions(), statements)
        for line, code in parts:
            body.mark(line)
            body.code += code
        return Flow(list(instructions(body.code)), body)

    return flow_of


def test_a_branch_leads_behind_the_end_of_its_block(flow_of):
    flow = flow_of(
        (2, BLOCK + BLOCK + CONST + br(1, op.BR_IF)), (3, CONST + op.END + op.END), (4, CONST)
    )
    assert (flow.after(3), flow.target(3)) == (3, 4)


def test_a_branch_leads_to_the_head_of_its_loop(flow_of):
    flow = flow_of((2, LOOP), (3, CONST), (4, CONST + br(0, op.BR_IF) + op.END), (5, CONST))
    assert (flow.after(3), flow.target(3)) == (5, 3)


def test_what_follows_then_is_behind_else(flow_of):
    flow = flow_of(
        (2, CONST + IF),
        (3, CONST + op.DROP + op.ELSE),
        (4, CONST),
        (5, op.DROP + op.END),
        (6, CONST),
    )
    assert flow.after(1) == 3
    assert flow.after(3) == 6
    assert flow.after(4) == 4


def test_a_branch_that_ends_an_arm_is_followed_and_an_exit_is_a_line(flow_of):
    arm = flow_of((2, BLOCK + CONST + IF + br(1) + op.END), (3, CONST + op.END), (4, CONST))
    assert arm.after(2) == 4
    exit_ = flow_of((2, BLOCK + CONST + IF), (3, br(1)), (2, op.END + CONST + op.END), (4, CONST))
    assert exit_.after(2) == 3


def test_a_branch_out_of_everything_leaves_the_function(flow_of):
    flow = flow_of((2, BLOCK + CONST + br(1, op.BR_IF) + op.END), (3, CONST))
    assert flow.target(2) == -ENTRY


def test_where_no_line_follows_the_function_is_left(flow_of):
    assert flow_of((2, CONST + IF + op.END)).after(2) == -ENTRY
    assert flow_of((2, CONST + IF + op.END + op.UNREACHABLE)).after(2) == -ENTRY
    assert flow_of((2, CONST + IF + op.END), (3, op.RETURN)).after(2) == 3
    assert flow_of((2, LOOP + br(0) + op.END)).after(0) == -ENTRY


def test_instructions_have_the_line_of_the_last_mark(flow_of):
    flow = flow_of((2, CONST + op.DROP), (9, CONST))
    assert [flow.line_at(index) for index in range(3)] == [2, 2, 9]
