"""Lowering of statements."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.kinds import UDINT, VOID, common_number, is_unsigned
from plcsim.program.structured_text.lower import conversions
from plcsim.program.structured_text.lower.conversions import common_type, to_type
from plcsim.program.structured_text.lower.functions import FunctionLowering
from plcsim.program.structured_text.lower.memory import is_scalar, width_of
from plcsim.program.structured_text.lower.nature import is_pure, is_unsigned_in_c
from plcsim.program.structured_text.lower.values import literal_data
from st_types.types.derived import StringType, WStringType

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.typed import Statement, Value
    from plcsim.program.structured_text.lower.context import FunctionContext

_I32_BITS = 1 << 32
_MOST = (1 << 31) - 1


class StatementLowering(FunctionLowering):
    """Lowers the statements of one function.

    Args:
        function: that they stand in.
        result: gives the value that the function returns, None if there is none.
    """

    def __init__(
        self, function: FunctionContext, result: Callable[[], ir.Expression | None]
    ) -> None:
        super().__init__(function)
        self._result = result
        self._loops: list[tuple[int, int]] = []
        self._continued: set[int] = set()
        self._jumps: dict[str, tuple[int, int, int]] = {}

    def statements(self, nodes: Sequence[Statement]) -> list[ir.Statement]:
        """Return the lowered statements."""
        if any(type(node) is typed.Label for node in nodes):
            return self._with_labels(nodes)
        found: list[ir.Statement] = []
        for node in nodes:
            self.line = node.line
            _RULES[type(node)](self, node, found)
        return found

    def _with_labels(self, nodes: Sequence[Statement]) -> list[ir.Statement]:
        """Lower a list with labels: a loop that goes on at the part that a number tells.

        ``Loop { Block { Block { Switch(part) } part 0 } part 1; Break }``
        """
        part, loop = self.function.local("i32"), self.function.label()
        line = nodes[0].line
        labels = [node.label for node in nodes if isinstance(node, typed.Label)]
        outer = dict(self._jumps)
        self._jumps |= {label: (part, number, loop) for number, label in enumerate(labels, 1)}
        places = [index for index, node in enumerate(nodes) if isinstance(node, typed.Label)]
        starts, ends = [0, *(place + 1 for place in places)], [*places, len(nodes)]
        parts = [self.statements(nodes[a:b]) for a, b in zip(starts, ends, strict=True)]
        self._jumps = outer
        blocks = [self.function.label() for _ in parts]
        cases = [
            ir.Case(line, [(number, number)], [ir.Break(line, block)])
            for number, block in enumerate(blocks)
        ]
        found: list[ir.Statement] = [ir.Switch(line, ir.Local("i32", part), cases)]
        for block, statements in zip(blocks, parts, strict=True):
            found = [ir.Block(line, block, found), *statements]
        start = ir.SetLocal(line, part, ir.Const("i32", 0))
        return [start, ir.Loop(line, loop, [*found, ir.Break(line, loop)])]

    def _jump(self, node: typed.Jump, into: list[ir.Statement]) -> None:
        part, number, loop = self._jumps[node.label]
        into.append(ir.SetLocal(node.line, part, ir.Const("i32", number)))
        into.append(ir.Continue(node.line, loop))

    # Assignments

    def _assign(self, node: typed.Assign, into: list[ir.Statement]) -> None:
        target, value, line = node.target, node.value, node.line
        data_type = target.type
        if is_scalar(data_type):
            into.append(self._scalar_assignment(line, target, value))
        elif isinstance(data_type, StringType | WStringType):
            into.append(self._string_assignment(line, target, value, data_type))
        else:
            size = ir.Const("i32", data_type.size)
            into.append(ir.CopyBytes(line, self.address(target), self.address(value), size))

    def _chain(self, node: typed.Chain, into: list[ir.Statement]) -> None:
        """Assign from the innermost on; the place of each target is worked out once."""
        first, *others = node.links
        held = self._held(first, into)
        for link in others:
            taken = link if isinstance(link, typed.SetAddress) else replace(link, value=held)
            held = self._held(taken, into)

    def _held(self, link: typed.Assign | typed.SetAddress, into: list[ir.Statement]) -> Value:
        """Assign, and return what the target holds then."""
        if isinstance(link, typed.SetAddress):
            self._set_address(link, into)
            return link.address
        target, value = link.target, link.value
        if is_scalar(target.type):
            value = self._variable(link.line, target.type, self.argument(value, target.type), into)
            held: Value = value
        else:
            address = self._variable(link.line, UDINT, self.address(target), into)
            target = held = typed.Target(target.type, address)
        self._assign(typed.Assign(link.line, target, value), into)
        return held

    def _variable(
        self, line: int, data_type: Type, value: ir.Expression, into: list[ir.Statement]
    ) -> Value:
        """Return a variable of the function's own that holds a scalar."""
        assert value.type is not None
        symbol = typed.Symbol("", data_type, "frame")
        index = self.function.in_locals[symbol] = self.function.local(value.type)
        into.append(ir.SetLocal(line, index, value))
        return typed.Variable(data_type, symbol)

    def _scalar_assignment(self, line: int, target: Value, value: Value) -> ir.Statement:
        if isinstance(target, typed.Bit):
            return self._bit_assignment(line, target, value)
        if isinstance(target, typed.Variable) and not target.symbol.by_address:
            index = self.function.in_locals.get(target.symbol)
            if index is not None:
                return ir.SetLocal(line, index, self.argument(value, target.type))
        width = width_of(target.type)
        return ir.Store(line, width, self.place(target), self.stored(value, target.type))

    def _bit_assignment(self, line: int, target: typed.Bit, value: Value) -> ir.Statement:
        """Set one bit of an integer, and leave the others."""
        base = target.base
        value_type = ir.VALUE_TYPE[width_of(base.type)]
        one = ir.Const(value_type, 1)
        bit = ir.Binary(value_type, "and", self.operand(value, value_type), one)
        if target.number:
            bit = ir.Binary(value_type, "shl", bit, ir.Const(value_type, target.number))
        others = ir.Const(value_type, ~(1 << target.number))
        rest = ir.Binary(value_type, "and", self.value(base), others)
        whole = ir.Binary(value_type, "or", rest, bit)
        if isinstance(base, typed.Variable) and not base.symbol.by_address:
            index = self.function.in_locals.get(base.symbol)
            if index is not None:
                narrow = conversions.narrowed(whole, base.type) if value_type == "i32" else whole
                return ir.SetLocal(line, index, narrow)
        return ir.Store(line, width_of(base.type), self.place(base), whole)

    def _string_assignment(
        self, line: int, target: Value, value: Value, data_type: StringType | WStringType
    ) -> ir.Statement:
        """Copy up to the length of the shorter declaration, and the terminator behind it."""
        unit = 2 if isinstance(data_type, WStringType) else 1
        limit = data_type.length
        if isinstance(value, typed.Constant) and isinstance(value.value, str):
            length = len(literal_data(value.value, is_wide=unit == 2)) // unit - 1
            if length <= limit:
                size = ir.Const("i32", (length + 1) * unit)
                return ir.CopyBytes(line, self.address(target), self.address(value), size)
            limit = min(limit, length)
        elif isinstance(value.type, StringType | WStringType):
            limit = min(limit, value.type.length)
        helper = "rt.string_assign" if unit == 1 else "rt.wstring_assign"
        arguments = (self.address(target), self.address(value), ir.Const("i32", limit))
        return ir.Evaluate(line, ir.Call(None, helper, arguments))

    def _set_address(self, node: typed.SetAddress, into: list[ir.Statement]) -> None:
        address = node.address
        if is_scalar(address.type):
            value = to_type(self.value(address), "i32", unsigned=True)
        else:
            value = self.address(address)
        reference = node.reference
        if isinstance(reference, typed.Variable):
            index = self.function.in_locals.get(reference.symbol)
            if index is not None:
                into.append(ir.SetLocal(node.line, index, value))
                return
        into.append(ir.Store(node.line, "w32", self.place(reference), value))

    # Calls

    def _evaluate(self, node: typed.Evaluate, into: list[ir.Statement]) -> None:
        value = node.value
        if isinstance(value, typed.Dispatch) and value.type is VOID:
            number = self.value(value.number)
            (_, first), *others = value.calls
            arms = [
                ir.Arm(
                    node.line,
                    ir.Compare("i32", "eq", number, ir.Const("i32", which)),
                    [ir.Evaluate(node.line, self.method(call))],
                )
                for which, call in others
            ]
            last = [ir.Evaluate(node.line, self.method(first))]
            into += [ir.If(node.line, arms, last)] if arms else last
        elif not is_pure(value):
            into.append(ir.Evaluate(node.line, self.value(node.value)))

    def _call_block(self, node: typed.CallBlock, into: list[ir.Statement]) -> None:
        for before in node.before:
            _RULES[type(before)](self, before, into)
        call = ir.Call(None, self.module.block(node.block), (self.address(node.instance),))
        into.append(ir.Evaluate(node.line, call))
        for behind in node.after:
            _RULES[type(behind)](self, behind, into)

    def _call_action(self, node: typed.CallAction, into: list[ir.Statement]) -> None:
        block = self.function.block
        name = f"action {node.name}" if block is None else f"action {block.name}.{node.name}"
        arguments = () if block is None else (ir.Local("i32", 0),)
        into.append(ir.Evaluate(node.line, ir.Call(None, name, arguments)))

    # Conditions

    def condition(self, node: Value) -> ir.Expression:
        """Return an i32 that is 0 where a condition does not hold."""
        value = self.value(node)
        return value if value.type == "i32" else conversions.truth(value)

    def _if(self, node: typed.If, into: list[ir.Statement]) -> None:
        arms = [
            ir.Arm(arm.line, self.condition(arm.condition), self.statements(arm.body))
            for arm in node.arms
        ]
        into.append(ir.If(node.line, arms, self.statements(node.other)))

    def _case(self, node: typed.Case, into: list[ir.Statement]) -> None:
        selector = self.value(node.selector)
        other = self.statements(node.other)
        if selector.type == "i64":
            into.append(self._long_case(node, selector, other))
            return
        cases = [
            ir.Case(
                element.line,
                [part for each in element.ranges for part in _signed_ranges(*each)],
                self.statements(element.body),
            )
            for element in node.elements
        ]
        into.append(ir.Switch(node.line, selector, cases, other))

    def _long_case(
        self, node: typed.Case, selector: ir.Expression, other: list[ir.Statement]
    ) -> ir.Statement:
        """Compare a selector of 64 bits with one label after another."""
        before, kept = self.kept(selector)
        arms = []
        for element in node.elements:
            condition: ir.Expression = ir.Const("i32", 0)
            for low, high in element.ranges:
                inside = ir.Compare(
                    "i64",
                    "le_u",
                    ir.Binary("i64", "sub", kept, ir.Const("i64", low)),
                    ir.Const("i64", high - low),
                )
                condition = ir.Binary("i32", "or", condition, inside)
            arms.append(ir.Arm(element.line, condition, self.statements(element.body)))
        found: list[ir.Statement] = [ir.If(node.line, arms, other)] if arms else other
        return ir.Block(node.line, self.function.label(), [*before, *found])

    # Loops

    def _for(self, node: typed.For, into: list[ir.Statement]) -> None:
        line = node.line
        into.append(self._scalar_assignment(line, node.variable, node.first))
        limit, step = self._for_values(node, into)
        variable = self.value(node.variable)
        condition = self._for_condition(node, variable, limit, step)
        loop, inner = self.function.label(), self.function.label()
        leave = ir.If(line, [ir.Arm(line, conversions.negated(condition), [ir.Break(line, loop)])])
        body = self._loop_body(node.body, loop, inner)
        following = self._for_step(node, variable, step)
        if self.semantics.limits_once:
            body = [*body, *self._step_with_end(node, following, limit, step, loop)]
        else:
            body = [*body, self._stored_step(node, following)]
        into.append(ir.Loop(line, loop, [leave, *body]))

    def _for_values(
        self, node: typed.For, into: list[ir.Statement]
    ) -> tuple[ir.Expression, ir.Expression]:
        """Return limit and step: evaluated in each pass, or once before the loop."""
        limit = self.value(node.last)
        step = ir.Const("i32", 1) if node.step is None else self.value(node.step)
        if not self.semantics.limits_once:
            return limit, step
        for_limit, limit = self.kept(limit)
        for_step, step = self.kept(step)
        into += [*for_limit, *for_step]
        return limit, step

    def _for_condition(
        self,
        node: typed.For,
        variable: ir.Expression,
        limit: ir.Expression,
        step: ir.Expression,
    ) -> ir.Expression:
        """Return ``variable <= limit``, or ``>=`` where the step is negative."""
        is_plain = (is_unsigned_in_c(node.variable), is_unsigned_in_c(node.last))
        if self.semantics.narrow_results:
            unsigned = is_unsigned(common_number(node.variable.type, node.last.type))
            is_plain = (unsigned, unsigned)
        assert variable.type is not None
        assert limit.type is not None
        wanted = common_type(variable.type, limit.type)
        a = to_type(variable, wanted, unsigned=is_plain[0])
        b = to_type(limit, wanted, unsigned=is_plain[1])
        suffix = "u" if any(is_plain) else "s"
        up: Any = f"le_{suffix}"
        down: Any = f"ge_{suffix}"
        if isinstance(step, ir.Const):
            return ir.Compare(wanted, up if step.value >= 0 else down, a, b)
        assert step.type is not None
        rises = ir.Compare(step.type, "ge_s", step, conversions.zero(step.type))
        upwards = ir.Compare(wanted, up, a, b)
        return ir.IfExpression("i32", rises, upwards, ir.Compare(wanted, down, a, b))

    def _for_step(
        self, node: typed.For, variable: ir.Expression, step: ir.Expression
    ) -> ir.Expression:
        assert variable.type is not None
        unsigned = node.step is not None and is_unsigned_in_c(node.step)
        return ir.Binary(
            variable.type, "add", variable, to_type(step, variable.type, unsigned=unsigned)
        )

    def _stored_step(self, node: typed.For, following: ir.Expression) -> ir.Statement:
        variable = node.variable
        if isinstance(variable, typed.Variable) and not variable.symbol.by_address:
            index = self.function.in_locals.get(variable.symbol)
            if index is not None:
                value = following
                if following.type == "i32":
                    value = conversions.narrowed(following, variable.type)
                return ir.SetLocal(node.line, index, value)
        return ir.Store(node.line, width_of(variable.type), self.place(variable), following)

    def _step_with_end(
        self,
        node: typed.For,
        following: ir.Expression,
        limit: ir.Expression,
        step: ir.Expression,
        loop: int,
    ) -> list[ir.Statement]:
        """Step, and end where the next value would pass the limit, even if it does not fit."""
        before, kept = self.kept(following)
        ends = conversions.negated(self._for_condition(node, kept, limit, step))
        if width_of(node.variable.type) not in ("s8", "s16"):
            ends = ir.Binary("i32", "or", ends, _has_wrapped(node, kept, step))
        leave = ir.If(node.line, [ir.Arm(node.line, ends, [ir.Break(node.line, loop)])])
        return [*before, self._stored_step(node, kept), leave]

    def _loop_body(self, nodes: Sequence[Statement], loop: int, inner: int) -> list[ir.Statement]:
        """Lower a body that EXIT leaves to ``loop`` and CONTINUE to ``inner``."""
        self._loops.append((loop, inner))
        found = self.statements(nodes)
        self._loops.pop()
        if inner not in self._continued:
            return found
        return [ir.Block(nodes[0].line, inner, found)]

    def _while(self, node: typed.While, into: list[ir.Statement]) -> None:
        line = node.line
        loop, inner = self.function.label(), self.function.label()
        condition = conversions.negated(self.condition(node.condition))
        leave = ir.If(line, [ir.Arm(line, condition, [ir.Break(line, loop)])])
        into.append(ir.Loop(line, loop, [leave, *self._loop_body(node.body, loop, inner)]))

    def _repeat(self, node: typed.Repeat, into: list[ir.Statement]) -> None:
        loop, inner = self.function.label(), self.function.label()
        body = self._loop_body(node.body, loop, inner)
        condition = self.condition(node.condition)
        leave = ir.If(node.until, [ir.Arm(node.until, condition, [ir.Break(node.until, loop)])])
        into.append(ir.Loop(node.line, loop, [*body, leave]))

    def _exit(self, node: typed.Exit, into: list[ir.Statement]) -> None:
        into.append(ir.Break(node.line, self._loops[-1][0]))

    def _continue(self, node: typed.Continue, into: list[ir.Statement]) -> None:
        inner = self._loops[-1][1]
        self._continued.add(inner)
        into.append(ir.Break(node.line, inner))

    def _return(self, node: typed.Return, into: list[ir.Statement]) -> None:
        into.append(ir.Return(node.line, self._result()))


