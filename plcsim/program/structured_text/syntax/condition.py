"""Conditions of ``#if``: integers, names of macros, ``defined(NAME)`` and the operators of C."""

from __future__ import annotations

import operator
import re
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

MAX_NESTING = 32
"""Deepest nesting of brackets, and of macros that name macros."""

_WORD = re.compile(r"\s*(0[xX][0-9a-fA-F]+|\d+|[A-Za-z_]\w*|\|\||&&|[=!<>]=|[-+*/%<>!()~&|^])")
_LEVELS: tuple[dict[str, Callable[[int, int], int]], ...] = (
    {"||": lambda a, b: int(bool(a) or bool(b))},
    {"&&": lambda a, b: int(bool(a) and bool(b))},
    {"|": operator.or_, "^": operator.xor, "&": operator.and_},
    {"==": operator.eq, "!=": operator.ne},
    {"<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge},
    {"+": operator.add, "-": operator.sub},
    {"*": operator.mul, "/": operator.floordiv, "%": operator.mod},
)


class ConditionError(Exception):
    """The condition cannot be evaluated; the message says why."""


def evaluate_condition(text: str, value_of: Callable[[str], str | None], depth: int = 0) -> bool:
    """Return whether the condition ``text`` holds.

    Args:
        text: what follows ``#if``.
        value_of: gives the text of a macro, None for a name that is none; that counts as 0.
        depth: how many macros lead here.

    Raises:
        ConditionError: it is no condition.
    """
    return _Condition(text, value_of, depth).value() != 0


class _Condition:
    def __init__(self, text: str, value_of: Callable[[str], str | None], depth: int) -> None:
        self._words = _split(text)
        self._value_of = value_of
        self._depth = depth
        self._index = 0

    def value(self) -> int:
        found = self._level(0)
        if self._next():
            raise ConditionError(f"expected an operator in the condition, found '{self._next()}'")
        return found

    def _next(self) -> str:
        return self._words[self._index]

    def _step(self) -> str:
        self._index += 1
        return self._words[self._index - 1]

    def _level(self, level: int) -> int:
        if level == len(_LEVELS):
            return self._operand()
        found = self._level(level + 1)
        while self._next() in _LEVELS[level]:
            rule = _LEVELS[level][self._step()]
            try:
                found = int(rule(found, self._level(level + 1)))
            except ZeroDivisionError:
                raise ConditionError("division by zero in the condition") from None
        return found & 0xFFFF_FFFF_FFFF_FFFF if found >= 0 else found

    def _operand(self) -> int:
        word = self._step()
        if word in ("!", "-", "+", "~", "("):
            return self._nested(word)
        if word[:1].isdigit():
            return int(word, 0) if word[:2] in ("0x", "0X") else int(word)
        if word == "defined":
            return self._defined()
        if not word.isidentifier():
            raise ConditionError(f"expected a value in the condition, found '{word}'")
        return self._macro(word)

    def _nested(self, word: str) -> int:
        self._depth += 1
        if self._depth > MAX_NESTING:
            raise ConditionError(f"the condition is nested more than {MAX_NESTING} levels deep")
        found = self._level(0) if word == "(" else self._operand()
        self._depth -= 1
        if word == "(" and self._step() != ")":
            raise ConditionError("expected ')' in the condition")
        return {"!": int(not found), "-": -found, "~": ~found}.get(word, found)

    def _defined(self) -> int:
        has_bracket = self._next() == "("
        if has_bracket:
            self._step()
        name = self._step()
        if not name.isidentifier() or (has_bracket and self._step() != ")"):
            raise ConditionError("expected a name after defined")
        return int(self._value_of(name) is not None)

    def _macro(self, name: str) -> int:
        text = self._value_of(name)
        if not text:
            return 0
        if self._depth >= MAX_NESTING:
            raise ConditionError(f"the macro {name} leads back to itself")
        return _Condition(text, self._value_of, self._depth + 1).value()


def _split(text: str) -> list[str]:
    words: list[str] = []
    place = 0
    text = text.strip()
    while place < len(text):
        match = _WORD.match(text, place)
        if match is None:
            odd = text[place:].lstrip()[0]
            raise ConditionError(f"'{odd}' does not belong in a condition")
        words.append(match.group(1))
        place = match.end()
    return [*words, "", ""]
