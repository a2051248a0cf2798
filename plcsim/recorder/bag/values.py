"""Values of tags in the variables of a record."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Final

from plcsim.core import tag
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from plcsim.core.tag import Tag
    from plcsim.recorder.bag.head import Head

MOST_NAMED: Final = 4
"""Tags that are told of a cycle that differs."""

BETWEEN: Final = "a byte between two variables"
"""Is told where two images differ, and no tag does."""


def differences(head: Head, one: bytes, other: bytes) -> list[tuple[str, str, str]]:
    """Return the tags whose value differs, with both values as text, and one more than are told."""
    found = islice(tag.differences(head.areas, one, other), MOST_NAMED + 1)
    return [(leaf.path, text_of(leaf, here), text_of(leaf, there)) for leaf, here, there in found]


def first_difference(head: Head, one: bytes, other: bytes) -> tuple[str, str, str]:
    """Return the first tag whose value differs, with both values as text."""
    found = differences(head, one, other)
    return found[0] if found else (BETWEEN, "one", "another")


def text_of(leaf: Tag, data: bytes) -> str:
    """Return the value with these bytes as text."""
    return value_text(leaf.data_type, decode(leaf.data_type, data))
