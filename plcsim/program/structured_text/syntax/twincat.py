"""The Structured Text in a file of TwinCAT: .TcPOU, .TcGVL, .TcDUT and .TcIO are XML around it.

A unit lies there in pieces: its declaration, its statements, its methods. What stands between is
replaced by the keywords that a text has in its place; lines and columns stay those of the file.
"""

from __future__ import annotations

import re
from typing import Final

from plcsim.program.structured_text.names import TWINCAT_MARK

_PIECE: Final = re.compile(r"<!\[CDATA\[(.*?)\]\]>|<(/?)(\w+)([^<>]*)>", re.DOTALL)
_NAME: Final = re.compile(r'\bName="(\w+)"')
_KEYWORD: Final = re.compile(r"\b(PROGRAM|FUNCTION_BLOCK|FUNCTION|INTERFACE)\b", re.IGNORECASE)
_DRAWN: Final = frozenset(["FBD", "LD", "SFC", "CFC", "NWL", "IL"])
_ENDS: Final = {
    "Method": "END_METHOD",
    "Property": "END_PROPERTY",
    "Get": "END_GET",
    "Set": "END_SET",
    "Action": "END_ACTION",
}
_STARTS: Final = {"Get": "GET", "Set": "SET"}


def is_twincat(text: str) -> bool:
    """Return whether a text is a file of TwinCAT."""
    return TWINCAT_MARK in text[:400]


def text_of(xml: str) -> str:
    """Return the Structured Text in a file of TwinCAT."""
    parts: list[str] = []
    offset = 0
    unit = ""
    for match in _PIECE.finditer(xml):
        parts.append(_blank(xml[offset : match.start()]))
        offset = match.end()
        code, closes, tag, attributes = match.groups()
        if code is not None:
            if not unit and (keyword := _KEYWORD.search(code)):
                unit = keyword.group().upper()
            parts.append(f"{' ' * len('<![CDATA[')}{code}   ")
            continue
        word = _word(tag, attributes, unit, is_end=bool(closes))
        parts.append(word + _blank(match.group())[len(word) :])
    return "".join(parts) + _blank(xml[offset:])


def _word(tag: str, attributes: str, unit: str, *, is_end: bool) -> str:
    """Return the keyword that a text has where the tag stands, mostly nothing."""
    if is_end:
        return f" END_{unit} " if tag in ("POU", "Itf") and unit else f" {_ENDS.get(tag, '')} "
    if tag == "Action":
        name = _NAME.search(attributes)
        return f" ACTION {name.group(1) if name else ''}: "
    if tag in _DRAWN:
        return f" {tag}_is_drawn_and_not_Structured_Text; "
    return f" {_STARTS.get(tag, '')} "


def _blank(text: str) -> str:
    """Return blanks in place of a text, its line ends kept."""
    return re.sub(r"[^\r\n]", " ", text)
