"""Expressions to text."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from st_types.syntax.expressions import (
    PRECEDENCE,
    UNARY_PRECEDENCE,
    Argument,
    Binary,
    Call,
    Dereference,
    DirectAddress,
    Expression,
    Index,
    Literal,
    MemberAccess,
    Name,
    Unary,
)

if TYPE_CHECKING:
    from st_types.syntax.lexer import Tokens


def print_expression(node: Expression) -> str:
    """Return the text of ``node``, with the parentheses that its shape needs."""
    return ExpressionPrinter().expression(node)


class ExpressionPrinter:
    """Prints expressions with the parentheses that their shape needs and those that were read.

    Args:
        tokens: of the file that the expressions were read from.
    """

    def __init__(self, tokens: Tokens | None = None) -> None:
        self._read = Counter(tokens.parentheses.values() if tokens is not None else ())

    def expression(self, node: Expression) -> str:
        """Return the text of an expression."""
        return self._operand(node, 0)

    def _operand(self, node: Expression, minimum: int) -> str:
        count = max(self._read[node.at], _binds(node) < minimum)
        return "(" * count + self._bare(node) + ")" * count

    def _bare(self, node: Expression) -> str:
        match node:
            case Binary():
                return self._binary(node)
            case Unary():
                blank = " " if node.operator == "NOT" else ""
                return node.operator + blank + self._operand(node.operand, UNARY_PRECEDENCE)
            case Literal() | DirectAddress():
                return node.text
            case Name():
                return node.name
        return self._postfix(node)

    def _binary(self, node: Binary) -> str:
        """Print a chain of operators from its left end, for it may be hundreds long."""
        chain: list[Binary] = [node]
        while isinstance(left := chain[-1].left, Binary) and self._goes_on(left, chain[-1]):
            chain.append(left)
        text = self._operand(chain[-1].left, _binds(chain[-1]))
        for part in reversed(chain):
            text += f" {part.operator} {self._operand(part.right, _binds(part) + 1)}"
        return text

    def _goes_on(self, left: Binary, node: Binary) -> bool:
        return _binds(left) >= _binds(node) and not self._read[left.at]

    def _postfix(self, node: MemberAccess | Index | Dereference | Call) -> str:
        """Print a path from its right end, for it may have hundreds of parts."""
        parts: list[str] = []
        base: Expression = node
        while isinstance(base, MemberAccess | Index | Dereference | Call):
            if parts and _is_bit(base):
                break
            text, base = self._part(base)
            parts.append(text)
        first = self._bare(base)
        parts.append(first if isinstance(base, Name) else f"({first})")
        return "".join(reversed(parts))

    def _part(self, node: MemberAccess | Index | Dereference | Call) -> tuple[str, Expression]:
        match node:
            case MemberAccess():
                return f".{node.name}", node.base
            case Index():
                return f"[{', '.join(map(self.expression, node.indices))}]", node.base
            case Dereference():
                return "^", node.base
        return f"({', '.join(map(self._argument, node.arguments))})", node.function

    def _argument(self, node: Argument) -> str:
        value = self.expression(node.value) if node.value is not None else ""
        sign = f" {'=>' if node.is_output else ':='} "
        negation = "NOT " if node.is_negated else ""
        return f"{negation}{node.name}{sign}{value}".rstrip() if node.name else value


def _is_bit(node: Expression) -> bool:
    return isinstance(node, MemberAccess) and node.name.isdecimal()


def _binds(node: Expression) -> int:
    match node:
        case Binary():
            return PRECEDENCE[node.operator]
        case Unary():
            return UNARY_PRECEDENCE
    return UNARY_PRECEDENCE + 2
