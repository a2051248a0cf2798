"""Tags that keep a value whatever the programs and the plant do, and tags that go wrong."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.testing.errors import PlcTestError
from plcsim.testing.values import is_number
from st_types.types.derived import SubrangeType
from st_types.types.elementary import ElementaryType, Kind

if TYPE_CHECKING:
    from random import Random

    from plcsim.core import forces as core
    from plcsim.core.tag import Tag
    from plcsim.testing.tags import Tags

__tracebackhide__ = True


class TagForces:
    """The forced tags of the controller under test, by path."""

    def __init__(self, tags: Tags, forces: core.Forces) -> None:
        self._tags = tags
        self._forces = forces

    def force(self, path: str, value: object) -> None:
        """Force a tag from now on.

        Raises:
            TagError: there is no such tag, or it cannot take the value.
        """
        self._forces.force(self._tags.find(path), self._tags.encode(path, value), "the test")
        self._tags[path] = value

    def release(self, path: str) -> None:
        """Let a tag go; it keeps its value until somebody writes it.

        Raises:
            TagError: there is no such tag.
            PlcTestError: it is not forced.
        """
        if not self._forces.release(self._tags.find(path)):
            forced = ", ".join(force.tag.path for force in self._forces) or "no tag"
            raise PlcTestError(f"{path} is not forced; {forced} is")


class Noise:
    """A disturbance added to a numeric tag in each LATCH; not summed up over cycles."""

    def __init__(self, tags: Tags, path: str, amplitude: float, random: Random) -> None:
        self._tags = tags
        self._tag = tags.find(path)
        if not is_number(self._tag.data_type):
            raise PlcTestError(f"noise needs a number; {path} is a {self._tag.data_type}")
        if amplitude <= 0:
            raise PlcTestError(f"noise on {path}: the amplitude {amplitude!r} must be above 0")
        self._amplitude = amplitude
        self._random = random
        self._base: float = 0
        self._written: object = None

    def apply(self) -> None:
        """Add a new disturbance to what the plant or the program wrote."""
        value = self._tags[self._tag.path]
        if value != self._written or self._written is None:
            self._base = value
        noisy = self._base + self._random.uniform(-self._amplitude, self._amplitude)
        self._tags[self._tag.path] = _fitted(self._tag, noisy)
        self._written = self._tags[self._tag.path]


def _fitted(tag: Tag, value: float) -> object:
    """Return the nearest value that the tag can take."""
    kind = tag.data_type
    if isinstance(kind, SubrangeType) or (
        isinstance(kind, ElementaryType) and kind.kind is not Kind.REAL
    ):
        return max(kind.minimum, min(round(value), kind.maximum))
    return value
