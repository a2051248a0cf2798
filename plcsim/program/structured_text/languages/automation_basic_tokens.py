"""Cutting a text of Automation Basic into the tokens that Structured Text has for the same.

A line is a statement, so its end is a token; a backslash at the end of a line goes on in the next
one. ``;`` and ``//`` begin comments. ``$1F`` and ``%101`` are numbers, ``"text"`` is a STRING.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Final

from st_types.syntax.lexer import MAX_TOKENS, Tokens

if TYPE_CHECKING:
    from collections.abc import Iterator

    from st_types.syntax.source import Source

END_OF_LINE: Final = "\n"
"""The token at the end of a line."""

_TOKEN: Final = re.compile(
    r"""
      (?P<nothing> [ \t\f\v\xa0\ufeff\x1a]+ | \\ [ \t]* (?: (?:;|//) [^\r\n]* )? (?: \r\n? | \n )
        | (?:;|//) [^\r\n]* )
    | (?P<block> \(\* .*? (?: \*\) | \Z ) )
    | (?P<line> \r\n? | \n )
    | (?P<text> " [^"\r\n]* " | ' [^'\r\n]* ' )
    | (?P<hex> \$ [0-9A-Fa-f]+ )
    | (?P<bits> % [01]+ )
    | (?P<other> [A-Za-z_] \w* \# [\w.+:-]* | [A-Za-z_] \w* | \d+ \# \w+
        | \d [\d_]* (?: \. \d+ )? (?: [eE] [+-]? \d+ )?
        | := | <> | <= | >= | => | \.\. | \*\* | . )
    """,
    re.VERBOSE | re.DOTALL | re.ASCII,
)


def basic_tokens(source: Source) -> Tokens:
    """Return the tokens of a text, at most `MAX_TOKENS`: ``truncated`` tells of more."""
    found: list[tuple[int, str]] = []
    for each in _cut(source.text):
        if len(found) == MAX_TOKENS:
            break
        found.append(each)
    tokens = Tokens.placed(source, found)
    tokens.truncated = len(found) == MAX_TOKENS
    return tokens


def _cut(text: str) -> Iterator[tuple[int, str]]:
    for match in _TOKEN.finditer(text):
        kind, found = match.lastgroup, match.group()
        if kind == "line" or (kind == "block" and ("\n" in found or "\r" in found)):
            yield match.start(), END_OF_LINE
        elif kind == "text":
            yield match.start(), f"'{_escaped(found[1:-1])}'"
        elif kind == "hex":
            yield match.start(), f"16#{found[1:]}"
        elif kind == "bits":
            yield match.start(), f"2#{found[1:]}"
        elif kind == "other":
            yield match.start(), found


def _escaped(text: str) -> str:
    """Return what stands for a text in a literal of Structured Text, where ``$`` is a sign."""
    return text.replace("$", "$$").replace("'", "$'")
