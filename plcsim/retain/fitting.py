"""Values of one program version for another: what fits by name and type is taken."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

from plcsim.core.tag import leaves
from plcsim.shared_image.directory import describe_type
from st_types.types.derived import ReferenceType

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.core.tag import Tag
    from plcsim.retain.generations import Generation


class FittedValues(NamedTuple):
    """What comes of a generation.

    Attributes:
        taken: (PLC address, bytes) for the variables.
        left: what is not taken, and why, a line for each.
    """

    taken: list[tuple[int, bytes]]
    left: list[str]


def fit(generation: Generation, wanted: Sequence[Tag]) -> FittedValues:
    """Return which values of a generation the variables of a controller take.

    An address (a pointer, a REFERENCE) is not taken: what lay there may lie elsewhere by now.

    Args:
        generation: of this program, or of another version of it.
        wanted: the retained variables.
    """
    places = {leaf.path: leaf for tag in wanted for leaf in leaves(tag)}
    found = FittedValues([], [])
    for variable in generation.variables:
        for leaf in leaves(variable):
            reason = _why_not(leaf, places.get(leaf.path))
            if reason:
                found.left.append(f"{leaf.path}: {reason}")
                continue
            data = generation.data[leaf.address : leaf.address + leaf.data_type.size]
            _add(found.taken, places[leaf.path].address, data)
    return found


def _why_not(leaf: Tag, place: Tag | None) -> str:
    if place is None:
        return "there is no such retained variable"
    if isinstance(place.data_type, ReferenceType):
        return "an address is not kept"
    if describe_type(leaf.data_type) != describe_type(place.data_type):
        return f"it was {leaf.data_type} and is {place.data_type}"
    return ""


def _add(taken: list[tuple[int, bytes]], address: int, data: bytes) -> None:
    """Add bytes; what adjoins the last ones becomes one with them."""
    if taken and taken[-1][0] + len(taken[-1][1]) == address:
        first, before = taken[-1]
        taken[-1] = first, before + data
    else:
        taken.append((address, data))