def _has_wrapped(node: typed.For, following: ir.Expression, step: ir.Expression) -> ir.Expression:
    """Return whether a step went past the end of 32 or 64 bits, or below 0.

    Then it has led below the lowest number and the step, or above the highest and a step down.
    """
    value_type = following.type
    assert value_type is not None
    unsigned = is_unsigned(common_number(node.variable.type, node.variable.type))
    lowest = 0 if unsigned else -(1 << (31 if value_type == "i32" else 63))
    highest = -1 if unsigned else -lowest - 1
    suffix = "u" if unsigned else "s"
    wide = to_type(step, value_type, unsigned=node.step is not None and is_unsigned_in_c(node.step))

    def beyond(operator: Any, end: int) -> ir.Expression:
        border = ir.Binary(value_type, "add", ir.Const(value_type, end), wide)
        return ir.Compare(value_type, operator, following, border)

    up, down = beyond(f"lt_{suffix}", lowest), beyond(f"gt_{suffix}", highest)
    if isinstance(step, ir.Const):
        return up if step.value >= 0 else down
    assert step.type is not None
    rises = ir.Compare(step.type, "ge_s", step, conversions.zero(step.type))
    return ir.IfExpression("i32", rises, up, down)


def _signed_ranges(low: int, high: int) -> list[tuple[int, int]]:
    """Return a range of labels in signed numbers of 32 bits; UDINT may need two."""
    low, high = max(low, -(1 << 31)), min(high, _I32_BITS - 1)
    if low > high:
        return []
    if high <= _MOST:
        return [(low, high)]
    if low > _MOST:
        return [(low - _I32_BITS, high - _I32_BITS)]
    return [(low, _MOST), (-(1 << 31), high - _I32_BITS)]


_RULES: dict[type, Callable[[StatementLowering, Any, list[ir.Statement]], None]] = {
    typed.Assign: StatementLowering._assign,
    typed.Chain: StatementLowering._chain,
    typed.SetAddress: StatementLowering._set_address,
    typed.Evaluate: StatementLowering._evaluate,
    typed.CallBlock: StatementLowering._call_block,
    typed.CallAction: StatementLowering._call_action,
    typed.If: StatementLowering._if,
    typed.Case: StatementLowering._case,
    typed.For: StatementLowering._for,
    typed.While: StatementLowering._while,
    typed.Repeat: StatementLowering._repeat,
    typed.Exit: StatementLowering._exit,
    typed.Continue: StatementLowering._continue,
    typed.Return: StatementLowering._return,
    typed.Jump: StatementLowering._jump,
}
