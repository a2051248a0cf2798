"""Checking statements."""

from __future__ import annotations

from bisect import bisect
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text.check import typed
from plcsim.program.structured_text.check.blocks import BlockChecker
from plcsim.program.structured_text.check.fits import as_character
from plcsim.program.structured_text.check.kinds import (
    ANY_INT,
    ANY_REAL,
    BOOL,
    COUNTS,
    DINT,
    UDINT,
    VOID,
    kind_of,
)
from plcsim.program.structured_text.check.names import NOTHING
from plcsim.program.structured_text.check.typed import PLACES, Address, Constant, Target
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.names import WITH_ENABLE, language_of
from plcsim.program.structured_text.syntax import tree
from st_types.resolve.constants import EvaluationError
from st_types.syntax import expressions as syntax
from st_types.syntax.literals import parse_literal
from st_types.types.derived import ReferenceType, StructType
from st_types.types.elementary import REAL

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.program.structured_text.check.findings import FileFindings
    from plcsim.program.structured_text.check.kinds import Type
    from plcsim.program.structured_text.check.names import ScopeNames
    from plcsim.program.structured_text.check.typed import Statement, Value
    from st_types.syntax.expressions import Expression

_TYPES_OF_LITERALS: Final[Mapping[Type, Type]] = {ANY_INT: DINT, ANY_REAL: REAL}
_LEAVING = (typed.Exit, typed.Continue, typed.Return, typed.Jump)


