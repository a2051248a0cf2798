"""Tags that become messages whenever they change, many of the same size at once."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from plcsim.recorder.bag.files import Bag
    from plcsim.recorder.bag.types import TagMessages


def equally_long(tags: Iterable[TagMessages]) -> list[list[TagMessages]]:
    """Return tags by their size; strings, whose messages are otherwise long, by themselves."""
    found: dict[tuple[bool, int], list[TagMessages]] = defaultdict(list)
    for tag in tags:
        found[tag.encode is None, tag.size].append(tag)
    return list(found.values())


class TagBlock:
    """Tags of one size in one bag.

    Args:
        tags: whose bytes are all their message, or none's are.
    """

    def __init__(self, tags: Sequence[TagMessages]) -> None:
        self._tags = tags
        starts = np.array([tag.start for tag in tags])
        self._places = starts[:, np.newaxis] + np.arange(tags[0].size)
        self._shown = np.empty((0, tags[0].size), np.uint8)
        self._channels: list[Any] = []

    def write(self, bag: Bag, bag_ns: int, variables: bytes) -> None:
        """Write what has changed.

        Args:
            bag: always the same.
            bag_ns: time in the bag.
            variables: all of them.
        """
        rows = np.frombuffer(variables, np.uint8)[self._places]
        if not self._channels:
            self._channels = [bag.add(tag.topic, tag.type_name) for tag in self._tags]
            changed = np.arange(len(rows))
        else:
            (changed,) = (rows != self._shown).any(axis=1).nonzero()
        self._shown = rows
        if not len(changed):
            return
        channels = [self._channels[place] for place in changed.tolist()]
        if self._tags[0].encode is None:
            bag.write_rows(bag_ns, channels, rows[changed])
            return
        tags = [self._tags[place] for place in changed.tolist()]
        told = [tag.message(row.tobytes()) for tag, row in zip(tags, rows[changed], strict=True)]
        bag.write(bag_ns, list(zip(channels, told, strict=True)))
