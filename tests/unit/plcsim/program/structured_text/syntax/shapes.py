"""Syntax trees as one line of text, for tests to compare."""

from collections.abc import Sequence

from plcsim.program.structured_text.syntax.parser import parse_structured_text
from plcsim.program.structured_text.syntax.tree import (
    Assignment,
    CaseStatement,
    ContinueStatement,
    ExitStatement,
    ExpressionStatement,
    ForStatement,
    IfStatement,
    JumpStatement,
    LabelStatement,
    ProgramUnit,
    RepeatStatement,
    ReturnStatement,
    Statement,
    StructuredTextFile,
    WhileStatement,
)
from st_types.syntax.expression_printer import print_expression as text_of
from st_types.syntax.source import Source


def parse(text: str, **defines: str) -> StructuredTextFile:
    return parse_structured_text(Source("a.st", text), defines)


def findings(text: str, **defines: str) -> list[str]:
    """Findings as ``line:column message``, with the hint behind a bar."""
    return [
        f"{record.line}:{record.column} {record.message}"
        + (f" | {record.hint}" if record.hint else "")
        for record in parse(text, **defines).diagnostics.records
    ]


def body(text: str) -> str:
    """The shape of statements, which must have no error."""
    file = parse(f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM")
    file.diagnostics.raise_errors()
    (unit,) = file.units
    assert isinstance(unit, ProgramUnit)
    return shapes(unit.body)


def body_findings(text: str) -> list[str]:
    """Findings in statements, counted from their own first line."""
    found = findings(f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM")
    return [f"{int(line) - 1}:{rest}" for line, _, rest in (text.partition(":") for text in found)]


def shapes(statements: Sequence[Statement]) -> str:
    return " ".join(map(shape, statements))


def shape(node: Statement) -> str:  # noqa: C901  # one short case for each kind
    match node:
        case Assignment(value=Assignment() as inner):
            return f"{text_of(node.target)} {node.operator} {shape(inner)}"
        case Assignment():
            assert not isinstance(node.value, Assignment)
            return f"{text_of(node.target)} {node.operator} {text_of(node.value)};"
        case ExpressionStatement():
            return f"{text_of(node.expression)};"
        case IfStatement():
            arms = [f"{text_of(arm.condition)} -> {{{shapes(arm.body)}}}" for arm in node.arms]
            other = "" if node.other is None else f" else {{{shapes(node.other)}}}"
            return f"if {' '.join(arms)}{other}"
        case CaseStatement():
            elements = [
                ",".join(
                    text_of(low) + ("" if high is None else ".." + text_of(high))
                    for low, high in element.labels
                )
                + f": {{{shapes(element.body)}}}"
                for element in node.elements
            ]
            other = "" if node.other is None else f" else {{{shapes(node.other)}}}"
            return f"case {text_of(node.selector)} {' '.join(elements)}{other}"
        case ForStatement():
            step = "" if node.step is None else f" by {text_of(node.step)}"
            head = f"{text_of(node.variable)} := {text_of(node.first)} to {text_of(node.last)}"
            return f"for {head}{step} {{{shapes(node.body)}}}"
        case WhileStatement():
            return f"while {text_of(node.condition)} {{{shapes(node.body)}}}"
        case RepeatStatement():
            return f"repeat {{{shapes(node.body)}}} until {text_of(node.condition)}"
        case JumpStatement():
            return f"jump {node.label}"
        case LabelStatement():
            return f"label {node.label}"
        case ExitStatement():
            return "exit"
        case ContinueStatement():
            return "continue"
        case ReturnStatement():
            return "return"
    raise AssertionError(node)
