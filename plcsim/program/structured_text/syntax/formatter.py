"""Formatting of Structured Text: indentation and blanks; tokens, comments and line breaks stay.

Each block indents what is in it by one step; so do brackets, and a statement that goes on in the
next line. Between tokens stands one blank where readers expect one. Blanks before ``:=``, ``:`` and
comments stay where there are some, for people align those.
"""

from __future__ import annotations

import re
from dataclasses import fields
from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.syntax import tree
from plcsim.program.structured_text.syntax.keywords import (
    OPERATORS,
    RESERVED,
    STATEMENT_ENDS,
    STATEMENT_STARTS,
    UNIT_ENDS,
    UNIT_STARTS,
)
from st_types.syntax import expressions
from st_types.syntax import tree as declarations
from st_types.syntax.expressions import Node
from st_types.syntax.lexer import Tokens

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from st_types.syntax.source import Source

DEFAULT_STEP: Final = "\t"
MOST_NEWLINES: Final = 3
"""Two empty lines in a row stay, more do not."""

_COMMENT = re.compile(r"\(\*.*?\*\)|//[^\r\n]*|/\*.*?\*/|\{[^{}]*\}", re.DOTALL)
_NEWLINE = re.compile(r"\r\n|\r|\n")
_CLOSERS: Final = STATEMENT_ENDS | UNIT_ENDS
_BRANCHES: Final = frozenset(["ELSE", "ELSIF", "UNTIL"])
_ASSIGNING: Final = frozenset(["REF", "S", "R"])
"""Words that mean an assignment with ``=`` right behind them."""

_BINARY: Final = frozenset([":=", "=>", "<>", "<=", ">=", "**", *"+-*/=<>&"])
_KEYWORDS: Final = RESERVED | STATEMENT_STARTS | UNIT_STARTS | OPERATORS | {"RETURN", "EXIT"}
_BLOCKS: Final = (
    tree.IfStatement,
    tree.CaseStatement,
    tree.ForStatement,
    tree.WhileStatement,
    tree.RepeatStatement,
    declarations.VariableBlock,
    declarations.TypeBlock,
    declarations.StructSpecification,
)
_NAMED: Final = (
    tree.ProgramUnit,
    tree.FunctionUnit,
    tree.FunctionBlockUnit,
    tree.ActionUnit,
    tree.MethodUnit,
    tree.StepUnit,
    tree.TransitionUnit,
    tree.Configuration,
)
"""What begins with a keyword before its name, where the node is."""

_BEHIND_STEPS: Final = frozenset(["ENTRY_ACTION", "EXIT_ACTION"])
"""Begins of blocks that no node stands for."""

_STATEMENTS: Final = tuple(
    each for name, each in vars(tree).items() if isinstance(each, type) and "Statement" in name
)
_STARTING: Final = (
    *_STATEMENTS,
    tree.ActionAssociation,
    tree.Assignment,
    tree.CaseElement,
    tree.TaskConfiguration,
    tree.ProgramConfiguration,
    declarations.Declaration,
)


class _Item(NamedTuple):
    """A token or a comment.

    Attributes:
        text: as it stands.
        newlines: line breaks before it.
        blanks: what stands between it and what is before it in its line.
        token: its number; of a comment that of the token behind it.
        is_comment: likewise.
    """

    text: str
    newlines: int
    blanks: str
    token: int
    is_comment: bool


class _Marks:
    """What the syntax tree says of tokens, by their numbers."""

    def __init__(self, file: tree.StructuredTextFile) -> None:
        self.starts: set[int] = set()
        self.opens: dict[int, str] = {}
        self.labels: set[int] = set()
        self.signs: set[int] = set()
        self.calls: set[int] = set()
        self._keys = [text.upper() for text in file.tokens.texts]
        self._first: dict[int, int] = {}
        for node in _children_first(file.units):
            self._mark(node)
        for at, (before, key) in enumerate(zip(self._keys, self._keys[1:], strict=False), 1):
            if key in _BEHIND_STEPS and before in ("END_STEP", "END_ACTION"):
                self._open(at)

    def _mark(self, node: Node) -> None:
        """Mark a node, those in it being marked already."""
        at = node.at
        first = min((self._first[id(each)] for each in _children(node)), default=at)
        first = min(first, at)
        if isinstance(node, _BLOCKS):
            self._open(at)
        elif isinstance(node, _NAMED):
            first = self._unit(at)
        elif isinstance(node, tree.CaseElement):
            self.labels.add(first)
        elif isinstance(node, expressions.Unary) and self._keys[at] in "+-":
            self.signs.add(at)
        elif isinstance(node, expressions.Call):
            self.calls.add(at)
        if isinstance(node, _STARTING):
            self.starts.add(first)
        self._first[id(node)] = first

    def _open(self, at: int) -> None:
        self.opens[at] = self._keys[at]
        self.starts.add(at)

    def _unit(self, at: int) -> int:
        """Find the keyword before the name of a unit."""
        while at > 0 and self._keys[at] not in UNIT_STARTS:
            at -= 1
        self._open(at)
        return at


def _children_first(nodes: Sequence[object]) -> Iterator[Node]:
    """Iterate over all nodes of a tree, however deep, what is in a node before the node."""
    waiting: list[tuple[Node, bool]] = [(each, False) for each in _nodes(nodes)]
    while waiting:
        node, is_done = waiting.pop()
        if is_done:
            yield node
        else:
            waiting.append((node, True))
            waiting += [(each, False) for each in _children(node)]


