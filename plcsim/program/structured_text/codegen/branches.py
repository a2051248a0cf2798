"""Statements that choose what follows: If, Block, Break and Continue."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.machine.opcodes import BLOCK, BR, BR_IF, ELSE, I32_EQZ, IF
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.body import BranchLabel
from plcsim.program.structured_text.codegen.copies import join
from plcsim.program.structured_text.codegen.expressions import emit

if TYPE_CHECKING:
    from plcsim.program.structured_text.codegen.body import FunctionWriter


def branch(body: FunctionWriter, node: ir.Break | ir.Continue, opcode: bytes = BR) -> None:
    """Append Break or Continue."""
    labels = body.breaks if type(node) is ir.Break else body.continues
    label = labels[node.label]
    label.arrive(body.copies.fork())
    if opcode is BR_IF:
        body.condition(node.line)
    body.branch(opcode, label.depth)
    if opcode is BR:
        body.copies.known = None


def block(body: FunctionWriter, node: ir.Block) -> None:
    """Append a block that Break can leave."""
    label = body.breaks[node.label] = BranchLabel(body.open(BLOCK))
    body.statements(body, node.body)
    label.arrive(body.copies.known)
    body.close()
    body.copies.known = label.known


def if_(body: FunctionWriter, node: ir.If) -> None:
    """Append an If, whose arms may be many: they are not nested."""
    if len(node.arms) > 1:
        _chain(body, node)
        return
    arm = node.arms[0]
    emit(body, arm.condition)
    leaves = _only_branch(arm) if not node.other else None
    if leaves is None:
        _two_ways(body, arm, node)
    else:
        branch(body, leaves, BR_IF)


def _only_branch(arm: ir.Arm) -> ir.Break | ir.Continue | None:
    first = arm.body[0] if len(arm.body) == 1 else None
    return first if isinstance(first, ir.Break | ir.Continue) else None


def _two_ways(body: FunctionWriter, arm: ir.Arm, node: ir.If) -> None:
    start = body.copies.fork()
    body.condition()
    body.open(IF)
    body.statements(body, arm.body)
    then, body.copies.known = body.copies.known, start
    if node.other:
        body.code += ELSE
        body.statements(body, node.other)
    body.close()
    body.copies.known = join(then, body.copies.known)


def _chain(body: FunctionWriter, node: ir.If) -> None:
    """Append IF ... ELSIF ...: a block for each arm, which a false condition leaves."""
    end = BranchLabel(body.open(BLOCK))
    for arm in node.arms:
        body.mark(arm.line)
        depth = body.open(BLOCK)
        emit(body, arm.condition)
        body.code += I32_EQZ
        body.condition()
        body.branch(BR_IF, depth)
        start = body.copies.fork()
        body.statements(body, arm.body)
        leave(body, end, node)
        body.close()
        body.copies.known = start
    body.statements(body, node.other)
    end.arrive(body.copies.known)
    body.close()
    body.copies.known = end.known


def leave(body: FunctionWriter, end: BranchLabel, node: ir.If | ir.Switch) -> None:
    """Append a branch behind a statement, if some path leads here.

    Behind the last one of a function that is a return: a jump less, and in large state machines
    the processor has jumps to predict as it has memory for.
    """
    if body.copies.known is None:
        return
    end.arrive(body.copies.known)
    if id(node) not in body.finals:
        body.branch(BR, end.depth)
        return
    body.leaves.add(len(body.code))
    body.return_()
