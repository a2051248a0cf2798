"""What the dialects of Structured Text do differently when they run."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Final

from st_types.resolve import dialect as dialects

if TYPE_CHECKING:
    from st_types.resolve.scope import Scope


@dataclass(frozen=True, slots=True)
class Semantics:
    """The rules of one dialect; the defaults are those of Automation Studio.

    Attributes:
        name: as it is shown.
        narrow_results: arithmetic on 8 and 16 bits keeps to that width, a number with a point is
            a REAL beside a REAL; else C's ``int`` and ``double`` hold what lies between.
        limits_once: the limit and the step of FOR are evaluated once, before the loop.
        short_circuit: AND and OR of BOOLs leave out the right side where the left one decides.
        rounds_to_even: REAL to integer rounds halves to the even number, else away from zero.
        copies_inputs: a FUNCTION works on its own copy of a STRING, a STRUCT or an ARRAY that it is
            given as VAR_INPUT; else on what the caller has.
        checks_bounds: an index outside its bounds ends the program.
    """

    name: str = "Automation Studio"
    narrow_results: bool = False
    limits_once: bool = False
    short_circuit: bool = False
    rounds_to_even: bool = False
    copies_inputs: bool = False
    checks_bounds: bool = False


AUTOMATION_STUDIO: Final = Semantics()
IEC: Final = Semantics(
    "IEC 61131-3",
    narrow_results=True,
    limits_once=True,
    short_circuit=True,
    rounds_to_even=True,
    copies_inputs=True,
    checks_bounds=True,
)


def semantics_of(scope: Scope) -> Semantics:
    """Return the rules of what is written in a scope."""
    return IEC if scope.dialect is dialects.IEC else AUTOMATION_STUDIO
