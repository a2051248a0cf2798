"""Instruction List of IEC 61131-3, edition 2 (3.2): read into the statements that it stands for.

Files of Automation Studio's FBD and CFC hold it behind what their editor draws, which is a comment.

An instruction works on the current result. It is an expression here until something keeps it; what
is taken again later is worked out once, in a temporary statement. At a label there is no current
result, for jumps come from elsewhere: an instruction that takes one there is an error.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.syntax.keywords import UNIT_ENDS, UNIT_STARTS
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from plcsim.program.structured_text.syntax.tree import (
    Arm,
    Assignment,
    ExpressionStatement,
    IfStatement,
    JumpStatement,
    LabelStatement,
    ReturnStatement,
    TemporaryStatement,
)
from plcsim.program.structured_text.syntax.units import UnitParser
from st_types.syntax.expressions import Argument, Binary, Call, Literal, Name, Unary
from st_types.syntax.lexer import TokenKind, kind_of
from st_types.syntax.reader import UnexpectedTokenError

if TYPE_CHECKING:
    from plcsim.program.structured_text.syntax.tree import Statement, StructuredTextFile
    from st_types.syntax.expressions import Expression
    from st_types.syntax.source import Source

_SIGNS: Final = {
    "AND": "AND",
    "&": "AND",
    "OR": "OR",
    "XOR": "XOR",
    "ADD": "+",
    "SUB": "-",
    "MUL": "*",
    "DIV": "/",
    "MOD": "MOD",
    "GT": ">",
    "GE": ">=",
    "EQ": "=",
    "NE": "<>",
    "LE": "<=",
    "LT": "<",
}
"""Operators of two operands, as Structured Text writes them."""

_NEGATED: Final = {"ANDN": "AND", "&N": "AND", "ORN": "OR", "XORN": "XOR"}
"""Operators that negate their operand."""

_LEAVING: Final = frozenset(["JMP", "RET"])
_CALLS: Final = frozenset(["CAL", *_LEAVING])
_MODIFIERS: Final = {"": "", "C": "C", "CN": "CN", "NC": "CN"}
MAX_LENGTH: Final = 100
"""Instructions whose results are one expression; bounds the depth of its tree."""

_FRESH: Final = frozenset(["LD", "LDN", "JMP", "RET"])
"""Instructions that take no current result, and leave none of before."""

_ENDS: Final = frozenset([")", ";"])


def read_instruction_list(source: Source) -> StructuredTextFile:
    """Parse a file of Instruction List; what is wrong is in its ``diagnostics``."""
    return parse_structured_text(source, parser_class=InstructionListParser)


class _Deferred(NamedTuple):
    """An operator whose second operand stands in the parentheses that are open.

    Attributes:
        at: number of its token.
        word: the operator.
        left: its first operand.
        length: instructions by which that was worked out.
    """

    at: int
    word: str
    left: Expression
    length: int


class InstructionListParser(UnitParser):
    """Parses units whose bodies are lists of instructions."""

    _result: Expression | None = None
    _length = 0
    """Instructions that the current result is worked out by."""
    _temporaries = 0

    def statements(self) -> list[Statement]:
        """Parse instructions up to the end of the unit."""
        found: list[Statement] = []
        self._result = None
        self._deferred: list[_Deferred] = []
        while not self._is_end():
            start = self.index
            try:
                self._instruction(found)
            except UnexpectedTokenError as err:
                self.tell(err.offset, err.message, err.hint)
                self.depth = 0
                self._recover_instruction(start)
        if self._deferred:
            offset = self.tokens.offset(self._deferred[-1].at)
            self.tell(offset, "expected ')' behind the operands of this operator")
        return found

    def _is_end(self) -> bool:
        key = self.keys[self.index]
        return not key or key in UNIT_ENDS or (key in UNIT_STARTS and not self._is_name(key))

    def _recover_instruction(self, start: int) -> None:
        """Step to the next line."""
        self.index = max(self.index, start + 1)
        while not self._begins_line() and not self._is_end():
            self.index += 1
        self._result = self._result or Name(start, "")

    def _begins_line(self) -> bool:
        trivia = self.trivia[self.index]
        return "\n" in trivia or "\r" in trivia or not self.text

    def _instruction(self, into: list[Statement]) -> None:
        at, word = self.index, self.keyword
        if self.keys[at + 1] == ":" and word.isidentifier():
            into.append(LabelStatement(at, self.text))
            self.index += 2
            self._result = None
            return
        self.index += 1
        if word == ";":
            return
        if word == ")":
            self._close_operator(at, into)
        elif word in ("LD", "LDN"):
            value = self._value("to load")
            self._result = Unary(at, "NOT", value) if word == "LDN" else value
            self._length = 1
        elif word in ("ST", "STN", "S", "R"):
            self._store(at, word, into)
        elif word == "NOT":
            self._replace(at, Unary(at, "NOT", self._current(at)), 0, into)
        elif word in _SIGNS or word in _NEGATED:
            self._operate(at, word, into)
        elif (found := _flow(word)) is not None:
            self._branch(at, *found, into)
        else:
            self._invoke(at, into)
        if not self._begins_line() and self.text not in _ENDS and not self._is_end():
            self.fail("expected the end of the line behind an instruction")

    # The current result

    def _current(self, at: int) -> Expression:
        """Return the current result, which the instruction at a token replaces."""
        if self._result is None:
            message = f"{self.texts[at]} has no current result here: nothing is loaded before it"
            raise UnexpectedTokenError(self.tokens.offset(at), message)
        return self._result

    def _taken(self, at: int, into: list[Statement]) -> Expression:
        """Return the current result, which the instruction at a token leaves as it is.

        It is kept where another instruction may take it: what it is worked out of may be changed.
        """
        found = self._current(at)
        is_kept = isinstance(found, Literal) or (isinstance(found, Name) and " " in found.name)
        if is_kept or self._is_taken_last():
            return found
        return self._keep(at, found, into)

    def _keep(self, at: int, value: Expression, into: list[Statement]) -> Expression:
        """Let a value be worked out here; it is the current result."""
        self._temporaries += 1
        name = f"result {self._temporaries}"
        into.append(TemporaryStatement(at, name, value))
        self._result = Name(at, name)
        self._length = 1
        return self._result

    def _replace(self, at: int, value: Expression, others: int, into: list[Statement]) -> None:
        """Take another current result, which was worked out of this one.

        Args:
            at: number of the token of the instruction.
            value: the result.
            others: instructions by which its other operand was worked out.
            into: takes the value where it is too long.
        """
        self._result = value
        self._length = max(self._length, others) + 1
        if self._length > MAX_LENGTH:
            self._keep(at, value, into)

    def _is_taken_last(self) -> bool:
        """Return whether the next instruction takes no current result."""
        if self._is_end() or self.keyword in _FRESH:
            return True
        return self.keys[self.index + 1] == ":" and self.text.isidentifier()

    # Instructions

    def _value(self, purpose: str) -> Expression:
        """Parse an operand on the line of its operator."""
        if self._begins_line():
            self.fail_before(f"expected an operand {purpose}")
        self._operators = 0
        return self._operand()

    def _store(self, at: int, word: str, into: list[Statement]) -> None:
        target = self._value("to store to")
        value = self._taken(at, into)
        if word == "STN":
            value = Unary(at, "NOT", value)
        operator = f"{word}=" if word in ("S", "R") else ":="
        into.append(Assignment(at, target, value, operator))

    def _operate(self, at: int, word: str, into: list[Statement]) -> None:
        """Parse an operator with its operands, or with what stands in parentheses behind it."""
        left = self._current(at)
        if self.text == "(":
            self.index += 1
            self.enter()
            self._deferred.append(_Deferred(at, word, left, self._length))
            self._result = None if self._begins_line() else self._value("in the parenthesis")
            self._length = 1
            return
        self._replace(at, _applied(at, word, left, self._value(f"of {word}")), 0, into)
        while self.accept(","):
            right = self._value("behind ','")
            self._replace(at, _applied(at, word, self._current(at), right), 0, into)

    def _close_operator(self, at: int, into: list[Statement]) -> None:
        """Carry out the operator whose parenthesis ends."""
        if not self._deferred:
            raise UnexpectedTokenError(self.tokens.offset(at), "')' closes no parenthesis")
        self.leave()
        inner = self._current(at)
        deferred = self._deferred.pop()
        value = _applied(deferred.at, deferred.word, deferred.left, inner)
        self._replace(deferred.at, value, deferred.length, into)

    def _branch(self, at: int, word: str, modifier: str, into: list[Statement]) -> None:
        """Parse CAL, JMP and RET, with C where the current result must be TRUE, CN where FALSE."""
        statement: Statement
        if word == "RET":
            statement = ReturnStatement(at)
        elif word == "JMP":
            statement = JumpStatement(at, self.expect_name(f"of a label behind {word}"))
        else:
            called = self._value("to call")
            call = called if isinstance(called, Call) else Call(at, called, [])
            statement = ExpressionStatement(at, call)
        if not modifier:
            into.append(statement)
            self._result = None if word in _LEAVING else self._result
            return
        condition = self._taken(at, into)
        if modifier == "CN":
            condition = Unary(at, "NOT", condition)
        into.append(IfStatement(at, [Arm(at, condition, [statement])], None))

    def _invoke(self, at: int, into: list[Statement]) -> None:
        """Parse a function: the current result is its first argument, unless all have names."""
        if kind_of(self.texts[at]) is not TokenKind.IDENTIFIER:
            self.index = at
            self.fail("expected an instruction")
        name = Name(at, self.texts[at])
        if self.text == "(" and not self._begins_line():
            self.index += 1
            given = self._arguments()
            if not all(argument.name for argument in given):
                hint = "the first argument is the current result; the others stand without brackets"
                message = f"expected arguments with names in the brackets behind {name.name}"
                raise UnexpectedTokenError(self.tokens.offset(at), message, hint)
            self._result = Call(at, name, given)
            self._length = 1
            return
        given = [Argument(at, "", self._current(at))]
        while not self._begins_line() and self.text not in _ENDS:
            given.append(Argument(self.index, "", self._value(f"of {name.name}")))
            if not self.accept(","):
                break
        self._replace(at, Call(at, name, given), 0, into)


def _applied(at: int, word: str, left: Expression, right: Expression) -> Expression:
    """Return what an operator makes of two operands."""
    right = Unary(at, "NOT", right) if word in _NEGATED else right
    return Binary(at, _SIGNS[_NEGATED.get(word, word)], left, right)


def _flow(word: str) -> tuple[str, str] | None:
    """Return CAL, JMP or RET and its modifier, None for another word."""
    modifier = _MODIFIERS.get(word[3:])
    return (word[:3], modifier) if word[:3] in _CALLS and modifier is not None else None
