"""Conditions of tests: a tag, a mapping of tags to values, or a function."""

from __future__ import annotations

import linecache
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING

from plcsim.library.value_text import text_of
from plcsim.testing.errors import PlcTestError
from st_types.types.values import decode

if TYPE_CHECKING:
    from types import CodeType

    from plcsim.testing.tags import Tags

__tracebackhide__ = True

Given = str | Mapping[str, object] | Callable[[], object]
"""What a test may give as a condition."""


class Condition:
    """Something that holds or not after a cycle.

    Args:
        given: path of a tag that is to be TRUE (or not 0), a mapping of tags to the values that
            they are all to have, or a function without arguments that answers whether it holds.
        tags: where the tags are read.

    Attributes:
        text: the condition in words.
        paths: tags that it has read so far.
    """

    def __init__(self, given: Given, tags: Tags) -> None:
        self._tags = tags
        self.paths: dict[str, None] = {}
        if isinstance(given, str):
            tags.find(given)
            self.text = given
            self._holds: Callable[[], object] = lambda: tags[given]
        elif isinstance(given, Mapping):
            wanted = {path: self._wanted(path, value) for path, value in given.items()}
            self.text = " and ".join(self._equation(*item) for item in given.items())
            self._holds = lambda: all(tags.peek(path) == value for path, value in wanted.items())
            self.paths = dict.fromkeys(given)
        elif callable(given):
            self.text = source_of(given)
            self._holds = given
        else:
            raise PlcTestError(
                f"{given!r} is no condition: give a tag, {{tag: value}} or a function"
            )

    def _wanted(self, path: str, value: object) -> object:
        """Return a value as the tag would hold it: REAL rounded, an enumeration's name resolved."""
        return decode(self._tags.find(path).data_type, self._tags.encode(path, value))

    def _equation(self, path: str, value: object) -> str:
        data_type = self._tags.find(path).data_type
        return f"{path} = {text_of(data_type, value)}"

    def holds(self) -> bool:
        """Whether the condition holds now; notes which tags it reads."""
        with self._tags.noting(self.paths):
            return bool(self._holds())


def source_of(function: Callable[..., object]) -> str:
    """Return the text of a lambda's expression, or the name of another function."""
    code: CodeType | None = getattr(function, "__code__", None)
    name = getattr(function, "__name__", repr(function))
    if code is None or name != "<lambda>":
        return name
    places = [p for p in code.co_positions() if None not in p]
    lines = {p[0] for p in places} | {p[1] for p in places}
    line = linecache.getline(code.co_filename, code.co_firstlineno)
    columns = [(p[2], p[3]) for p in places if p[2] is not None and p[3] is not None and p[3] > 0]
    if lines != {code.co_firstlineno} or not columns or not line:
        return f"the condition at line {code.co_firstlineno}"
    data = line.encode()
    return data[min(c[0] for c in columns) : max(c[1] for c in columns)].decode()
