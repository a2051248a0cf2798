"""Automation Basic, B&R's language of lines: into the tree of Structured Text.

The first ``=`` of a line assigns, all others compare. ``TON_10ms(run, 100, done, time)`` calls a
function block whose instance nobody declares, with its inputs and then its outputs in their order;
``timer FUB TON_10ms()`` calls a declared one. ACTIONs of a CASE without ENDACTION share the
statements of the next one. ``UINT(x)`` converts. What is not known is an error at its line.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final

from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.languages.automation_basic_tokens import (
    END_OF_LINE,
    basic_tokens,
)
from plcsim.program.structured_text.languages.nodes import NodeMaker
from plcsim.program.structured_text.syntax.parser import is_text
from plcsim.program.structured_text.syntax.tree import (
    Arm,
    Assignment,
    BlockCall,
    CaseElement,
    CaseStatement,
    ExitStatement,
    ExpressionStatement,
    ForStatement,
    FunctionBlockUnit,
    FunctionUnit,
    IfStatement,
    JumpStatement,
    LabelStatement,
    ProgramUnit,
    StructuredTextFile,
)
from st_types.syntax.collector import collector_paused
from st_types.syntax.diagnostics import DiagnosticLog
from st_types.syntax.expressions import Call, ExpressionParser, Name
from st_types.syntax.lexer import NAME, KeyTable, Tokens
from st_types.syntax.reader import UnexpectedTokenError
from st_types.syntax.source import Source
from st_types.syntax.tree import FunctionBlockDeclaration, FunctionDeclaration
from st_types.types.elementary import ALL_ELEMENTARY

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.program.structured_text.syntax.tree import Statement, Unit
    from st_types.syntax.expressions import Expression

_UNITS: Final = frozenset(["PROGRAM", "FUNCTION", "FUNCTION_BLOCK"])
_ENDS: Final = frozenset(
    [
        *(f"END_{unit}" for unit in _UNITS),
        *("ELSE", "ENDIF", "ACTION", "ENDACTION", "ELSEACTION", "ENDCASE", "ENDLOOP"),
    ]
)
"""What ends a list of statements."""

_INSIDE: Final = frozenset(["THEN", "OF", "TO", "DOWNTO", "DO", "FUB"])
_STARTS: Final = frozenset(["IF", "CASE", "LOOP", "EXITIF", "GOTO", "INC", "DEC"])
_OPERATORS: Final = frozenset(["OR", "XOR", "AND", "MOD", "NOT"])
_MEANINGS: Final = {"BIT": "TO_BOOL", "LSL": "SHL", "LSR": "SHR"}
"""Functions by names that Structured Text does not have."""

_AFTER_NAMES: Final = frozenset(["=", ":=", ".", "["])
"""What makes a name of a keyword that it follows."""


def parse_automation_basic(source: Source) -> StructuredTextFile:
    """Parse a .ab file; errors are in the ``diagnostics`` of the result."""
    diagnostics = DiagnosticLog(source, FindingCode.SYNTAX)
    if not is_text(source.text):
        hint = "it is encrypted, binary, or UTF-16 without BOM"
        diagnostics.error(0, "the file is no text", hint)
        return StructuredTextFile([], Tokens(Source(source.path, "")), diagnostics)
    with collector_paused():
        file = BasicParser(basic_tokens(source), diagnostics).file()
    diagnostics.code = FindingCode.DECLARATION
    return file


class BasicParser(ExpressionParser):
    """Parses files of Automation Basic."""

    reserved: ClassVar[frozenset[str]] = _ENDS | _INSIDE | _OPERATORS
    key_table: ClassVar[KeyTable] = KeyTable(_OPERATORS | _ENDS | _INSIDE | _STARTS | _UNITS)

    def __init__(self, tokens: Tokens, diagnostics: DiagnosticLog) -> None:
        super().__init__(tokens, diagnostics)
        self._open: list[frozenset[str]] = []

    def found(self) -> str:
        """Return the next token as a message names it."""
        return "the end of the line" if self.text == END_OF_LINE else super().found()

    # Units

    def file(self) -> StructuredTextFile:
        """Parse the file; errors go to ``diagnostics``."""
        units: list[Unit] = []
        while self.text:
            start = self.index
            try:
                if not self.accept(END_OF_LINE):
                    units.append(self._unit())
            except UnexpectedTokenError as err:
                self.tell(err.offset, err.message, err.hint)
                self.depth = 0
                del self._open[:]
                self.index = max(self.index, start + 1)
                while self.keys[self.index] not in _UNITS and self.text:
                    self.index += 1
        if self.tokens.truncated:
            self.tell(self.here(), "the file has too many tokens")
        return StructuredTextFile(units, self.tokens, self.diagnostics, texts_are_addresses=True)

    def _unit(self) -> Unit:
        at, word = self.index, self.keyword
        if word not in _UNITS:
            hint = "a file of Automation Basic holds PROGRAM, FUNCTION_BLOCK and FUNCTION"
            self.fail("expected a unit", hint)
        self.index += 1
        named = self.index
        name = self.expect_name(f"after {word}")
        body = self._body(f"END_{word}")
        self.close(f"END_{word}", at)
        if word == "PROGRAM":
            return ProgramUnit(named, name, [], body)
        if word == "FUNCTION":
            return FunctionUnit(named, FunctionDeclaration(named, name, None, []), body)
        return FunctionBlockUnit(named, FunctionBlockDeclaration(named, name, []), body)

    # Lists of statements

    def _body(self, *ends: str) -> list[Statement]:
        """Parse statements up to one of the words ``ends``, or one that ends what is around."""
        self.enter()
        self._open.append(frozenset(ends))
        found: list[Statement] = []
        while not self._is_over():
            start, depth, opened = self.index, self.depth, len(self._open)
            try:
                self._line(found)
            except UnexpectedTokenError as err:
                self.tell(err.offset, err.message, err.hint)
                self.depth = depth
                del self._open[opened:]
                self._skip_line(start)
        self._open.pop()
        self.leave()
        return found

    def _is_over(self) -> bool:
        key = self.keys[self.index]
        if not key or key in _UNITS:
            return True
        return key in _ENDS and any(key in each for each in self._open) and not self._is_name()

    def _is_name(self) -> bool:
        """Return whether the next keyword is a name here."""
        return self.keys[self.index + 1] in _AFTER_NAMES

    def _skip_line(self, start: int) -> None:
        self.index = max(self.index, start)
        while self.text and self.text != END_OF_LINE:
            self.index += 1

    def _line(self, into: list[Statement]) -> None:
        """Parse a statement and the end of its line."""
        if self.accept(END_OF_LINE):
            return
        key = self.keys[self.index]
        if key == "LOOP" and not self._is_name():
            into += self._loop()
        elif key in _STARTS and not self._is_name():
            into.append(_RULES[key](self))
        elif key in _ENDS and not self._is_name():
            self.fail("expected a statement", f"nothing is open that {key} ends")
        else:
            into.append(self._named())
        if self.text and self.text != END_OF_LINE and not self._is_over():
            self.fail("expected the end of the line")

    def _named(self) -> Statement:
        """Parse what begins with a name: an assignment, a call, a label."""
        at = self.index
        self._operators = 0
        if self.keys[at] == NAME and self.keys[at + 1] == ":":
            self.index += 2
            return LabelStatement(at, self.texts[at])
        target = self._operand()
        sign = self.index
        if self.accept("=") or self.accept(":="):
            return Assignment(sign, target, self.expression())
        if self.accept("ACCESS"):
            return Assignment(sign, target, self.expression(), "ACCESS")
        if self.accept("FUB"):
            return self._block_call(at, target)
        if isinstance(target, Call) and isinstance(target.function, Name):
            return BlockCall(at, target.function, target.arguments)
        return ExpressionStatement(at, target)

    def _block_call(self, at: int, instance: Expression) -> Statement:
        """Parse what follows FUB: the function block and its arguments."""
        block = Name(self.index, self.expect_name("of a function block after FUB"))
        arguments = self._arguments() if self.accept("(") else []
        return BlockCall(at, block, arguments, instance)

    def _call(self, base: Expression) -> Expression:
        """Parse a call; that of a type is a conversion."""
        if isinstance(base, Name):
            word = base.name.upper()
            if word in ALL_ELEMENTARY:
                base = Name(base.at, f"TO_{word}")
            elif word in _MEANINGS:
                base = Name(base.at, _MEANINGS[word])
        return super()._call(base)

    # Statements

    def _if(self) -> Statement:
        at = self.index
        arms: list[Arm] = []
        other: list[Statement] | None = None
        while True:
            arms.append(self._arm())
            if self.keys[self.index] != "ELSE":
                break
            self.index += 1
            if self.keys[self.index] != "IF":
                other = self._body("ENDIF")
                break
        self.close("ENDIF", at)
        return IfStatement(at, arms, other)

    def _arm(self) -> Arm:
        """Parse IF, its condition, and its statements."""
        at = self.index
        self.index += 1
        condition = self.expression()
        self.expect("THEN", "after the condition")
        return Arm(at, condition, self._body("ELSE", "ENDIF"))

    def _case(self) -> Statement:
        at = self.index
        self.index += 1
        selector = self.expression()
        self.expect("OF", "after the selector of CASE")
        self._open.append(frozenset(["ACTION", "ELSEACTION", "ENDCASE"]))
        elements: list[CaseElement] = []
        other: list[Statement] | None = None
        while (key := self._after_lines()) in ("ACTION", "ELSEACTION"):
            start = self.index
            if key == "ACTION":
                self._element(elements)
            else:
                self.index += 1
                self.expect(":", "after ELSEACTION")
                other = self._body("ENDACTION")
                self.close("ENDACTION", start)
        self._open.pop()
        self.close("ENDCASE", at)
        return CaseStatement(at, selector, elements, other)

    def _after_lines(self) -> str:
        """Step over ends of lines; return the key of what follows."""
        while self.accept(END_OF_LINE):
            pass
        return self.keys[self.index]

    def _element(self, into: list[CaseElement]) -> None:
        """Parse ACTIONs up to the first ENDACTION: they share its statements."""
        at = self.index
        labels: list[tuple[Expression, Expression | None]] = []
        while True:
            start = self.index
            self.index += 1
            labels.append(self._label())
            while self.accept(","):
                labels.append(self._label())
            self.expect(":", "after the values of an ACTION")
            body = self._body("ENDACTION")
            if body or self.keys[self.index] != "ACTION":
                break
        self.close("ENDACTION", start)
        into.append(CaseElement(at, labels, body))

    def _label(self) -> tuple[Expression, Expression | None]:
        low = self.expression()
        return low, self.expression() if self.accept("..") else None

    def _loop(self) -> list[Statement]:
        at = self.index
        self.index += 1
        if self.text == END_OF_LINE or self.accept("DO"):
            body = self._body("ENDLOOP")
            self.close("ENDLOOP", at)
            return [NodeMaker(at).loop(NodeMaker(at).literal("TRUE"), body)]
        self._operators = 0
        variable = self._operand()
        self.expect("=", "after the variable of LOOP")
        first = self.expression()
        is_down = self.accept("DOWNTO")
        if not is_down:
            self.expect("TO", "after the first value of LOOP")
        last = self.expression()
        self.expect("DO", "after the values of LOOP")
        body = self._body("ENDLOOP")
        self.close("ENDLOOP", at)
        if is_down:
            return _counted_down(NodeMaker(at), variable, first, last, body)
        return [ForStatement(at, variable, first, last, None, body)]

    def _exit_if(self) -> Statement:
        at = self.index
        self.index += 1
        return IfStatement(at, [Arm(at, self.expression(), [ExitStatement(at)])], None)

    def _go_to(self) -> Statement:
        at = self.index
        self.index += 1
        return JumpStatement(at, self.expect_name("of a label after GOTO"))

    def _count(self) -> Statement:
        """Parse INC or DEC and the variable that it counts."""
        at = self.index
        operator = "+" if self.keys[at] == "INC" else "-"
        self.index += 1
        self._operators = 0
        target = self._operand()
        make = NodeMaker(at)
        return make.assignment(target, make.binary(operator, target, make.literal("1")))


def _counted_down(
    make: NodeMaker,
    variable: Expression,
    first: Expression,
    last: Expression,
    body: list[Statement],
) -> list[Statement]:
    """Return a loop that counts down: to 0 with an unsigned variable, too, which FOR never ends."""
    count = make.assignment(variable, make.binary("-", variable, make.literal("1")))
    is_last = make.binary("=", variable, last)
    passes = [*body, make.condition(is_last, [count, make.leave()]), count]
    loop = make.loop(make.binary(">=", variable, last), passes)
    return [make.assignment(variable, first), loop]


_RULES: Final[dict[str, Callable[[BasicParser], Statement]]] = {
    "IF": BasicParser._if,
    "CASE": BasicParser._case,
    "EXITIF": BasicParser._exit_if,
    "GOTO": BasicParser._go_to,
    "INC": BasicParser._count,
    "DEC": BasicParser._count,
}
