"""MpOeeCore of mapp OEE: how well a machine is used, by the common formulas, from 0 to 1.

Availability is the part of the time without Downtime, performance what the pieces would have taken
at their ideal cycle time of the rest, quality the part of the pieces that were not rejected. There
are no shifts: time counts from Enable, or from Reset, on.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.mapp.block import MappBlock
from plcsim.library.members import ReferredStructure, rises

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables, FindType
    from st_types.types.derived import StructType

NS_PER_MS: Final = 1_000_000

IDEAL_CYCLE_MS: Final = 1_000
"""IdealCycleTime of the vendor's declaration, for a component without Parameters."""


_COUNTERS: Final = ("PieceCounter", "RejectCounter")


class _Shift:
    """What a component has counted.

    Attributes:
        last_ns: release of the call before.
        up_ns: time without Downtime.
        down_ns: time with it.
        pieces: PieceCounter at the beginning.
        rejects: RejectCounter at the beginning.
        ideal_ms: IdealCycleTime, milliseconds.
    """

    def __init__(self, now_ns: int, pieces: int, rejects: int, ideal_ms: float) -> None:
        self.last_ns = now_ns
        self.up_ns = self.down_ns = 0
        self.pieces, self.rejects, self.ideal_ms = pieces, rejects, ideal_ms

    def pass_time(self, now_ns: int, *, is_down: bool) -> None:
        """Count the time since the call before."""
        passed_ns, self.last_ns = max(now_ns - self.last_ns, 0), now_ns
        if is_down:
            self.down_ns += passed_ns
        else:
            self.up_ns += passed_ns


class _Shifts:
    """What the components of a controller have counted, by address; a restart forgets it."""

    def __init__(self, _context: Context) -> None:
        self.by_block: dict[int, _Shift] = {}


class OeeCore(MappBlock):
    """MpOeeCore: parameters are taken over at Enable and at a rising edge of Update."""

    settles: ClassVar[bool] = False

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._parameters = ReferredStructure(data_type, "Parameters")

    def seen(self, _variables: BlockVariables, _link: int) -> tuple[object, ...]:
        """Return nothing: each call counts time."""
        return ()

    def call(self, address: int, variables: BlockVariables, _link: int) -> None:
        """Count, and calculate."""
        shifts = self.context.library(_Shifts).by_block
        if rises(self.context, address, variables, "Reset") or address not in shifts:
            shifts[address] = self._new(variables)
        shift = shifts[address]
        if rises(self.context, address, variables, "Update"):
            shift.ideal_ms = self._ideal_ms(variables)
        shift.pass_time(self.context.release_ns, is_down=variables.is_true("Downtime"))
        self._show(variables, shift)
        variables.set(
            UpdateDone=variables.is_true("Update"),
            CommandDone=variables.is_true("Export") or variables.is_true("Reset"),
            ExportDone=variables.is_true("Export"),
        )

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Forget what was counted."""
        super().rest(address, variables)
        self.context.library(_Shifts).by_block.pop(address, None)

    def _new(self, variables: BlockVariables) -> _Shift:
        pieces, rejects = (int(variables.number(name)) for name in _COUNTERS)
        return _Shift(self.context.release_ns, pieces, rejects, self._ideal_ms(variables))

    def _ideal_ms(self, variables: BlockVariables) -> float:
        found = self._parameters.of(self.context.memory, variables)
        return IDEAL_CYCLE_MS if found is None else found.number("IdealCycleTime")

    @staticmethod
    def _show(variables: BlockVariables, shift: _Shift) -> None:
        pieces = variables.number("PieceCounter") - shift.pieces
        good = pieces - (variables.number("RejectCounter") - shift.rejects)
        availability = _part(shift.up_ns, shift.up_ns + shift.down_ns)
        performance = _part(pieces * shift.ideal_ms * NS_PER_MS, shift.up_ns)
        quality = _part(good, pieces)
        variables.set(
            Availability=availability,
            Performance=performance,
            Quality=quality,
            OEE=availability * performance * quality,
        )


def _part(part: float, whole: float) -> float:
    """Return a part of a whole, from 0 to 1; 0 of nothing."""
    return min(max(part / whole, 0.0), 1.0) if whole > 0 else 0.0


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {"MpOeeCore": OeeCore}
"""What runs the blocks by their names."""
