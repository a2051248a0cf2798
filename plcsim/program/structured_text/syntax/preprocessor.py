"""Preprocessor lines of Automation Studio: ``#if``, ``#ifdef``, ``#define``, ``#error`` and so on.

They work on tokens: what a condition leaves out is taken away, the name of a macro is replaced by
its tokens, and every token keeps its place in the text. ``#include`` between units is left to the
parser. Macros with parameters are refused.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from plcsim.program.structured_text.syntax.condition import (
    MAX_NESTING,
    ConditionError,
    evaluate_condition,
)
from st_types.syntax.lexer import MAX_TOKENS, Tokens
from st_types.syntax.source import Source

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from st_types.syntax.diagnostics import DiagnosticLog

_LINE = re.compile(r"#[ \t]*(\w+)[ \t]*(.*)", re.DOTALL)
_COMMENT = re.compile(r"//.*|\(\*.*?(?:\*\)|$)|/\*.*?(?:\*/|$)", re.DOTALL)
_DEFINITION = re.compile(r"([A-Za-z_]\w*)(\(?)(.*)", re.DOTALL | re.ASCII)
_IGNORED = frozenset(["pragma", "warning", "line", "region", "endregion"])


class _Branch(NamedTuple):
    """An ``#if`` that is open.

    Attributes:
        offset: its place in the text.
        outer: what lies around it is kept.
        kept: what follows is kept.
        done: one of its branches was kept already.
        has_else: its ``#else`` was seen.
    """

    offset: int
    outer: bool
    kept: bool
    done: bool
    has_else: bool = False


def preprocess(tokens: Tokens, defines: Mapping[str, str], diagnostics: DiagnosticLog) -> None:
    """Carry out the preprocessor lines in ``tokens``; errors go to ``diagnostics``."""
    _Preprocessor(tokens, defines, diagnostics).run()


class _Preprocessor:
    def __init__(
        self, tokens: Tokens, defines: Mapping[str, str], diagnostics: DiagnosticLog
    ) -> None:
        self._tokens = tokens
        self._diagnostics = diagnostics
        self._macros = {name: _lexed(text) for name, text in defines.items()}
        self._branches: list[_Branch] = []
        self._kept = True
        self._offset = 0
        self._chosen: list[tuple[int, str]] = []

    def run(self) -> None:
        macros = self._macros
        for index in range(self._tokens.end):
            text = self._tokens.texts[index]
            if text[:1] == "#" and len(text) > 1:
                self._line(index, text)
            elif self._kept:
                if text in macros:
                    self._replace(index, text, frozenset())
                else:
                    self._chosen.append((index, text))
        for branch in self._branches:
            self._diagnostics.error(branch.offset, "this #if has no #endif")
        self._tokens.select(self._chosen)

    def _replace(self, index: int, name: str, inside: frozenset[str]) -> None:
        """Put the tokens of a macro in the place of its name; in itself it is a plain name."""
        if len(inside) > MAX_NESTING or len(self._chosen) >= MAX_TOKENS:
            self._offset = self._tokens.offset(index)
            self._error(f"the macros behind {name} are nested too deep or too long")
            self._macros.clear()  # once is enough
            return
        for text in self._macros.get(name, ()):
            if text in self._macros and text != name and text not in inside:
                self._replace(index, text, inside | {name})
            else:
                self._chosen.append((index, text))

    def _line(self, index: int, text: str) -> None:
        self._offset = self._tokens.offset(index)
        match = _LINE.match(text)
        assert match is not None
        word, rest = match.group(1).lower(), _COMMENT.sub("", match.group(2)).strip()
        rule = _RULES.get(word)
        if rule is not None:
            rule(self, rest)
        elif not self._kept or word in _IGNORED:
            return
        elif word == "include":
            self._chosen.append((index, f"#include {rest}"))
        else:
            self._error(f"#{word} is no preprocessor line")

    def _error(self, message: str, hint: str = "") -> None:
        self._diagnostics.error(self._offset, message, hint)

    def _if(self, condition: str) -> None:
        self._open(self._kept and self._holds(condition))

    def _ifdef(self, name: str) -> None:
        self._open(name in self._macros)

    def _ifndef(self, name: str) -> None:
        self._open(name not in self._macros)

    def _open(self, holds: bool) -> None:  # the result of a condition
        kept = self._kept and holds
        self._branches.append(_Branch(self._offset, self._kept, kept, kept))
        self._kept = kept

    def _holds(self, condition: str) -> bool:
        try:
            return evaluate_condition(condition, self._value)
        except ConditionError as err:
            self._error(str(err))
            return False

    def _value(self, name: str) -> str | None:
        tokens = self._macros.get(name)
        return None if tokens is None else " ".join(tokens)

    def _elif(self, condition: str) -> None:
        branch = self._innermost("#elif")
        if branch is not None:
            wanted = branch.outer and not branch.done
            self._next_branch(branch, kept=wanted and self._holds(condition), has_else=False)

    def _else(self, _rest: str) -> None:
        branch = self._innermost("#else")
        if branch is not None:
            self._next_branch(branch, kept=branch.outer and not branch.done, has_else=True)

    def _innermost(self, word: str) -> _Branch | None:
        if self._branches and not self._branches[-1].has_else:
            return self._branches[-1]
        self._error(f"{word} without #if")
        return None

    def _next_branch(self, branch: _Branch, *, kept: bool, has_else: bool) -> None:
        self._branches[-1] = branch._replace(kept=kept, done=branch.done or kept, has_else=has_else)
        self._kept = kept

    def _endif(self, _rest: str) -> None:
        if self._branches:
            self._kept = self._branches.pop().outer
        else:
            self._error("#endif without #if")

    def _define(self, rest: str) -> None:
        if not self._kept:
            return
        match = _DEFINITION.fullmatch(rest)
        if match is None:
            self._error("expected a name after #define")
        elif match.group(2):
            self._error(f"{match.group(1)}: a macro with parameters is not supported")
        else:
            self._macros[match.group(1)] = _lexed(match.group(3))

    def _undef(self, name: str) -> None:
        if self._kept:
            self._macros.pop(name, None)

    def _fail(self, message: str) -> None:
        if self._kept:
            self._error(f"#error {message}")


def _lexed(text: str) -> list[str]:
    tokens = Tokens(Source("", text))
    return tokens.texts[: tokens.end]


_RULES: dict[str, Callable[[_Preprocessor, str], None]] = {
    "if": _Preprocessor._if,
    "ifdef": _Preprocessor._ifdef,
    "ifndef": _Preprocessor._ifndef,
    "elif": _Preprocessor._elif,
    "else": _Preprocessor._else,
    "endif": _Preprocessor._endif,
    "define": _Preprocessor._define,
    "undef": _Preprocessor._undef,
    "error": _Preprocessor._fail,
}