class StatementChecker(BlockChecker):
    """Checks the statements of one body.

    Args:
        names: what names mean in it.
        findings: take what is wrong.
        actions: the actions that it can call: their names by how names are compared.

    Attributes:
        called_actions: names of the actions that it calls.
        temporaries: what its temporary statements keep.
    """

    def __init__(
        self, names: ScopeNames, findings: FileFindings, actions: Mapping[str, str]
    ) -> None:
        super().__init__(names, findings)
        self.called_actions: set[str] = set()
        self.temporaries: list[typed.Symbol] = []
        self._actions = actions
        self._loops = 0
        self._labels: frozenset[str] = frozenset()
        self._placed: set[str] = set()
        self._key = names.scope.dialect.key
        has_enable = language_of(findings.tokens.source.path) in WITH_ENABLE
        self._may_enable = has_enable or not names.scope.dialect.case_sensitive

    def statements(self, nodes: Sequence[tree.Statement]) -> list[Statement]:
        """Return the checked statements."""
        found: list[Statement] = []
        labels = self._labels
        own = {self._key(each.label) for each in nodes if type(each) is tree.LabelStatement}
        self._labels = labels | own
        for node in nodes:
            is_left = found and isinstance(found[-1], _LEAVING)
            if is_left and type(node) is not tree.LabelStatement:
                self.findings.warning(node, FindingCode.UNREACHABLE, "this is never reached")
            _RULES[type(node)](self, node, found)
        self._labels = labels
        return found

    # Assignments

    def _assignment(self, node: tree.Assignment, into: list[Statement]) -> None:
        if type(node.value) is syntax.Call and self._has_enable(node.value):
            self._enabled(node, node.value, lambda call: replace(node, value=call), into)
            return
        line = self.findings.line(node)
        if node.operator != ":=":
            into.append(_VENDOR_RULES[node.operator](self, node, line))
            return
        if type(node.value) is tree.Assignment:
            self._chain(node, into)
            return
        assert not isinstance(node.value, tree.Assignment)
        written = self.written_property(node.target, node.value)
        if written is not None:
            into.append(typed.Evaluate(line, written))
            return
        target = self.assigned(node.target)
        into.append(self.assignment(node.value, target, self.value(node.value), line))

    def _chain(self, node: tree.Assignment, into: list[Statement]) -> None:
        """Check ``a := b := c``: b first, then a takes what b holds."""
        links = [node]
        while isinstance(links[-1].value, tree.Assignment):
            links.append(links[-1].value)
        last = links.pop()
        source = last.value
        assert not isinstance(source, tree.Assignment)
        target = self.assigned(last.target)
        line = self.findings.line(node)
        found = [self.assignment(source, target, self.value(source), self.findings.line(last))]
        while links:
            link = links.pop()
            value = found[-1].address if isinstance(found[-1], typed.SetAddress) else target
            target = self.assigned(link.target)
            made = self.assignment(last.target, target, value, self.findings.line(link))
            found.append(made)
            last = link
        into.append(typed.Chain(line, found))

    def _access(self, node: tree.Assignment, line: int) -> Statement:
        reference = self._reference(node.target)
        assert not isinstance(node.value, tree.Assignment)
        value = self.value(node.value)
        if kind_of(value.type) not in COUNTS and isinstance(value, PLACES):
            value = self._address_of(node.value, value)
        elif value.type.size != UDINT.size and value.type is not VOID:
            self.integer(node.value, value)
        return typed.SetAddress(line, reference, value)

    def _refer(self, node: tree.Assignment, line: int) -> Statement:
        reference = self._reference(node.target)
        assert not isinstance(node.value, tree.Assignment)
        value = self.value(node.value)
        if not isinstance(value, Address) and not (
            isinstance(value, Constant) and value.value == 0
        ):
            value = self._address_of(node.value, value)
        return typed.SetAddress(line, reference, value)

    def _address_of(self, node: Expression, value: Value) -> Value:
        is_reference = isinstance(value, Target) and isinstance(value.pointer.type, ReferenceType)
        if is_reference and isinstance(value, Target):
            return value.pointer
        return self.address(node)

    def _reference(self, node: Expression) -> Value:
        """Return the place that holds the address of a reference."""
        value = self.value(node)
        if isinstance(value, Target) and isinstance(value.pointer.type, ReferenceType):
            return value.pointer
        if isinstance(value.type, ReferenceType):
            return value
        if value.type is not VOID:
            self.error(node, FindingCode.NO_REFERENCE, f"{value.type} is no reference")
        return NOTHING

    def _set_or_reset(self, node: tree.Assignment, line: int) -> Statement:
        """Check ``b S= c`` and ``b R= c`` as an IF."""
        target = self.assigned(node.target)
        assert not isinstance(node.value, tree.Assignment)
        condition = self.condition(node.value)
        self.check_fit(node.target, Constant(BOOL, 1), target.type)
        value = Constant(BOOL, int(node.operator == "S="))
        arm = typed.Arm(line, condition, [typed.Assign(line, target, value)])
        return typed.If(line, [arm], ())

    def _temporary(self, node: tree.TemporaryStatement, into: list[Statement]) -> None:
        """Check a value that is kept for the rest of the call."""
        value = self.value(node.value)
        data_type = _TYPES_OF_LITERALS.get(value.type, value.type)
        symbol = typed.Symbol(node.name, data_type, "frame", self.names.scope, used=True)
        self.names.values[node.name] = target = typed.Variable(data_type, symbol)
        if data_type is not VOID:
            self.temporaries.append(symbol)
            into.append(self.assignment(node.value, target, value, self.findings.line(node)))

    # Calls

    def _expression(self, node: tree.ExpressionStatement, into: list[Statement]) -> None:
        expression = node.expression
        if type(expression) is syntax.Call and self._has_enable(expression):
            self._enabled(node, expression, lambda call: replace(node, expression=call), into)
            return
        line = self.findings.line(node)
        found: Statement | None = None
        name = expression.function if type(expression) is syntax.Call else expression
        if type(name) is syntax.MemberAccess and self.is_namespace(name.base):
            name = syntax.Name(name.at, name.name)
        if type(name) is syntax.Name and self._key(name.name) in self._actions:
            found = self._action(expression, self._key(name.name), line)
        elif type(expression) is syntax.Call:
            found = self.block_call(expression, line)
        else:
            found = self.bare_call(expression, line)
        into.append(found or self._evaluated(expression, line))

    def _call_by_type(self, node: tree.BlockCall, into: list[Statement]) -> None:
        """Check a call of Automation Basic: of a function block by its type, or any other one."""
        found = self.call_by_type(node, self.findings.line(node))
        if found is None:
            call = syntax.Call(node.block.at, node.block, node.arguments)
            self._expression(tree.ExpressionStatement(node.at, call), into)
        else:
            into.append(found)

    def _has_enable(self, node: syntax.Call) -> bool:
        """Return whether a call has an EN or ENO that nothing declares.

        Automation Studio's Structured Text has none; what is drawn there has.
        """
        if not self._may_enable or _enables(node) == (None, None):
            return False
        name = node.function
        if type(name) is syntax.Name:
            value = self.names.value(name)
            if value is not None:
                is_declared = isinstance(value.type, StructType) and value.type.spelling("EN")
                return not is_declared
            function = self.names.scope.find_function(name.name)
            return function is None or function.scope.find_variable("EN") is None
        return True

    def _enabled(
        self,
        node: tree.Assignment | tree.ExpressionStatement,
        call: syntax.Call,
        made: Callable[[syntax.Call], tree.Statement],
        into: list[Statement],
    ) -> None:
        """Check a call with EN and ENO as ``IF EN THEN call; ENO := TRUE; ELSE ENO := FALSE;``."""
        enable, enabled = _enables(call)
        others = [each for each in call.arguments if each.name.upper() not in ("EN", "ENO")]
        then: list[tree.Statement] = [made(replace(call, arguments=others))]
        other: list[tree.Statement] = []
        for body, text in ((then, "TRUE"), (other, "FALSE")):
            if enabled is not None:
                value = syntax.Literal(node.at, text, parse_literal(text))
                body.append(tree.Assignment(node.at, enabled, value))
        if enable is None:
            into += self.statements(then)
        else:
            self._if(tree.IfStatement(node.at, [tree.Arm(node.at, enable, then)], other), into)

    def _action(self, node: Expression, name: str, line: int) -> Statement:
        if isinstance(node, syntax.Call) and node.arguments:
            self.error(
                node, FindingCode.WRONG_ARGUMENTS, f"{name} is an action and takes no arguments"
            )
        self.called_actions.add(name)
        return typed.CallAction(line, self._actions[name])

    def _evaluated(self, node: Expression, line: int) -> Statement:
        value = self.called(node) if type(node) is syntax.Call else self.value(node)
        if isinstance(node, syntax.Binary) and node.operator == "=":
            message = "this compares; to assign, write :="
            self.findings.warning(node, FindingCode.COMPARED, message)
        elif value.type is not VOID and not isinstance(node, syntax.Call):
            self.findings.warning(node, FindingCode.NO_EFFECT, "this statement does nothing")
        return typed.Evaluate(line, value)

    # Conditions and loops

    def _if(self, node: tree.IfStatement, into: list[Statement]) -> None:
        arms = [
            typed.Arm(
                self.findings.line(arm), self.condition(arm.condition), self.statements(arm.body)
            )
            for arm in node.arms
        ]
        other = self.statements(node.other) if node.other else ()
        into.append(typed.If(arms[0].line, arms, other))

    def _case(self, node: tree.CaseStatement, into: list[Statement]) -> None:
        selector = self.value(node.selector)
        self.integer(node.selector, selector)
        taken: list[tuple[int, int]] = []
        elements = [self._element(element, taken, selector.type) for element in node.elements]
        other = self.statements(node.other) if node.other else ()
        into.append(typed.Case(self.findings.line(node), selector, elements, other))

    def _element(
        self, node: tree.CaseElement, taken: list[tuple[int, int]], selector: Type
    ) -> typed.CaseElement:
        ranges = []
        for low, high in node.labels:
            first = self._label(low, selector)
            last = first if high is None else self._label(high, selector)
            if first is None or last is None:
                continue
            place = bisect(taken, (first, last))
            if any(
                lower <= last and first <= upper
                for lower, upper in taken[max(place - 1, 0) : place + 1]
            ):
                self.error(low, FindingCode.LABEL_TWICE, f"{first} has a label already")
                continue
            taken.insert(place, (first, last))
            ranges.append((first, last))
        return typed.CaseElement(self.findings.line(node), ranges, self.statements(node.body))

    def _label(self, node: Expression, selector: Type) -> int | None:
        try:
            value = self._label_value(node, selector)
        except EvaluationError as err:
            self.error(node, FindingCode.WRONG_LABEL, f"this is no constant: {err.message}")
            return None
        if isinstance(value, int):
            return int(value)
        self.error(node, FindingCode.WRONG_LABEL, "the label of a CASE is an integer")
        return None

    def _label_value(self, node: Expression, selector: Type) -> object:
        if isinstance(node, syntax.Name | syntax.MemberAccess | syntax.Literal):
            value = as_character(self.value(node), selector)
            if isinstance(value, Constant):
                return value.value
            if value.type is not VOID:
                raise EvaluationError(node.at, "it is a variable")
            return 0
        return self.names.scope.evaluate(node).value

    def _for(self, node: tree.ForStatement, into: list[Statement]) -> None:
        line = self.findings.line(node)
        variable = self.assigned(node.variable)
        if self.integer(node.variable, variable) and not isinstance(variable, PLACES):
            variable = NOTHING
        values = [self.value(each) for each in (node.first, node.last)]
        self.check_fit(node.first, values[0], variable.type)
        self.integer(node.last, values[1])
        step = None if node.step is None else self.value(node.step)
        if step is not None and node.step is not None:
            self.integer(node.step, step)
        body = self._loop_body(node.body)
        into.append(typed.For(line, variable, values[0], values[1], step, body))

    def _loop_body(self, nodes: Sequence[tree.Statement]) -> list[Statement]:
        self._loops += 1
        found = self.statements(nodes)
        self._loops -= 1
        return found

    def _while(self, node: tree.WhileStatement, into: list[Statement]) -> None:
        line = self.findings.line(node)
        condition = self.condition(node.condition)
        into.append(typed.While(line, condition, self._loop_body(node.body)))

    def _repeat(self, node: tree.RepeatStatement, into: list[Statement]) -> None:
        body = self._loop_body(node.body)
        condition = self.condition(node.condition)
        until = self.findings.line(node.condition)
        into.append(typed.Repeat(self.findings.line(node), body, until, condition))

    def _exit(self, node: tree.ExitStatement, into: list[Statement]) -> None:
        self._check_in_loop(node, "EXIT")
        into.append(typed.Exit(self.findings.line(node)))

    def _continue(self, node: tree.ContinueStatement, into: list[Statement]) -> None:
        self._check_in_loop(node, "CONTINUE")
        into.append(typed.Continue(self.findings.line(node)))

    def _check_in_loop(self, node: syntax.Node, word: str) -> None:
        if not self._loops:
            self.error(node, FindingCode.NOT_IN_LOOP, f"{word} stands in no loop")

    def _return(self, node: tree.ReturnStatement, into: list[Statement]) -> None:
        into.append(typed.Return(self.findings.line(node)))

    def _jump(self, node: tree.JumpStatement, into: list[Statement]) -> None:
        """Check a jump: it leads to its own list of statements, or out to one around it."""
        label = self._key(node.label)
        if label in self._labels:
            into.append(typed.Jump(self.findings.line(node), label))
            return
        near = self.findings.near(node.label, self._labels)
        message = f"no label {node.label} is here or around{near}"
        self.error(node, FindingCode.UNKNOWN_NAME, message, "a jump does not lead into a statement")

    def _mark(self, node: tree.LabelStatement, into: list[Statement]) -> None:
        label = self._key(node.label)
        if label in self._placed:
            self.error(node, FindingCode.DECLARED_TWICE, f"the label {node.label} is there twice")
            return
        self._placed.add(label)
        into.append(typed.Label(self.findings.line(node), label))


