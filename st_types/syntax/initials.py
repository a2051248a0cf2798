"""Parser of initial values: expressions, ``[...]`` of arrays, ``(name := ...)`` of structures."""

from __future__ import annotations

from typing import TYPE_CHECKING

from st_types.syntax.expressions import POSTFIXES, Call, ExpressionParser, Literal, Name
from st_types.syntax.literals import MAX_DIGITS, parse_literal
from st_types.syntax.tree import ArrayInitial, MemberInitial, RepeatedInitial, StructInitial

if TYPE_CHECKING:
    from st_types.syntax.expressions import Expression
    from st_types.syntax.tree import Initial

_ENDS = frozenset([";", ",", "]", ")", ".."])
_NO_NAMES = frozenset(["TRUE", "FALSE"])
_PATH = POSTFIXES - {"("}
"""What may follow an operand where no function is called."""


class InitialParser(ExpressionParser):
    """Parses initial values."""

    def expression(self) -> Expression:
        """Parse one expression; in declarations most are one number or one name.

        Raises:
            UnexpectedTokenError: there is none here, or it is nested too deep or too long.
        """
        index, texts = self.index, self.texts
        if texts[index + 1] in _ENDS:
            text = texts[index]
            if text.isdecimal() and text.isascii() and len(text) <= MAX_DIGITS:
                self.index = index + 1
                return Literal(index, text, parse_literal(text))
            if text.isidentifier() and text.isascii() and text.upper() not in _NO_NAMES:
                self.index = index + 1
                return Name(index, text)
        return super().expression()

    def initial(self) -> Initial:
        """Parse what follows ``:=`` in a declaration.

        The brackets of an array may be left out, as in older files: ``:= 1, 2, 3(0);``.

        Raises:
            UnexpectedTokenError: there is no value here.
        """
        at = self.index
        first = self._initial_item(may_call=True)
        if isinstance(first, Call) or (self.text != "," and not isinstance(first, RepeatedInitial)):
            return first
        items: list[Initial] = [first]
        while self.accept(","):
            items.append(self._initial_item(may_call=False))
        return ArrayInitial(at, items)

    def _initial_item(self, *, may_call: bool) -> Initial:
        """Parse a value; ``may_call`` is False in lists, where ``N + 1(0)`` repeats the 0."""
        at, text = self.index, self.text
        if text == "[":
            return self._array_initial()
        if text == "(" and self._starts_members():
            return self._struct_initial()
        outer, self.postfixes = self.postfixes, POSTFIXES if may_call else _PATH
        try:
            value = self.expression()
        finally:
            self.postfixes = outer
        return self._repeated_initial(at, value) if self.text == "(" else value

    def _starts_members(self) -> bool:
        after = self.texts[self.index + 1 : self.index + 3]
        return after[0] == ")" or after[1] == ":="

    def _array_initial(self) -> ArrayInitial:
        at = self._open_initial()
        items = self._initials("]")
        self.leave()
        return ArrayInitial(at, items)

    def _open_initial(self) -> int:
        self.enter()
        self.index += 1
        return self.index - 1

    def _initials(self, closing: str) -> list[Initial]:
        items: list[Initial] = []
        while not self.accept(closing):
            if items:
                self.expect(",", f"or '{closing}' after an initial value")
                if self.accept(closing):
                    break
            items.append(self._initial_item(may_call=False))
        return items

    def _repeated_initial(self, at: int, count: Expression) -> RepeatedInitial:
        """Parse what stands in the parentheses behind the ``count`` at token ``at``."""
        if self._starts_members() and self.texts[self.index + 1] != ")":
            return RepeatedInitial(at, count, [self._struct_initial()])
        self._open_initial()
        items = self._initials(")")
        self.leave()
        return RepeatedInitial(at, count, items)

    def _struct_initial(self) -> StructInitial:
        at = self._open_initial()
        members: list[MemberInitial] = []
        while not self.accept(")"):
            if members:
                self.expect(",", "or ')' after the value of a member")
                if self.accept(")"):
                    break
            members.append(self._member_initial())
        self.leave()
        return StructInitial(at, members)

    def _member_initial(self) -> MemberInitial:
        at = self.index
        name = self.expect_name("of a member")
        self.expect(":=", f"after the name of the member {name}")
        return MemberInitial(at, name, self._initial_item(may_call=True))
