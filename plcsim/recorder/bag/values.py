"""Values of tags in the variables of a record."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.tag import leaves
from st_types.types.values import decode
from st_types.writers.value_text import value_text

if TYPE_CHECKING:
    from plcsim.core.tag import Tag
    from plcsim.recorder.bag.head import Head


def first_difference(head: Head, one: bytes, other: bytes) -> tuple[str, str, str]:
    """Return the first tag whose value differs, with both values as text."""
    for area, start in head.starts().items():
        for leaf in leaves(area):
            place = start + leaf.address - area.address
            here, there = (each[place : place + leaf.data_type.size] for each in (one, other))
            if here != there:
                return leaf.path, text_of(leaf, here), text_of(leaf, there)
    return "a byte between two variables", "one", "another"


def text_of(tag: Tag, data: bytes) -> str:
    """Return the value with these bytes as text."""
    return value_text(tag.data_type, decode(tag.data_type, data))
