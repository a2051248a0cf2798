"""Syntax tree to text, in the shape Automation Studio writes it.

Parsing the printed text gives an equal tree. Parentheses, pragmas and the comments before and
behind declarations are kept; comments inside a declaration are not.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.syntax.expression_printer import ExpressionPrinter
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
    OpenArraySpecification,
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
from st_types.syntax.trivia import (
    comments_before,
    comments_behind,
    notes_before,
    notes_behind,
    pragmas_behind,
)

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from st_types.syntax.expressions import Argument, Expression


def print_file(file: DeclarationFile) -> str:
    """Return the text of a file, lines ended by LF."""
    return Printer(file.tokens).file(file)


def print_bytes(file: DeclarationFile) -> bytes:
    """Return a file with the encoding, the byte order mark and the line ends that were read."""
    return file.tokens.source.encode(print_file(file))


def print_item(item: Item) -> str:
    """Return the text of one block, function or function block, lines ended by LF."""
    return Printer().item(item)


def print_declaration(node: Declaration, indent: str = "") -> str:
    """Return the lines of a type, a variable or a member, its comments included."""
    return Printer().declaration(node, indent)


def print_specification(node: TypeSpecification) -> str:
    """Return the text of a type."""
    return Printer().specification(node, "")


def print_initial(node: Initial) -> str:
    """Return the text of an initial value."""
    return Printer().initial(node)


class Printer(ExpressionPrinter):
    """Prints what stands in a file of declarations."""

    def file(self, file: DeclarationFile) -> str:
        """Return the text of a file."""
        return "".join(map(self.item, file.items)) + _lines(_all_notes(file.closing), "")

    def item(self, item: Item) -> str:
        """Return the text of a block, a function or a function block."""
        match item:
            case TypeBlock():
                body = self._block("TYPE", item.declarations, item.closing, "")
                return f"{_lines(_all_notes(item.before), '')}{body}END_TYPE\n"
            case VariableBlock():
                return _lines(_all_comments(item.before), "") + self._variable_block(item, "")
            case FunctionBlockDeclaration():
                base = f" EXTENDS {item.base}" if item.base else ""
                return (
                    self._unit(item, f"FUNCTION_BLOCK {item.name}{base}") + "END_FUNCTION_BLOCK\n"
                )
        result = f" : {self.specification(item.result, '')}" if item.result else ""
        return self._unit(item, f"FUNCTION {item.name}{result}") + "END_FUNCTION\n"

    def _unit(self, unit: FunctionBlockDeclaration | FunctionDeclaration, head: str) -> str:
        text = _lines(_all_comments(unit.before), "")
        text += " ".join((*unit.pragmas, head, *comments_behind(unit.behind))) + "\n"
        for number, block in enumerate(unit.blocks):
            comments = _all_comments(block.before) if number else comments_before(block.before)
            text += _lines(comments, "\t") + self._variable_block(block, "\t")
        closing = notes_before(unit.closing) if unit.blocks else _all_notes(unit.closing)
        known = comments_behind(unit.behind) if not unit.blocks else ()
        return text + _lines([note for note in closing if note not in known], "")

    def _variable_block(self, block: VariableBlock, indent: str) -> str:
        head = " ".join((*block.pragmas, block.section, *block.qualifiers))
        return self._block(head, block.declarations, block.closing, indent) + indent + "END_VAR\n"

    def _block(
        self, head: str, declarations: Sequence[Declaration], closing: str, indent: str
    ) -> str:
        inner = indent + "\t"
        first = comments_behind(declarations[0].before if declarations else closing)
        body = "".join(self.declaration(node, inner) for node in declarations)
        last = notes_before(closing) + pragmas_behind(closing)
        return f"{indent}{head}\n{_lines(first, inner)}{body}{_lines(last, inner)}"

    def declaration(self, node: Declaration, indent: str) -> str:
        """Return the lines of a type, a variable or a member, its comments included."""
        address = f" AT {node.address}" if node.address else ""
        specification = self.specification(node.specification, indent)
        extends = _extends(node.specification)
        words = (
            f"{indent}{node.name}{extends}{address} :",
            *node.pragmas,
            specification,
            node.edge,
        )
        initial = f" := {self.initial(node.initial)}" if node.initial is not None else ""
        text = " ".join(filter(None, words)).replace(": \n", ":\n", 1) + initial + ";"
        lead = _lines(comments_before(node.before), indent)
        return lead + " ".join((text, *comments_behind(node.behind))) + "\n"

    def specification(self, node: TypeSpecification, indent: str) -> str:
        """Return the text of a type; lines after the first are indented by ``indent``."""
        match node:
            case NamedType():
                return node.name + self._given(node)
            case StringSpecification():
                return f"{node.name}[{self.expression(node.length)}]"
            case ArraySpecification():
                bounds = ", ".join(self._range(low, high) for low, high in node.bounds)
                return f"ARRAY[{bounds}] OF {self.specification(node.element, indent)}"
            case OpenArraySpecification():
                bounds = ", ".join("*" * node.dimensions)
                return f"ARRAY[{bounds}] OF {self.specification(node.element, indent)}"
            case ReferenceSpecification():
                keyword = node.keyword if node.keyword == "REF_TO" else f"{node.keyword} TO"
                return f"{keyword} {self.specification(node.target, indent)}"
            case SubrangeSpecification():
                return f"{node.base}({self._range(node.low, node.high)})"
            case StructSpecification():
                return self._struct(node, indent)
        return self._enumeration(node, indent)

    def _given(self, node: NamedType) -> str:
        lists = [
            f"({', '.join(self._argument(argument) for argument in arguments)})"
            for arguments in node.given
        ]
        return f"[{', '.join(lists)}]" if len(lists) > 1 else "".join(lists)

    def _argument(self, node: Argument) -> str:
        value = "" if node.value is None else self.expression(node.value)
        return f"{node.name} := {value}" if node.name else value

    def _range(self, low: Expression, high: Expression) -> str:
        text = self.expression(low)
        # A real, an address or a date would swallow the dots.
        blank = " " if text.endswith(".") or "%" in text or "#" in text else ""
        return f"{text}{blank}..{self.expression(high)}"

    def _struct(self, node: StructSpecification, indent: str) -> str:
        inner = indent + "\t"
        head = " ".join((node.keyword, *comments_behind(node.behind)))
        members = "".join(self.declaration(member, inner) for member in node.members)
        last = notes_before(node.closing) + pragmas_behind(node.closing)
        return f"{head}\n{members}{_lines(last, inner)}{indent}END_{node.keyword}"

    def _enumeration(self, node: EnumerationSpecification, indent: str) -> str:
        inner = indent + "\t"
        head = notes_behind(node.values[0].before) if node.values else ()
        values = "".join(
            self._enumeration_value(value, "," if value is not node.values[-1] else "", inner)
            for value in node.values
        )
        closing = _lines(notes_before(node.values[-1].behind), inner) if node.values else ""
        base = f" {node.base}" if node.base else ""
        return "\n" + inner + " ".join(("(", *head)) + f"\n{values}{closing}{inner}){base}"

    def _enumeration_value(self, node: EnumerationValue, comma: str, indent: str) -> str:
        value = f" := {self.expression(node.value)}" if node.value is not None else ""
        line = " ".join((f"{indent}{node.name}{value}{comma}", *notes_behind(node.behind)))
        return _lines(notes_before(node.before), indent) + line + "\n"

    def initial(self, node: Initial) -> str:
        """Return the text of an initial value."""
        match node:
            case ArrayInitial():
                return f"[{self._initials(node.items)}]"
            case RepeatedInitial():
                return f"{self.expression(node.count)}({self._initials(node.items)})"
            case StructInitial():
                return f"({self._initials(node.members)})"
        return self.expression(node)

    def _initials(self, nodes: Sequence[Initial | MemberInitial]) -> str:
        return ", ".join(
            f"{node.name} := {self.initial(node.value)}"
            if isinstance(node, MemberInitial)
            else self.initial(node)
            for node in nodes
        )


def _extends(node: TypeSpecification) -> str:
    return f" EXTENDS {node.base}" if isinstance(node, StructSpecification) and node.base else ""


def _all_comments(trivia: str) -> tuple[str, ...]:
    return comments_behind(trivia) + comments_before(trivia)


def _all_notes(trivia: str) -> tuple[str, ...]:
    return notes_behind(trivia) + notes_before(trivia)


def _lines(notes: Iterable[str], indent: str) -> str:
    return "".join(f"{indent}{note}\n" for note in notes)
