"""Comments and pragmas: what stands between the tokens.

Automation Studio writes the description of a declaration as comments behind it on the same line,
and the redundancy pragmas of a block or an input before its keyword or its type.
"""

from __future__ import annotations

import re

_PIECE = re.compile(
    r"""(?P<block>\(\*.*?(?:\*\)|\Z)|/\*.*?(?:\*/|\Z)) | (?P<line>//[^\r\n]*)
      | (?P<pragma>\{[^{}]*\}) | (?P<end>\r\n?|\n)""",
    re.VERBOSE | re.DOTALL,
)


def comments_before(trivia: str) -> tuple[str, ...]:
    """Return the comments on lines of their own: all but those on the line the trivia starts in."""
    return _pieces(trivia, _COMMENTS, own_line=True)


def comments_behind(trivia: str) -> tuple[str, ...]:
    """Return the comments on the line the trivia starts in, as they are written."""
    return _pieces(trivia, _COMMENTS, own_line=False)


def notes_before(trivia: str) -> tuple[str, ...]:
    """Return comments and pragmas as `comments_before` does."""
    return _pieces(trivia, _NOTES, own_line=True)


def notes_behind(trivia: str) -> tuple[str, ...]:
    """Return comments and pragmas as `comments_behind` does."""
    return _pieces(trivia, _NOTES, own_line=False)


def pragmas_behind(trivia: str) -> tuple[str, ...]:
    """Return the pragmas on the line the trivia starts in."""
    return _pieces(trivia, ("pragma",), own_line=False)


_COMMENTS = ("block", "line")
_NOTES = (*_COMMENTS, "pragma")


def _pieces(trivia: str, kinds: tuple[str, ...], *, own_line: bool) -> tuple[str, ...]:
    if "(*" not in trivia and "/" not in trivia and "{" not in trivia:
        return ()
    found = []
    on_own_line = False
    for piece in _PIECE.finditer(trivia):
        if piece.lastgroup == "end":
            on_own_line = True
        elif piece.lastgroup in kinds and on_own_line is own_line:
            found.append(piece.group())
    return tuple(found)


def pragmas_in(trivia: str) -> tuple[str, ...]:
    """Return the pragmas, braces included, that stand outside comments."""
    if "{" not in trivia:
        return ()
    pieces = _PIECE.finditer(trivia)
    return tuple(piece.group() for piece in pieces if piece.lastgroup == "pragma")


def open_comment(trivia: str) -> int | None:
    """Return the offset of a comment that is never closed, None if there is none."""
    if "*" not in trivia:
        return None
    pieces = list(_PIECE.finditer(trivia))
    if not pieces or pieces[-1].lastgroup != "block":
        return None
    text = pieces[-1].group()
    mark = "*)" if text[0] == "(" else "*/"
    return None if len(text) >= 4 and text.endswith(mark) else pieces[-1].start()
