"""Expressions to text."""

from __future__ import annotations

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


def print_expression(node: Expression) -> str:
    """Return the text of ``node``, with the parentheses that its shape needs."""
    match node:
        case Binary():
            return _binary(node)
        case Unary():
            blank = " " if node.operator == "NOT" else ""
            return node.operator + blank + _operand(node.operand, UNARY_PRECEDENCE)
        case Literal() | DirectAddress():
            return node.text
        case Name():
            return node.name
    return _postfix(node)


def _binary(node: Binary) -> str:
    """Print a chain of operators from its left end, for it may be hundreds long."""
    chain: list[Binary] = [node]
    while isinstance(chain[-1].left, Binary) and _binds(chain[-1].left) >= _binds(chain[-1]):
        chain.append(chain[-1].left)
    text = _operand(chain[-1].left, _binds(chain[-1]))
    for part in reversed(chain):
        text += f" {part.operator} {_operand(part.right, _binds(part) + 1)}"
    return text


def _binds(node: Expression) -> int:
    match node:
        case Binary():
            return PRECEDENCE[node.operator]
        case Unary():
            return UNARY_PRECEDENCE
    return UNARY_PRECEDENCE + 2


def _operand(node: Expression, minimum: int) -> str:
    text = print_expression(node)
    return text if _binds(node) >= minimum else f"({text})"


def _postfix(node: MemberAccess | Index | Dereference | Call) -> str:
    match node:
        case MemberAccess():
            return f"{_base(node.base)}.{node.name}"
        case Index():
            return f"{_base(node.base)}[{', '.join(map(print_expression, node.indices))}]"
        case Dereference():
            return f"{_base(node.base)}^"
    return f"{_base(node.function)}({', '.join(map(_argument, node.arguments))})"


def _base(node: Expression) -> str:
    text = print_expression(node)
    is_bit = isinstance(node, MemberAccess) and node.name.isdecimal()
    is_path = isinstance(node, Name | MemberAccess | Index | Dereference | Call)
    return text if is_path and not is_bit else f"({text})"


def _argument(node: Argument) -> str:
    value = print_expression(node.value) if node.value is not None else ""
    sign = " => " if node.is_output else " := "
    name = f"NOT {node.name}" if node.is_negated else node.name
    return f"{name}{sign}{value}".rstrip() if node.name else value
