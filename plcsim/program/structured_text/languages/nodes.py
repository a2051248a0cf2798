"""Making nodes of the syntax tree of Structured Text that stand nowhere in the text.

Each gets the ``at`` of the token that it stems from, so that what is told of it names that place.
"""

from __future__ import annotations

from functools import reduce
from typing import TYPE_CHECKING

from plcsim.program.structured_text.syntax.tree import (
    Arm,
    Assignment,
    ExitStatement,
    ExpressionStatement,
    IfStatement,
    WhileStatement,
)
from st_types.syntax.expressions import (
    Argument,
    Binary,
    Call,
    Index,
    Literal,
    MemberAccess,
    Name,
    Unary,
)
from st_types.syntax.literals import parse_literal
from st_types.syntax.tree import ArraySpecification, Declaration, NamedType, StructSpecification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.syntax.tree import Statement
    from st_types.syntax.expressions import Expression
    from st_types.syntax.tree import TypeSpecification


class NodeMaker:
    """Makes nodes at one token.

    Args:
        at: number of the token.
    """

    def __init__(self, at: int) -> None:
        self._at = at

    def name(self, text: str) -> Name:
        """Return a name."""
        return Name(self._at, text)

    def member(self, base: str, *names: str) -> Expression:
        """Return ``base.name.name``."""
        first: Expression = self.name(base)
        return reduce(lambda found, name: MemberAccess(self._at, found, name), names, first)

    def element(self, array: Expression, number: int) -> Expression:
        """Return ``array[number]``."""
        return Index(self._at, array, [self.literal(str(number))])

    def literal(self, text: str) -> Literal:
        """Return a literal."""
        return Literal(self._at, text, parse_literal(text))

    def binary(self, operator: str, left: Expression, right: Expression) -> Expression:
        """Return two operands with an operator, which is in capitals."""
        return Binary(self._at, operator, left, right)

    def joined(self, operator: str, operands: Sequence[Expression]) -> Expression:
        """Return all operands, of which there is one or more, with an operator between them.

        They are joined in pairs, so that the tree is no deeper than it has to be.
        """
        waiting = list(operands)
        while len(waiting) > 1:
            pairs = zip(waiting[::2], waiting[1::2], strict=False)
            odd = waiting[-1:] if len(waiting) % 2 else []
            waiting = [self.binary(operator, left, right) for left, right in pairs] + odd
        return waiting[0]

    def negated(self, operand: Expression) -> Expression:
        """Return ``NOT operand``."""
        return Unary(self._at, "NOT", operand)

    def call(self, name: str, *values: Expression) -> Expression:
        """Return ``name(value, ...)``."""
        arguments = [Argument(self._at, "", value) for value in values]
        return Call(self._at, self.name(name), arguments)

    def assignment(self, target: Expression, value: Expression) -> Statement:
        """Return ``target := value;``."""
        return Assignment(self._at, target, value)

    def statement(self, expression: Expression) -> Statement:
        """Return ``expression;``, a call or the name of an action."""
        return ExpressionStatement(self._at, expression)

    def condition(
        self,
        condition: Expression,
        body: Sequence[Statement],
        other: Sequence[Statement] | None = None,
    ) -> Statement:
        """Return ``IF condition THEN body ELSE other END_IF``."""
        return IfStatement(self._at, [Arm(self._at, condition, body)], other)

    def loop(self, condition: Expression, body: Sequence[Statement]) -> Statement:
        """Return ``WHILE condition DO body END_WHILE``."""
        return WhileStatement(self._at, condition, body)

    def leave(self) -> Statement:
        """Return ``EXIT;``."""
        return ExitStatement(self._at)

    def declaration(self, name: str, specification: TypeSpecification) -> Declaration:
        """Return ``name : specification;``."""
        return Declaration(self._at, name, specification)

    def type(self, name: str) -> TypeSpecification:
        """Return a type by its name."""
        return NamedType(self._at, name)

    def array(self, count: int, name: str) -> TypeSpecification:
        """Return ``ARRAY[0..count - 1] OF name``."""
        bounds = self.literal("0"), self.literal(str(count - 1))
        return ArraySpecification(self._at, [bounds], self.type(name))

    def struct(self, **members: TypeSpecification) -> TypeSpecification:
        """Return ``STRUCT name : specification; ... END_STRUCT``."""
        found = [self.declaration(name, each) for name, each in members.items()]
        return StructSpecification(self._at, found)
