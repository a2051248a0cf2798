"""Syntax tree to text, in the shape Automation Studio writes it.

Parsing the printed text gives an equal tree. Comments before and behind declarations are kept;
comments inside a declaration are not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.syntax.expression_printer import print_expression
from st_types.syntax.tree import (
    ArrayInitial,
    ArraySpecification,
    Declaration,
    DeclarationFile,
    EnumerationSpecification,
    EnumerationValue,
    FunctionBlockDeclaration,
    FunctionDeclaration,
    Initial,
    Item,
    MemberInitial,
    NamedType,
    ReferenceSpecification,
    RepeatedInitial,
    StringSpecification,
    StructInitial,
    StructSpecification,
    SubrangeSpecification,
    TypeBlock,
    TypeSpecification,
    VariableBlock,
)
from st_types.syntax.trivia import comments_before, comments_behind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from st_types.syntax.expressions import Expression


def print_file(file: DeclarationFile) -> str:
    """Return the text of a file, lines ended by LF."""
    return "".join(map(print_item, file.items)) + _own_lines(_all_comments(file.closing), "")


def print_item(item: Item) -> str:
    """Return the text of one block, function or function block, lines ended by LF."""
    match item:
        case TypeBlock():
            lead = _own_lines(_all_comments(item.before), "")
            return lead + _block("TYPE", item.declarations, item.closing, "") + "END_TYPE\n"
        case VariableBlock():
            return _own_lines(_all_comments(item.before), "") + _variable_block(item, "")
        case FunctionBlockDeclaration():
            return _unit(item, f"FUNCTION_BLOCK {item.name}") + "END_FUNCTION_BLOCK\n"
    result = f" : {print_specification(item.result)}" if item.result else ""
    return _unit(item, f"FUNCTION {item.name}{result}") + "END_FUNCTION\n"


def _unit(unit: FunctionBlockDeclaration | FunctionDeclaration, head: str) -> str:
    lines = _own_lines(_all_comments(unit.before), "")
    lines += " ".join((*unit.pragmas, head, *comments_behind(unit.behind))) + "\n"
    for number, block in enumerate(unit.blocks):
        comments = _all_comments(block.before) if number else comments_before(block.before)
        lines += _own_lines(comments, "\t") + _variable_block(block, "\t")
    return lines + _own_lines(comments_before(unit.closing), "")


def _variable_block(block: VariableBlock, indent: str) -> str:
    head = " ".join((*block.pragmas, block.section, *block.qualifiers))
    return _block(head, block.declarations, block.closing, indent) + indent + "END_VAR\n"


def _block(head: str, declarations: Sequence[Declaration], closing: str, indent: str) -> str:
    first = comments_behind(declarations[0].before if declarations else closing)
    return (
        f"{indent}{head}\n"
        + _own_lines(first, indent + "\t")
        + "".join(print_declaration(d, indent + "\t") for d in declarations)
        + _own_lines(comments_before(closing), indent + "\t")
    )


def _all_comments(trivia: str) -> tuple[str, ...]:
    return comments_behind(trivia) + comments_before(trivia)


def _own_lines(comments: Sequence[str], indent: str) -> str:
    return "".join(f"{indent}{comment}\n" for comment in comments)


def print_declaration(node: Declaration, indent: str = "") -> str:
    """Return the lines of a type, a variable or a member, its comments included."""
    address = f" AT {node.address}" if node.address else ""
    specification = print_specification(node.specification, indent)
    words = (f"{indent}{node.name}{address} :", *node.pragmas, specification, node.edge)
    initial = f" := {print_initial(node.initial)}" if node.initial is not None else ""
    text = " ".join(filter(None, words)).replace(": \n", ":\n", 1) + initial + ";"
    lead = _own_lines(comments_before(node.before), indent)
    return lead + " ".join((text, *comments_behind(node.behind))) + "\n"


def print_specification(node: TypeSpecification, indent: str = "") -> str:
    """Return the text of a type; lines after the first are indented by ``indent``."""
    match node:
        case NamedType():
            return node.name
        case StringSpecification():
            return f"{node.name}[{print_expression(node.length)}]"
        case ArraySpecification():
            bounds = ", ".join(_range(low, high) for low, high in node.bounds)
            return f"ARRAY[{bounds}] OF {print_specification(node.element, indent)}"
        case ReferenceSpecification():
            keyword = node.keyword if node.keyword == "REF_TO" else f"{node.keyword} TO"
            return f"{keyword} {print_specification(node.target, indent)}"
        case SubrangeSpecification():
            return f"{node.base}({_range(node.low, node.high)})"
        case StructSpecification():
            return _struct(node, indent)
    return _enumeration(node, indent)


def _range(low: Expression, high: Expression) -> str:
    text = print_expression(low)
    # A real, an address or a date would swallow the dots.
    blank = " " if text.endswith(".") or "%" in text or "#" in text else ""
    return f"{text}{blank}..{print_expression(high)}"


def _struct(node: StructSpecification, indent: str) -> str:
    head = " ".join(("STRUCT", *comments_behind(node.behind)))
    members = "".join(print_declaration(member, indent + "\t") for member in node.members)
    closing = _own_lines(comments_before(node.closing), indent + "\t")
    return f"{head}\n{members}{closing}{indent}END_STRUCT"


def _enumeration(node: EnumerationSpecification, indent: str) -> str:
    inner = indent + "\t"
    head = comments_behind(node.values[0].before) if node.values else ()
    values = "".join(
        _enumeration_value(value, "," if value is not node.values[-1] else "", inner)
        for value in node.values
    )
    closing = _own_lines(comments_before(node.values[-1].behind), inner) if node.values else ""
    base = f" {node.base}" if node.base else ""
    return "\n" + inner + " ".join(("(", *head)) + f"\n{values}{closing}{inner}){base}"


def _enumeration_value(node: EnumerationValue, comma: str, indent: str) -> str:
    value = f" := {print_expression(node.value)}" if node.value is not None else ""
    line = " ".join((f"{indent}{node.name}{value}{comma}", *comments_behind(node.behind)))
    return _own_lines(comments_before(node.before), indent) + line + "\n"


def print_initial(node: Initial) -> str:
    """Return the text of an initial value."""
    match node:
        case ArrayInitial():
            return f"[{_initials(node.items)}]"
        case RepeatedInitial():
            return f"{print_expression(node.count)}({_initials(node.items)})"
        case StructInitial():
            return f"({_initials(node.members)})"
    return print_expression(node)


def _initials(nodes: Sequence[Initial | MemberInitial]) -> str:
    return ", ".join(
        f"{node.name} := {print_initial(node.value)}"
        if isinstance(node, MemberInitial)
        else print_initial(node)
        for node in nodes
    )
