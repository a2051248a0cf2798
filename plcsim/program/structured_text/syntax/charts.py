"""Parser of sequential function charts in text (IEC 61131-3, 6.7): steps and transitions.

Besides what the norm has, a STEP may hold statements, and ENTRY_ACTION and EXIT_ACTION may follow
it: so Automation Studio writes them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.syntax.statements import StatementParser
from plcsim.program.structured_text.syntax.tree import (
    ActionAssociation,
    ExpressionStatement,
    StepUnit,
    TransitionUnit,
)
from st_types.syntax.expressions import Call, Literal, Name
from st_types.syntax.reader import UnexpectedTokenError

if TYPE_CHECKING:
    from plcsim.program.structured_text.syntax.tree import Statement

TIMED: Final = frozenset(["L", "D", "SD", "DS", "SL"])
"""Qualifiers of actions that have a time."""

QUALIFIERS: Final = TIMED | {"N", "R", "S", "P", "P0", "P1"}
"""Qualifiers of actions; a name alone is N."""


class ChartParser(StatementParser):
    """Parses the elements of charts."""

    def step(self) -> StepUnit:
        """Parse a STEP or an INITIAL_STEP with what follows it, the first word being next."""
        at, key = self.index, self.keys[self.index]
        self.index += 1
        named = self.index
        name = self.expect_name(f"of a step after {key}")
        if not self.accept(":"):
            self.tell(self.here(), f"expected ':' after the name of a step, found {self.found()}")
        written = self._section("END_STEP", at)
        associations, body = self._divided(written)
        entry: list[Statement] = []
        leaving: list[Statement] = []
        while (word := self.keyword) in ("ENTRY_ACTION", "EXIT_ACTION"):
            start = self.index
            self.index += 1
            self.accept(":")
            (entry if word == "ENTRY_ACTION" else leaving).extend(
                self._section("END_ACTION", start)
            )
        return StepUnit(named, name, key == "INITIAL_STEP", associations, body, entry, leaving)

    def _section(self, end: str, at: int) -> list[Statement]:
        """Parse statements and the word ``end`` behind them, of what begins at token ``at``."""
        self._open.append(end)
        found = self.statements()
        self._open.pop()
        self.close(end, at)
        return found

    def _divided(self, written: list[Statement]) -> tuple[list[ActionAssociation], list[Statement]]:
        """Tell the associations of actions in a STEP from its statements."""
        associations: list[ActionAssociation] = []
        body: list[Statement] = []
        for each in written:
            found = self._association(each)
            if found is None:
                body.append(each)
            else:
                associations.append(found)
        return associations, body

    def _association(self, statement: Statement) -> ActionAssociation | None:
        """Return ``action(qualifier, time)`` as what it is, None for any other statement.

        Further names in the brackets, the indicators of the norm, are for people.
        """
        call = statement.expression if isinstance(statement, ExpressionStatement) else None
        if not (isinstance(call, Call) and isinstance(call.function, Name) and call.arguments):
            return None
        values = [None if each.name else each.value for each in call.arguments]
        first = values[0]
        word = first.name.upper() if isinstance(first, Name) else ""
        if word not in QUALIFIERS:
            return None
        is_timed = word in TIMED
        if is_timed and not (len(values) > 1 and values[1] is not None):
            place = self.tokens.offset(call.arguments[0].at)
            self.tell(place, f"the qualifier {word} has no time", f"action({word}, T#1s);")
            is_timed = False
        return ActionAssociation(
            call.function.at, call.function.name, word, values[1] if is_timed else None
        )

    def transition(self) -> TransitionUnit:
        """Parse a TRANSITION, which is next; after an error go on behind its end."""
        at, depth = self.index, self.depth
        try:
            return self._transition(at)
        except UnexpectedTokenError as err:
            self.tell(err.offset, err.message, err.hint)
            self.depth = depth
            while self.keys[self.index] not in ("END_TRANSITION", "STEP", "END_PROGRAM", ""):
                self.index += 1
            self.accept("END_TRANSITION")
            return TransitionUnit(at, [], [], Name(at, ""))

    def _transition(self, at: int) -> TransitionUnit:
        self.index += 1
        if self.keyword != "FROM" and self.text != "(":
            self.expect_name("of a transition, or FROM")
        priority = self._priority()
        self.expect("FROM", "before the steps of a transition")
        sources = self._steps("FROM")
        self.expect("TO", "behind the steps of a transition")
        targets = self._steps("TO")
        self.expect(":=", "before the condition of a transition")
        condition = self.expression()
        while self.accept(";"):
            pass
        self.expect("END_TRANSITION", "behind the condition of a transition")
        return TransitionUnit(at, sources, targets, condition, priority)

    def _priority(self) -> int | None:
        """Parse ``(PRIORITY := 2)`` if it is there."""
        if not self.accept("("):
            return None
        self.expect("PRIORITY", "of a transition")
        self.expect(":=", "after PRIORITY")
        found = self.expression()
        value = found.constant.value if isinstance(found, Literal) else None
        if not isinstance(value, int):
            self.fail_before("expected a number as PRIORITY")
        self.expect(")", "behind the PRIORITY")
        return value

    def _steps(self, word: str) -> list[Name]:
        """Parse the name of a step, or several in brackets."""
        if not self.accept("("):
            return [self._step_name(word)]
        found = [self._step_name(word)]
        while self.accept(","):
            found.append(self._step_name(word))
        self.expect(")", f"behind the steps of {word}")
        return found

    def _step_name(self, word: str) -> Name:
        at = self.index
        return Name(at, self.expect_name(f"of a step after {word}"))
