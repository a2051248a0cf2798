"""Loops: what they keep in locals, where they test for their end, and that they can be ended.

A loop that begins with its exit test, as FOR and WHILE do, is turned: the test stands before the
loop once, and at its end, so a pass takes one branch. Every pass polls the budget; the smallest
loops poll it once in two passes, and have their body twice for that.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.core.memory import SYSTEM_AREA
from plcsim.core.system_area import BUDGET
from plcsim.machine.encoder import sleb, uleb
from plcsim.machine.opcodes import (
    BLOCK,
    BR,
    BR_IF,
    I32_CONST,
    I32_EQZ,
    I32_LOAD,
    I32_LT_S,
    LOCAL_SET,
    LOOP,
)
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.accesses import PARTS, loop_accesses
from plcsim.program.structured_text.codegen.body import NO_OFFSET, BranchLabel
from plcsim.program.structured_text.codegen.expressions import access, address, emit
from plcsim.program.structured_text.codegen.operators import LOAD

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.codegen.accesses import Accesses
    from plcsim.program.structured_text.codegen.body import FunctionWriter
    from plcsim.program.structured_text.codegen.places import ScalarPlace

CELL: Final = 8
"""Bytes of a cell of the system area."""

MOST_PRELOADED: Final = 16
"""Variables that a loop keeps in locals beside those that are there before it."""

MOST_TESTED: Final = 24
"""Nodes of an exit test that is written twice."""


MOST_DOUBLED: Final = 80
"""Nodes of the body of a loop that is written twice."""

_BUDGET: Final = SYSTEM_AREA + BUDGET * CELL + CELL // 2
"""Address of the upper half of the budget: negative where the budget is."""


_IS_SPENT: Final = I32_CONST + sleb(_BUDGET) + I32_LOAD + NO_OFFSET + I32_CONST + sleb(0) + I32_LT_S


def poll(body: FunctionWriter) -> None:
    """Append the end of the program where the watchdog asks for it (see `core.system_area`)."""
    if body.options.budget:
        start = len(body.code)
        body.code += _IS_SPENT
        body.trap_if("budget")
        body.polls[start] = len(body.code)


def loop(body: FunctionWriter, node: ir.Loop) -> None:
    """Append a loop."""
    if body.options.copies and id(node) not in body.accesses:
        body.accesses = loop_accesses(node, body.effects, this=body.this)
    held = body.copies.hold(_preload(body, node))
    exit_ = body.breaks[node.label] = BranchLabel(body.open(BLOCK))
    test = _exit_test(node)
    if test is None:
        _plain(body, node)
    else:
        _turned(body, node, test)
    body.close()
    body.copies.known = exit_.known
    body.copies.release(held)


def _preload(body: FunctionWriter, node: ir.Loop) -> Sequence[ScalarPlace]:
    """Load what the loop is to keep in locals; return all that it keeps."""
    known = body.copies.known
    accesses = body.accesses.get(id(node))
    if known is None or accesses is None:
        return ()
    for key in [key for key in known if accesses.changes(key)]:
        del known[key]
    for key in _wanted(accesses, known):
        _load_copy(body, key, accesses.loaded[key][0])
    return tuple(known)


def _wanted(accesses: Accesses, known: dict[ScalarPlace, int]) -> list[ScalarPlace]:
    """Return what the loop loads most, of what may be kept and is not in a local yet."""
    loaded = [key for key in accesses.loaded if key not in known and not accesses.changes(key)]
    loaded.sort(key=lambda key: -accesses.loaded[key][1])
    return loaded[:MOST_PRELOADED]


def _load_copy(body: FunctionWriter, key: ScalarPlace, place: ir.Place) -> None:
    local = body.copies.note(key)
    if local is not None:
        access(body, LOAD[key.width], address(body, place))
        body.code += LOCAL_SET + uleb(local)


def _exit_test(node: ir.Loop) -> ir.Arm | None:
    """Return the test that a loop begins with, if it may be written twice."""
    first = node.body[0] if node.body else None
    if type(first) is not ir.If or not _leaves(first, node.label):
        return None
    return first.arms[0] if _is_small(first.arms[0].condition) else None


def _leaves(node: ir.Statement, label: int) -> bool:
    """Tell whether a statement does nothing but leave a loop on a condition."""
    if type(node) is not ir.If or len(node.arms) != 1 or node.other or len(node.arms[0].body) != 1:
        return False
    leave = node.arms[0].body[0]
    return type(leave) is ir.Break and leave.label == label


def _is_small(condition: ir.Expression) -> bool:
    return _is_below(MOST_TESTED, [condition], ir.Call, ir.StatementExpression)


def _is_below(limit: int, parts: Sequence[ir.Expression | ir.Statement], *without: type) -> bool:
    """Tell whether parts have at most so many nodes, and none of some kinds."""
    left_over, count = [*parts], 0
    while left_over:
        node = left_over.pop()
        count += 1
        if count > limit or type(node) in without:
            return False
        left_over += PARTS[type(node)](node)
    return True


def _plain(body: FunctionWriter, node: ir.Loop) -> None:
    head = _open_head(body, node)
    body.continues[node.label] = head
    last = node.body[-1] if node.body else None
    at_end = last if type(last) is ir.If and _leaves(last, node.label) else None
    body.statements(body, node.body[:-1] if at_end else node.body)
    if at_end:
        _repeat_unless(body, node, at_end.arms[0], head)
    elif body.copies.known is not None:
        body.branch(BR, head.depth)
        body.copies.known = None
    body.close()


def _turned(body: FunctionWriter, node: ir.Loop, test: ir.Arm) -> None:
    _leave_if(body, node, test)
    head = _open_head(body, node)
    _pass(body, node)
    if body.reached and _is_below(MOST_DOUBLED, node.body, *_NOT_DOUBLED):
        _leave_if(body, node, test)
        _pass(body, node)
    _repeat_unless(body, node, test, head)
    body.close()


_NOT_DOUBLED: Final = (ir.Call, ir.StatementExpression, ir.Loop, ir.Block, ir.Switch)


def _leave_if(body: FunctionWriter, node: ir.Loop, test: ir.Arm) -> None:
    """Append a test that leaves the loop where it is true."""
    body.mark(test.line)
    emit(body, test.condition)
    exit_ = body.breaks[node.label]
    exit_.arrive(body.copies.fork())
    body.condition()
    body.branch(BR_IF, exit_.depth)


def _pass(body: FunctionWriter, node: ir.Loop) -> None:
    """Append what follows the test; Continue leads behind it."""
    bottom = body.continues[node.label] = BranchLabel(body.open(BLOCK))
    body.statements(body, node.body[1:])
    bottom.arrive(body.copies.known)
    body.close()
    body.copies.known = bottom.known


def _open_head(body: FunctionWriter, node: ir.Loop) -> BranchLabel:
    """Begin the part that is repeated, where only what the whole loop keeps is known."""
    known = body.copies.known
    if known is not None:
        body.copies.known = {key: known[key] for key in known if body.copies.is_held(key)}
    body.mark(node.line)
    head = BranchLabel(body.open(LOOP))
    poll(body)
    return head


def _repeat_unless(body: FunctionWriter, node: ir.Loop, test: ir.Arm, head: BranchLabel) -> None:
    """Append a test that leaves the loop at its end; it falls through to what follows."""
    if body.copies.known is None:
        return
    body.mark(test.line)
    emit(body, test.condition)
    body.code += I32_EQZ
    body.condition()
    body.branch(BR_IF, head.depth)
    body.breaks[node.label].arrive(body.copies.known)
    body.copies.known = None