def _enables(node: syntax.Call) -> tuple[Expression | None, Expression | None]:
    """Return what a call gives for EN, and what takes its ENO."""
    given = {each.name.upper(): each.value for each in node.arguments if each.name}
    return given.get("EN"), given.get("ENO")


_VENDOR_RULES: dict[str, Callable[[StatementChecker, tree.Assignment, int], Statement]] = {
    "ACCESS": StatementChecker._access,
    "REF=": StatementChecker._refer,
    "S=": StatementChecker._set_or_reset,
    "R=": StatementChecker._set_or_reset,
}
_RULES: dict[type, Callable[[StatementChecker, Any, list[Statement]], None]] = {
    tree.Assignment: StatementChecker._assignment,
    tree.ExpressionStatement: StatementChecker._expression,
    tree.BlockCall: StatementChecker._call_by_type,
    tree.IfStatement: StatementChecker._if,
    tree.CaseStatement: StatementChecker._case,
    tree.ForStatement: StatementChecker._for,
    tree.WhileStatement: StatementChecker._while,
    tree.RepeatStatement: StatementChecker._repeat,
    tree.ExitStatement: StatementChecker._exit,
    tree.ContinueStatement: StatementChecker._continue,
    tree.ReturnStatement: StatementChecker._return,
    tree.JumpStatement: StatementChecker._jump,
    tree.LabelStatement: StatementChecker._mark,
    tree.TemporaryStatement: StatementChecker._temporary,
}
