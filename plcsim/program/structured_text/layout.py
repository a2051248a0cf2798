"""Where the variables of a program lie: in segments that get their addresses for each task."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.program.structured_text import ir
from plcsim.program.structured_text.lower.memory import Spot
from plcsim.program.variables import DeclaredVariables, variables_of
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from plcsim.core.tag import Tag
    from st_types.resolve.declared import DeclaredVariable
    from st_types.resolve.scope import Scope

OWN: Final = ("variables", "constants")
"""Segments of the program's own."""

SHARED: Final = ("global variables", "global constants")

NOT_STORED: Final = frozenset(["VAR_EXTERNAL", "VAR_TEMP"])
"""Sections whose variables lie elsewhere, or in each call."""

NOTHING: Final = DeclaredVariables(StructType("globals", ()), StructType("globals CONSTANT", ()))
"""Where a project has no global variables."""


class VariableLayout:
    """Places of the variables of a program, and of the global ones that it sees.

    Args:
        name: of the program.
        own: scopes whose variables are those of the program; none for a library.
        around: the scopes in which its names are looked up.
        shared: the global variables.

    Attributes:
        variables: of the program.
        areas: places by scope and name.
    """

    def __init__(
        self, name: str, own: Sequence[Scope], around: Sequence[Scope], shared: DeclaredVariables
    ) -> None:
        stored = {scope: _stored(scope) for scope in (*own, *around)}
        placed = _placed(own)
        self.variables = variables_of(name, placed.values())
        spots, shared_spots = _spots(OWN, self.variables), _spots(SHARED, shared)
        self.areas: dict[Scope, Mapping[str, Spot]] = {}
        for scope, variables in stored.items():
            known = spots if scope in own else shared_spots
            places = {
                variable.name: known[variable.name, variable.is_constant]
                for variable in variables
                if (variable.name, variable.is_constant) in known
                and (scope not in own or placed[variable.name] is variable)
            }
            if places:
                self.areas[scope] = places


def variables_in(name: str, own: Sequence[Scope]) -> DeclaredVariables:
    """Return the variables of a program, as in `VariableLayout`."""
    return variables_of(name, _placed(own).values())


def _placed(own: Sequence[Scope]) -> dict[str, DeclaredVariable]:
    """Return the variables of some scopes by name: of two with one name it is the first."""
    found: dict[str, DeclaredVariable] = {}
    for variable in (each for scope in own for each in _stored(scope)):
        found.setdefault(variable.name, variable)
    return found


def _stored(scope: Scope) -> list[DeclaredVariable]:
    return [each for each in scope.variables if each.block.section not in NOT_STORED]


def _spots(names: tuple[str, str], kinds: DeclaredVariables) -> dict[tuple[str, bool], Spot]:
    """Return places by name, and whether it is one of a constant."""
    found: dict[tuple[str, bool], Spot] = {}
    for is_constant, data_type in enumerate(kinds):
        segment = ir.Segment(names[is_constant], data_type.size)
        for member, offset in zip(data_type.members, data_type.offsets, strict=True):
            found[member.name, bool(is_constant)] = Spot(segment, offset)
    return found


def addresses(names: tuple[str, str], tags: Iterable[Tag | None]) -> dict[str, int]:
    """Return the addresses of segments, by the tags of variables and constants."""
    variables, constants = names
    return {
        constants if tag.is_constant else variables: tag.address for tag in tags if tag is not None
    }


def types_of(tags: Iterable[Tag]) -> DeclaredVariables:
    """Return the types of the global variables of a controller."""
    found: dict[bool, StructType[Any]] = {tag.is_constant: tag.data_type for tag in tags}  # type: ignore[misc]  # each is a STRUCT
    return DeclaredVariables(
        found.get(False, NOTHING.variables), found.get(True, NOTHING.constants)
    )