def _children(node: Node) -> Iterator[Node]:
    for name in _names_of(type(node)):
        yield from _nodes(getattr(node, name))


def _nodes(value: object) -> Iterator[Node]:
    if isinstance(value, Node):
        yield value
    elif isinstance(value, list | tuple):
        for each in value:
            yield from _nodes(each)


def _names_of(kind: type[Node]) -> tuple[str, ...]:
    found = _NAMES.get(kind)
    if found is None:
        found = _NAMES[kind] = tuple(each.name for each in fields(kind))
    return found


_NAMES: dict[type[Node], tuple[str, ...]] = {}


def format_text(file: tree.StructuredTextFile, step: str = DEFAULT_STEP) -> str:
    r"""Return the text of a file, formatted, with ``\n`` as line ends.

    Args:
        file: parsed without errors, no directives of the preprocessor in it.
        step: of the indentation.
    """
    return _Formatter(file, step).text()


def has_directives(source: Source) -> bool:
    """Return whether a text has lines of the preprocessor, whose branches are not all parsed."""
    return any(text.startswith("#") for text in Tokens(source).texts)


def content_of(source: Source) -> list[str]:
    """Return the tokens and comments of a text: what formatting leaves as it is."""
    return [item.text for item in _items(Tokens(source))]


def _items(tokens: Tokens) -> Iterator[_Item]:
    end = tokens.end
    for index in range(end):
        yield from _trivia(tokens.trivia[index], index, tokens.texts[index])
    behind = tokens.source.text[tokens.end_offset(end - 1) if end else 0 :]
    yield from _trivia(behind, end, "")


def _trivia(trivia: str, index: int, text: str) -> Iterator[_Item]:
    place = 0
    for match in _COMMENT.finditer(trivia):
        yield _item(match.group(), trivia[place : match.start()], index, is_comment=True)
        place = match.end()
    if text:
        yield _item(text, trivia[place:], index, is_comment=False)


def _item(text: str, before: str, index: int, *, is_comment: bool) -> _Item:
    lines = _NEWLINE.split(before)
    text = "\n".join(_NEWLINE.split(text)) if is_comment else text
    return _Item(text, len(lines) - 1, lines[-1], index, is_comment)


class _Formatter:
    def __init__(self, file: tree.StructuredTextFile, step: str) -> None:
        self._tokens = file.tokens
        self._marks = _Marks(file)
        self._step = step
        self._open: list[str] = []
        self._brackets = 0
        self._parts: list[str] = []

    def text(self) -> str:
        """Return the formatted text."""
        items = list(_items(self._tokens))
        previous: _Item | None = None
        for item in items:
            self._before(previous, item)
            self._parts.append(item.text)
            if not item.is_comment:
                self._pass(item)
            previous = item
        return "".join((*self._parts, "\n")) if items else ""

    def _before(self, previous: _Item | None, item: _Item) -> None:
        """Write what stands before an item."""
        key = "" if item.is_comment else item.text.upper()
        if previous is None or item.newlines:
            newlines = 0 if previous is None else min(item.newlines, MOST_NEWLINES)
            self._parts.append("\n" * newlines + self._step * self._depth(item, key))
        else:
            self._parts.append(self._between(previous, item))
        if key in _CLOSERS and key not in _BRANCHES and self._open:
            self._open.pop()

    def _depth(self, item: _Item, key: str) -> int:
        """Return how far a line is indented that begins with an item."""
        depth = len(self._open) + self._open.count("CASE")
        in_case = bool(self._open) and self._open[-1] == "CASE"
        marks = self._marks
        if item.token in marks.labels and not self._brackets:
            return depth - 1
        if key in _CLOSERS:
            if key in _BRANCHES:
                return depth - 1
            return depth - 1 - in_case
        if key in (")", "]"):
            return depth + max(0, self._brackets - 1)
        is_start = item.token in marks.starts or item.is_comment or key == ";"
        return depth + (self._brackets or not is_start)

    def _pass(self, item: _Item) -> None:
        if item.token in self._marks.opens:
            self._open.append(self._marks.opens[item.token])
        elif item.text in ("(", "["):
            self._brackets += 1
        elif item.text in (")", "]"):
            self._brackets = max(0, self._brackets - 1)

    def _between(self, previous: _Item, item: _Item) -> str:
        """Return the blanks between two items in one line."""
        if item.is_comment or previous.is_comment:
            return item.blanks or " "
        before, after = previous.text, item.text
        if after in (";", ",", ")", "]", ".", "^", "..") or before in ("(", "[", ".", ".."):
            return ""
        if previous.token in self._marks.signs:
            return ""
        if after == "=" and not item.blanks and before.upper() in _ASSIGNING:
            return ""
        if after in (":=", ":"):
            return item.blanks or (" " if after == ":=" else "")
        if after in ("(", "["):
            return self._before_bracket(previous, item)
        return " "

    def _before_bracket(self, previous: _Item, item: _Item) -> str:
        if item.token in self._marks.calls:
            return ""
        if previous.text.upper() in _KEYWORDS or previous.text in _BINARY or previous.text == ",":
            return " "
        return " " if item.blanks or previous.text == ":" else ""
