"""Switch: a jump table where its values lie close together, else a search for the range."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.machine.encoder import uleb
from plcsim.machine.opcodes import (
    BLOCK,
    BR,
    BR_IF,
    BR_TABLE,
    ELSE,
    I32,
    I32_EQ,
    I32_LE_U,
    I32_LT_S,
    I32_SUB,
    IF,
    LOCAL_GET,
    LOCAL_SET,
)
from plcsim.program.structured_text.codegen.body import BranchLabel
from plcsim.program.structured_text.codegen.branches import leave
from plcsim.program.structured_text.codegen.expressions import emit, i32_const

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text import ir
    from plcsim.program.structured_text.codegen.body import FunctionWriter

SHORT: Final = 3
"""Ranges that are compared one after another."""

MOST_ENTRIES: Final = 4096
"""Entries of a jump table."""

SPARSE: Final = 8
"""Entries of a jump table for each range, at most; above, a search takes less room."""

Range = tuple[int, int, int]
"""Lowest and highest value, and the depth of the block that the case follows."""


def switch(body: FunctionWriter, node: ir.Switch) -> None:
    """Append a Switch: blocks for all cases, one inside the other, and a branch to one of them."""
    end = BranchLabel(body.open(BLOCK))
    other = body.open(BLOCK)
    depths = [body.open(BLOCK) for _ in node.cases]
    ranges = sorted(
        (low, high, depth)
        for case, depth in zip(node.cases, reversed(depths), strict=True)
        for low, high in case.ranges
    )
    emit(body, node.selector)
    selector_line = body.line
    _choose(body, ranges, other)
    start = body.copies.fork()
    for case in node.cases:
        body.close()
        body.cases[len(body.code)] = selector_line
        body.mark(case.line)
        body.copies.known = None if start is None else start.copy()
        body.statements(body, case.body)
        leave(body, end, node)
    body.close()
    body.cases[len(body.code)] = selector_line
    body.copies.known = start
    body.statements(body, node.other)
    end.arrive(body.copies.known)
    body.close()
    body.copies.known = end.known


def _choose(body: FunctionWriter, ranges: Sequence[Range], other: int) -> None:
    """Append a branch to the block of the range that holds the value on the stack."""
    if _is_dense(ranges):
        _table(body, ranges, other)
        return
    value = uleb(body.scratch(I32))
    body.code += LOCAL_SET + value
    _search(body, value, ranges, other)
    body.branch(BR, other)


def _is_dense(ranges: Sequence[Range]) -> bool:
    if len(ranges) <= SHORT:
        return False
    entries = ranges[-1][1] - ranges[0][0] + 1
    return entries <= min(MOST_ENTRIES, SPARSE * len(ranges))


def _table(body: FunctionWriter, ranges: Sequence[Range], other: int) -> None:
    lowest, highest = ranges[0][0], ranges[-1][1]
    entries = [other] * (highest - lowest + 1)
    for low, high, depth in ranges:
        entries[low - lowest : high - lowest + 1] = [depth] * (high - low + 1)
    if lowest:
        body.code += i32_const(lowest) + I32_SUB
    body.code += BR_TABLE + uleb(len(entries))
    for depth in (*entries, other):
        body.code += uleb(body.depth - depth)


def _search(body: FunctionWriter, value: bytes, ranges: Sequence[Range], other: int) -> None:
    """Append comparisons that branch to the range of a value; no range falls through."""
    if len(ranges) <= SHORT:
        for one in ranges:
            _compare(body, value, one)
        return
    middle = len(ranges) // 2
    body.code += LOCAL_GET + value + i32_const(ranges[middle][0]) + I32_LT_S
    body.open(IF)
    _search(body, value, ranges[:middle], other)
    body.code += ELSE
    _search(body, value, ranges[middle:], other)
    body.close()


def _compare(body: FunctionWriter, value: bytes, one: Range) -> None:
    low, high, depth = one
    body.code += LOCAL_GET + value + i32_const(low)
    if low == high:
        body.code += I32_EQ
    else:  # one comparison: what is below the range becomes a large unsigned number
        body.code += I32_SUB + i32_const(high - low) + I32_LE_U
    body.branch(BR_IF, depth)
