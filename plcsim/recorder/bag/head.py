"""What every file of a recording begins with: whose it is, and what its bytes mean."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final

from plcsim.core.tag import Tag
from plcsim.recorder.errors import RecordingError
from plcsim.shared_image.directory import describe_type, type_from

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

FORMAT: Final = 1


@dataclass(frozen=True)
class Head:
    """What a recording is of.

    Attributes:
        project: name of the project.
        is_virtual: it ran on the virtual clock.
        epoch_ns: added to the controller's clock gives the time in the bag.
        origin_ns: when the controller was made, on its clock; the logbook counts from there.
        classes: number and cycle time of each task class.
        areas: the variables, as they lie one behind the other in a record.
        tags: paths that are recorded as messages of their own; with ``*`` all of a program.
        sources: SHA-256 of the project's files, by their names.
    """

    project: str
    is_virtual: bool
    epoch_ns: int
    origin_ns: int
    classes: Sequence[tuple[int, int]]
    areas: Sequence[Tag]
    tags: Sequence[str]
    sources: Mapping[str, str]

    def starts(self) -> dict[Tag, int]:
        """Return where each area begins in the variables of a record."""
        starts, at = {}, 0
        for area in self.areas:
            starts[area] = at
            at += area.data_type.size
        return starts

    def to_json(self) -> dict[str, Any]:
        """Return the head as values of JSON."""
        return {
            "format": FORMAT,
            "project": self.project,
            "is_virtual": self.is_virtual,
            "epoch_ns": self.epoch_ns,
            "origin_ns": self.origin_ns,
            "classes": [list(each) for each in self.classes],
            "areas": [[a.path, describe_type(a.data_type), a.address] for a in self.areas],
            "tags": list(self.tags),
            "sources": dict(self.sources),
        }


def head_from(values: Mapping[str, Any]) -> Head:
    """Return the head of `Head.to_json`.

    Raises:
        RecordingError: it is of another version of plcsim.
    """
    if values.get("format") != FORMAT:
        found = values.get("format")
        raise RecordingError(f"format {found} of another version of plcsim, not {FORMAT}")
    return Head(
        values["project"],
        values["is_virtual"],
        values["epoch_ns"],
        values["origin_ns"],
        [(number, cycle_ns) for number, cycle_ns in values["classes"]],
        [Tag(path, type_from(kind), address) for path, kind, address in values["areas"]],
        values["tags"],
        values["sources"],
    )


def head_text(head: Head) -> str:
    """Return the head as text of JSON, always the same for the same head."""
    return json.dumps(head.to_json(), separators=(",", ":"), sort_keys=True)
