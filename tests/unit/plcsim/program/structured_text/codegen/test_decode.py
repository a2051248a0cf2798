import random

from plcsim.machine import opcodes as op
from plcsim.machine.encoder import f32, f64, memarg, sleb, uleb
from plcsim.program.structured_text.codegen.decode import FREE, instructions, number_at
from plcsim.program.structured_text.codegen.generate import generate

from .random_ir import Maker

SEQUENCE = [
    op.BLOCK + op.EMPTY,
    op.IF + bytes([op.I32]),
    op.I32_CONST + sleb(-100_000),
    op.ELSE,
    op.I64_CONST + sleb(1 << 60),
    op.F32_CONST + f32(1.5),
    op.F64_CONST + f64(-2.5),
    op.END,
    op.LOCAL_TEE + uleb(300),
    op.I32_LOAD8_U + memarg(70_000),
    op.I64_STORE32 + memarg(3, 2),
    op.CALL + uleb(1000),
    op.CALL_INDIRECT + uleb(200) + uleb(0),
    op.BR_TABLE + uleb(3) + uleb(0) + uleb(200) + uleb(1) + uleb(2),
    op.BR_IF + uleb(130),
    op.GLOBAL_SET + uleb(128),
    op.I32_EXTEND8_S,
    op.SELECT,
    op.END,
]


def test_instructions_end_where_the_next_begins():
    code = b"".join(SEQUENCE)
    found = [code[one.start : one.end] for one in instructions(code)]
    assert found == SEQUENCE


def test_random_functions_are_read_to_their_end():
    """Every function ends with an END that belongs to it, so that blocks are balanced."""
    for seed in range(20):
        code = generate(Maker(random.Random(seed)).module())
        for function in code.lines.functions:
            depth = 0
            for one in instructions(code.wasm[function.start : function.end]):
                depth += one.opcode in (op.BLOCK[0], op.LOOP[0], op.IF[0])
                depth -= one.opcode == op.END[0]
            assert depth == -1


def test_numbers_are_unsigned():
    assert number_at(b"\x00" + uleb(624485), 1) == 624485


def test_what_is_free_is_control_and_drop():
    assert len(FREE) == 8
    assert op.BR[0] not in FREE
    assert op.DROP[0] in FREE
