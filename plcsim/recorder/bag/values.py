"""Values of tags in the variables of a record."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core import tag
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from plcsim.core.tag import Tag
    from plcsim.recorder.bag.head import Head


def first_difference(head: Head, one: bytes, other: bytes) -> tuple[str, str, str]:
    """Return the first tag whose value differs, with both values as text."""
    found = tag.first_difference(head.areas, one, other)
    if found is None:
        return "a byte between two variables", "one", "another"
    leaf, here, there = found
    return leaf.path, text_of(leaf, here), text_of(leaf, there)


def text_of(leaf: Tag, data: bytes) -> str:
    """Return the value with these bytes as text."""
    return value_text(leaf.data_type, decode(leaf.data_type, data))
