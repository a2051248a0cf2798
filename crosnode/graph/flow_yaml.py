"""Values as people type them for rostopic: YAML in its flow style, which JSON is a part of.

``{joint_names: [a, b], points: [{positions: [1, 2]}]}``: names and texts need no quotes. What YAML
has beside that, such as blocks of lines, tags and anchors, is not read. Source: YAML 1.2, chapter
7.4, and the core schema (10.3) for what a plain text stands for.
"""

from __future__ import annotations

import json
import re
from typing import Final, TypeAlias

Value: TypeAlias = bool | int | float | str | list[object] | dict[str, object] | None

_SPACE: Final = re.compile(r"\s*")
_PLAIN: Final = re.compile(
    r"(?:[^\s,:{}\[\]\"'#]|:(?=[^\s,{}\[\]]))(?:[^,:{}\[\]]|:(?=[^\s,{}\[\]]))*"
)
_SINGLE: Final = re.compile(r"'((?:[^']|'')*)'")
_INTEGER: Final = re.compile(r"[-+]?\d{1,20}", re.ASCII)
_FLOAT: Final = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
_WORDS: Final[dict[str, Value]] = {
    "true": True,
    "false": False,
    "null": None,
    "~": None,
    ".nan": "NaN",
    ".inf": "Infinity",
    "-.inf": "-Infinity",
}
"""What words stand for; floats that JSON has not are its texts for them."""

_DECODER: Final = json.JSONDecoder()


def parse_flow(text: str) -> Value:
    """Return the value that a text stands for.

    Raises:
        ValueError: it is not one value, with the place where it goes wrong.
        RecursionError: it is nested too deeply.
    """
    reader = _Reader(text)
    value = reader.value()
    reader.end()
    return value


class _Reader:
    def __init__(self, text: str) -> None:
        self._text = text
        self._at = 0
        self._skip(_SPACE)

    def end(self) -> None:
        if self._at < len(self._text):
            raise self._expected("the end")

    def _expected(self, what: str) -> ValueError:
        found = self._text[self._at : self._at + 20]
        got = repr(found) if found else "the end"
        return ValueError(f"expected {what} at character {self._at + 1}, got {got}")

    def _is_at(self, mark: str) -> bool:
        return self._text.startswith(mark, self._at)

    def value(self) -> Value:
        if self._take("{"):
            return self._members()
        if self._take("["):
            return self._elements()
        return self._scalar()

    def _members(self) -> dict[str, object]:
        found: dict[str, object] = {}
        while not self._take("}"):
            name = self._text_of_name()
            if not self._take(":"):
                raise self._expected("':'")
            found[name] = self.value()
            self._end_of_part("}")
        return found

    def _elements(self) -> list[object]:
        found: list[object] = []
        while not self._take("]"):
            found.append(self.value())
            self._end_of_part("]")
        return found

    def _end_of_part(self, end: str) -> None:
        if not self._take(",") and not self._is_at(end):
            raise self._expected(f"',' or {end!r}")

    def _text_of_name(self) -> str:
        start = self._at
        name = self._scalar()
        return name if isinstance(name, str) else self._text[start : self._at].strip()

    def _scalar(self) -> Value:
        if self._is_at('"'):
            value, self._at = _DECODER.raw_decode(self._text, self._at)
            self._skip(_SPACE)
            return str(value)
        if single := self._skip(_SINGLE):
            self._skip(_SPACE)
            return single[1].replace("''", "'")
        if plain := self._skip(_PLAIN):
            return plain_value(plain[0].strip())
        raise self._expected("a value")

    def _take(self, mark: str) -> bool:
        if not self._is_at(mark):
            return False
        self._at += len(mark)
        self._skip(_SPACE)
        return True

    def _skip(self, pattern: re.Pattern[str]) -> re.Match[str] | None:
        found = pattern.match(self._text, self._at)
        if found:
            self._at = found.end()
        return found


def plain_value(text: str) -> Value:
    """Return what a text without quotes stands for: a number, a word such as true, or itself."""
    if text.lower() in _WORDS:
        return _WORDS[text.lower()]
    if _INTEGER.fullmatch(text):
        return int(text)
    if _FLOAT.fullmatch(text):
        return float(text)
    return text
