"""Parser of statements.

It takes what Automation Studio takes (no semicolon after END_IF, keywords as names, chained
assignments, a bare name as a call) and what other vendors add to the norm. After an error it goes
on behind the next semicolon or at the next keyword, so that one run finds them all.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, ClassVar, Final, NoReturn

from plcsim.program.structured_text.syntax.keywords import (
    KEYS,
    OPERATORS,
    RESERVED,
    STATEMENT_ENDS,
    STATEMENT_STARTS,
    UNIT_ENDS,
    UNIT_STARTS,
)
from plcsim.program.structured_text.syntax.tree import (
    Arm,
    Assignment,
    CaseElement,
    CaseStatement,
    ContinueStatement,
    ExitStatement,
    ExpressionStatement,
    ForStatement,
    IfStatement,
    JumpStatement,
    LabelStatement,
    RepeatStatement,
    ReturnStatement,
    WhileStatement,
)
from st_types.syntax.declarations import DeclarationParser
from st_types.syntax.expressions import (
    MAX_OPERATORS,
    POSTFIXES,
    Binary,
    ExpressionParser,
    Name,
)
from st_types.syntax.lexer import NAME
from st_types.syntax.reader import MAX_DEPTH, UnexpectedTokenError

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.program.structured_text.syntax.tree import Statement
    from st_types.syntax.expressions import Expression
    from st_types.syntax.lexer import KeyTable

_STOPS = STATEMENT_ENDS | UNIT_ENDS | UNIT_STARTS | {""}
_OPENED_BY = {"ELSIF": ("END_IF",), "ELSE": ("END_IF", "END_CASE"), "UNTIL": ("END_REPEAT",)}
_AFTER_STATEMENT_WORDS = frozenset([":=", ".", "[", "^", "ACCESS"])
_NO_LABELS = STATEMENT_STARTS | {";"}
_LABEL_SIGNS = frozenset([":", ",", ".."])
_LABEL_SCAN_ENDS = frozenset([":", ",", "..", ":=", ";", "(", "[", "ACCESS", "", "^"])
MISSPELT: Final = {
    key.replace("_", ""): key for key in sorted(STATEMENT_ENDS | UNIT_ENDS) if "_" in key
} | {"ELSEIF": "ELSIF", "ELIF": "ELSIF", "ENDIF": "END_IF"}
"""Keywords as people write them by mistake."""

FOREIGN_FIRSTS: Final = frozenset(["+", "-", "*", "/", "="])
_VENDOR_ASSIGNMENTS = ("REF", "S", "R")
_RECOVERY = STATEMENT_STARTS | STATEMENT_ENDS | UNIT_ENDS | UNIT_STARTS


class StatementParser(DeclarationParser):
    """Parses lists of statements."""

    reserved: ClassVar[frozenset[str]] = RESERVED
    key_table: ClassVar[KeyTable] = KEYS

    _open: list[str]
    """The END keywords of the statements and units that are open, the outermost first."""
    _lost = False
    """Statements were nested too deep, so what ends which is not known any more."""

    keys: list[str]

    def _keys(self) -> list[str]:
        """Return the keys of all tokens: statements ask for most of them."""
        return self.key_table.keys_of(self.texts)

    expression = ExpressionParser.expression
    """That of declarations asks for no keys; here they are known."""

    def statements(self) -> list[Statement]:
        """Parse statements up to a keyword that ends a list; whether the right one is not asked.

        Errors go to ``diagnostics``.
        """
        found: list[Statement] = []
        while True:
            start, depth, opened = self.index, self.depth, len(self._open)
            try:
                self._statements(found)
            except UnexpectedTokenError as err:
                self.tell(err.offset, err.message, err.hint)
                self._lost |= self.depth > MAX_DEPTH
                self.depth = depth
                del self._open[opened:]
                self._recover_statement(start)
            else:
                return found

    def _statements(self, into: list[Statement]) -> None:
        keys, texts = self.keys, self.texts
        in_case = self._open[-1:] == ["END_CASE"]
        while True:
            index = self.index
            key = keys[index]
            if key == NAME and keys[index + 1] == ":=":  # as most statements begin
                self.index = index + 2
                value = self.expression()
                target = Name(index, texts[index])
                if keys[self.index] == ";":
                    self.index += 1
                    into.append(Assignment(index + 1, target, value))
                else:
                    into.append(self._assigned(index + 1, target, value))
            elif in_case and self._starts_label(key):
                return
            elif key == NAME:
                into.append(self._named_statement())
            elif key == ";":
                self.index += 1
            elif key in STATEMENT_STARTS and keys[self.index + 1] not in _AFTER_STATEMENT_WORDS:
                into.append(_RULES[key](self))
            elif key in _STOPS and not self._is_name(key):
                if self._ends_list(key):
                    return
                self._skip_stray(key)
            elif key == "directive":
                self._directive_in_body()
            elif key in ("(", "address", "literal") or key == self.keyword:
                into.append(self._designated_statement())
            else:
                self._no_statement()

    def _no_statement(self) -> NoReturn:
        message = f"expected a statement, found {self.found()}"
        self.index += 1
        raise UnexpectedTokenError(self.tokens.offset(self.index - 1), message)

    def _is_name(self, key: str) -> bool:
        """Return True where a keyword of a unit is a name: no other name follows it."""
        following = self.index + 1
        return key in UNIT_STARTS and (
            self.keys[following] == "ACCESS" or not self.texts[following].isidentifier()
        )

    def _ends_list(self, key: str) -> bool:
        """Return True for a keyword that belongs to something that is open, or starts a unit."""
        if key in UNIT_STARTS or not key or key in self._open:
            return True
        return any(end in self._open for end in _OPENED_BY.get(key, ()))

    def _skip_stray(self, key: str) -> None:
        if not self._lost:
            self.tell(self.here(), f"unexpected {key}: nothing is open that it ends")
        self.index += 1

    def _directive_in_body(self) -> None:
        """Step over a preprocessor line that is left: an ``#include``."""
        self.fail("expected a statement", "#include may stand between units only")

    def _recover_statement(self, start: int) -> None:
        """Step behind the next semicolon, or to a keyword that starts a line or ends a list."""
        keys, trivia = self.keys, self.trivia
        index = max(self.index, start + 1)
        if keys[index - 1] == ";" and keys[index] not in _RECOVERY:
            index += 1  # the first token of a statement is what is wrong
        while (key := keys[index]) and keys[index - 1] != ";":
            if key in _RECOVERY and (key not in STATEMENT_STARTS or "\n" in trivia[index]):
                break
            index += 1
        self.index = index

    def _named_statement(self) -> Statement:
        """Parse what begins with a name."""
        at = self.index
        keys = self.keys
        target: Expression = Name(at, self.texts[at])
        self.index = at + 1
        key = keys[at + 1]
        if key in POSTFIXES:
            self._operators = 0
            target = self.postfix(target)
            key = keys[self.index]
        if key == ":=":
            return self._assigned_to(target)
        if key == ";":
            self.index += 1
            return ExpressionStatement(at, target)
        if key == ":" and self.index == at + 1:
            return self._label(at)
        return self._rare_statement(at, target)

    def _assigned_to(self, target: Expression) -> Statement:
        """Parse ``:=`` and the value behind it."""
        at = self.index
        self.index = at + 1
        return self._assigned(at, target, self.expression())

    def _assigned(self, at: int, target: Expression, value: Expression) -> Statement:
        """Parse what follows ``target := value``, whose ``:=`` is token ``at``."""
        if self.keys[self.index] == ":=":
            return self._chained(at, target, value)
        return self._ended(Assignment(at, target, value))

    def _chained(self, at: int, target: Expression, value: Expression) -> Statement:
        """Parse the rest of ``a := b := c``; the value of a link is the next one."""
        links = [(at, target)]
        while self.keys[self.index] == ":=":
            if len(links) > MAX_OPERATORS:
                self.fail(f"expected at most {MAX_OPERATORS} assignments in a chain")
            links.append((self.index, value))
            self.index += 1
            value = self.expression()
        last, name = links.pop()
        found = Assignment(last, name, value)
        while links:
            last, name = links.pop()
            found = Assignment(last, name, found)
        return self._ended(found)

    def _label(self, at: int) -> Statement:
        self.index += 1
        if self.keys[self.index] == "=":
            self.fail(f"expected ':=' after {self.texts[at]}", "':=' is one sign, without a blank")
        return LabelStatement(at, self.texts[at])

    def _designated_statement(self) -> Statement:
        """Parse what begins with an address, a bracket, or a keyword as a name."""
        at = self.index
        self._operators = 0
        target = self._operand()
        if self.keys[self.index] == ":=":
            return self._assigned_to(target)
        return self._rare_statement(at, target)

    def _rare_statement(self, at: int, target: Expression) -> Statement:
        """Parse ``p ACCESS x``, ``p REF= x``, ``b S= x``, a call, ``a = b`` as a statement."""
        self._refuse_foreign()
        if type(target) is Name and (meant := MISSPELT.get(target.name.upper())):
            return self._misspelt(target, meant)
        if self.keys[self.index] == "ACCESS":
            self.index += 1
            return self._ended(Assignment(self.index - 1, target, self.expression(), "ACCESS"))
        sign = self.index + 1
        word = self.keyword
        if word in _VENDOR_ASSIGNMENTS and self.keys[sign] == "=" and not self.trivia[sign]:
            self.index += 2
            return self._ended(Assignment(sign, target, self.expression(), f"{word}="))
        if self.keys[self.index] == "=":
            self.index += 1
            return self._ended(
                ExpressionStatement(at, Binary(self.index - 1, "=", target, self.expression()))
            )
        return self._ended(ExpressionStatement(at, target))

    def _refuse_foreign(self) -> None:
        """Give up at ``+=``, ``++`` and ``==``."""
        keys, at = self.keys, self.index
        if keys[at] in FOREIGN_FIRSTS and keys[at + 1] in ("=", keys[at]):
            sign = f"{keys[at]}{keys[at + 1]}"
            hint = f"{sign} is no operator; a := a {keys[at]} 1 is how it is written"
            self.fail("expected ':='", "'=' compares, ':=' assigns" if sign == "==" else hint)

    def _misspelt(self, name: Name, meant: str) -> Statement:
        """Take ENDIF for END_IF, after a finding."""
        message = f"{name.name} is no keyword"
        self.tell(self.tokens.offset(name.at), message, f"did you mean {meant}?")
        self.index = name.at
        self.keys[name.at] = meant
        return ExpressionStatement(name.at, Name(name.at, ""))

    def _ended(self, statement: Statement) -> Statement:
        """Step over the semicolon; where the next statement starts a line, only tell it is missing.

        Raises:
            UnexpectedTokenError: something else follows on the line.
        """
        if self.keys[self.index] == ";":
            self.index += 1
            return statement
        expected = f"expected '{self._expected_end(statement)}' after the statement"
        try:
            self.fail_before(expected)
        except UnexpectedTokenError as err:
            trivia = self.trivia[self.index]
            key = self.keys[self.index]
            if key not in _STOPS and (key == ":" or ("\n" not in trivia and "\r" not in trivia)):
                raise UnexpectedTokenError(
                    err.offset, err.message, err.hint or _hint_at(statement)
                ) from None
            self.tell(err.offset, err.message, err.hint or _hint_at(statement))
        return statement

    def _expected_end(self, statement: Statement) -> str:
        if isinstance(statement, ExpressionStatement) and isinstance(statement.expression, Name):
            return ":=' or ';"
        return ";"

    # Statements with a body.

    def _body(self, end: str) -> list[Statement]:
        self.enter()
        self._open.append(end)
        found = self.statements()
        self._open.pop()
        self.leave()
        return found

    def _if(self) -> Statement:
        at = self.index
        arms: list[Arm] = []
        other: list[Statement] | None = None
        while True:
            arms.append(self._arm())
            if self.keys[self.index] != "ELSIF":
                break
        if self.keys[self.index] == "ELSE":
            self.index += 1
            other = self._body("END_IF")
        self.close("END_IF", at)
        return IfStatement(at, arms, other)

    def _arm(self) -> Arm:
        """Parse IF or ELSIF, its condition, and its statements."""
        at = self.index
        self.index += 1
        condition = self._before("THEN", "after the condition")
        return Arm(at, condition, self._body("END_IF"))

    def _before(self, word: str, context: str) -> Expression:
        """Parse an expression and THEN, DO or OF behind it; after an error go on behind the word.

        Raises:
            UnexpectedTokenError: the word is not in the statement, and no new line begins.
        """
        start, depth = self.index, self.depth
        try:
            found = self.expression()
            if self.keys[self.index] == ":=":
                self.fail(f"expected '{word}' {context}", "'=' compares, ':=' assigns")
            if self.keys[self.index] != word:
                self.fail_before(f"expected '{word}' {context}")
        except UnexpectedTokenError as err:
            if not self._finds(word):
                raise
            self.tell(err.offset, err.message, err.hint)
            self.depth = depth
            return Name(start, "")
        self.index += 1
        return found

    def _finds(self, word: str) -> bool:
        """Step behind ``word`` if it follows before a semicolon; stay where a new line begins."""
        keys = self.keys
        index = self.index
        while keys[index] not in _RECOVERY and keys[index] not in (";", word, ""):
            index += 1
        if keys[index] == word:
            self.index = index + 1
            return True
        return "\n" in self.trivia[self.index] and keys[self.index] not in OPERATORS

    def _case(self) -> Statement:
        at = self.index
        self.index += 1
        selector = self._before("OF", "after the selector of CASE")
        self.enter()
        self._open.append("END_CASE")
        elements = self._case_elements()
        other = self._case_other()
        self._open.pop()
        self.leave()
        self.close("END_CASE", at)
        return CaseStatement(at, selector, elements, other)

    def _case_elements(self) -> list[CaseElement]:
        elements: list[CaseElement] = []
        while True:
            key = self.keys[self.index]
            if key == ";":
                self.index += 1
            elif key not in _STOPS or self._is_name(key):
                elements.append(self._case_element())
            elif self._ends_list(key):
                return elements
            else:
                self._skip_stray(key)

    def _case_other(self) -> list[Statement] | None:
        if self.keys[self.index] != "ELSE":
            return None
        self.index += 1
        if self.keys[self.index] == ":":
            self.index += 1
        return self.statements()

    def _case_element(self) -> CaseElement:
        """Parse labels and statements; after an error in the labels the statements alone."""
        at, depth = self.index, self.depth
        labels: list[tuple[Expression, Expression | None]] = []
        try:
            labels.append(self._case_label())
            while self.accept(","):
                labels.append(self._case_label())
            self.expect(":", "after the labels of a CASE element")
        except UnexpectedTokenError as err:
            self.tell(err.offset, err.message, err.hint)
            self.depth = depth
            self._recover_statement(at)
        return CaseElement(at, labels, self.statements())

    def _case_label(self) -> tuple[Expression, Expression | None]:
        low = self.expression()
        if self.keys[self.index] != "..":
            return low, None
        self.index += 1
        return low, self.expression()

    def _starts_label(self, key: str) -> bool:
        """Return True where a label of a CASE begins, not a statement."""
        if key == "literal" or key in ("-", "+"):
            return True
        if key in _NO_LABELS or (key in _STOPS and not self._is_name(key)):
            return False
        keys = self.keys
        place = self.index + 1
        while keys[place] not in _LABEL_SCAN_ENDS:
            place += 1
        return keys[place] in _LABEL_SIGNS

    def _for(self) -> Statement:
        at = self.index
        depth = self.depth
        try:
            variable, first, last, step = self._for_head()
        except UnexpectedTokenError as err:
            if not self._finds("DO"):
                raise
            self.tell(err.offset, err.message, err.hint)
            self.depth = depth
            variable, first, last, step = Name(at, ""), Name(at, ""), Name(at, ""), None
        body = self._body("END_FOR")
        self.close("END_FOR", at)
        return ForStatement(at, variable, first, last, step, body)

    def _for_head(self) -> tuple[Expression, Expression, Expression, Expression | None]:
        self.index += 1
        self._operators = 0
        variable = self._operand()
        self.expect(":=", "after the variable of FOR")
        first = self.expression()
        self.expect("TO", "after the first value of FOR")
        last = self.expression()
        step = self.expression() if self.accept("BY") else None
        if self.keys[self.index] != "DO":
            self.fail_before("expected 'DO' after the values of FOR")
        self.index += 1
        return variable, first, last, step

    def _while(self) -> Statement:
        at = self.index
        self.index += 1
        condition = self._before("DO", "after the condition")
        body = self._body("END_WHILE")
        self.close("END_WHILE", at)
        return WhileStatement(at, condition, body)

    def _repeat(self) -> Statement:
        at = self.index
        self.index += 1
        body = self._body("END_REPEAT")
        if self.keys[self.index] == "END_REPEAT":
            self.tell(self.here(), "expected UNTIL and a condition before END_REPEAT")
            self.index += 1
            return RepeatStatement(at, body, Name(at, ""))
        self.expect("UNTIL", "after the statements of REPEAT")
        condition = self.expression()
        while self.accept(";"):
            pass
        self.close("END_REPEAT", at)
        return RepeatStatement(at, body, condition)

    def _exit(self) -> Statement:
        self.index += 1
        return self._ended(ExitStatement(self.index - 1))

    def _continue(self) -> Statement:
        self.index += 1
        return self._ended(ContinueStatement(self.index - 1))

    def _return(self) -> Statement:
        self.index += 1
        return self._ended(ReturnStatement(self.index - 1))

    def _jump(self) -> Statement:
        at = self.index
        self.index += 1
        return self._ended(JumpStatement(at, self.expect_name("of a label after JMP")))


_RULES: dict[str, Callable[[StatementParser], Statement]] = {
    "IF": StatementParser._if,
    "CASE": StatementParser._case,
    "FOR": StatementParser._for,
    "WHILE": StatementParser._while,
    "REPEAT": StatementParser._repeat,
    "EXIT": StatementParser._exit,
    "CONTINUE": StatementParser._continue,
    "RETURN": StatementParser._return,
    "JMP": StatementParser._jump,
}


_INSTRUCTION_LIST = frozenset(
    ["LD", "LDN", "ST", "STN", "S", "R", "AND", "ANDN", "OR", "ORN", "ADD", "SUB", "CAL", "CALC"]
)
_EXCEPTIONS = frozenset(["__TRY", "__CATCH", "__FINALLY", "__ENDTRY"])


def _hint_at(statement: Statement) -> str:
    """Return what a statement that is no more than a name may be of another language."""
    name = statement.expression if isinstance(statement, ExpressionStatement) else None
    word = name.name.upper() if isinstance(name, Name) else ""
    if word in _EXCEPTIONS:
        return f"{word} of CODESYS is not supported"
    return "Instruction List has files of its own: .il" if word in _INSTRUCTION_LIST else ""
