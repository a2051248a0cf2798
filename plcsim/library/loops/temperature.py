"""LCRTempPID of LoopConR: heats below the set temperature, and cools well above it.

The vendor's controller is a PID controller with parameters that LCRTempTune finds; this one is on
or off, as that of mapp Temp, and so needs none of them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.loops.block import OK, LoopBlock, LoopState, limited
from plcsim.library.mapp.temperature_blocks import DEAD_BAND, FULL
from plcsim.library.members import ReferredStructure

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables, FindType
    from st_types.types.derived import StructType

LCR_ERR_LCRTEMPPID_WR_PTR: Final = 31568
"""There is nothing at pSettings."""

AUTO: Final = 1
MANUAL: Final = 2
"""LCRTEMPPID_MODE_AUTO and ..._MAN; in any other mode both outputs are 0."""


class TemperaturePid(LoopBlock):
    """LCRTempPID; y_heat and y_cool are percent."""

    outputs: ClassVar[tuple[str, ...]] = ("y_heat", "y_cool")

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._settings = ReferredStructure(data_type, "pSettings")

    def step(
        self, _address: int, variables: BlockVariables, _state: LoopState, _step_s: float
    ) -> int:
        """Switch the outputs, or pass Y_man on: above 0 it heats, below it cools."""
        settings = self._settings.of(self.context.memory, variables)
        if settings is None:
            variables.set(**dict.fromkeys(self.outputs, 0))
            return LCR_ERR_LCRTEMPPID_WR_PTR
        value = _value(variables)
        heats = value > 0 and not settings.is_true("disable_heating")
        cools = value < 0 and settings.is_true("enable_cooling")
        variables.set(y_heat=heats * value, y_cool=cools * -value)
        return OK


def _value(variables: BlockVariables) -> float:
    """Return how much it heats, or, below 0, cools, percent."""
    mode = variables.number("mode")
    if mode == MANUAL:
        return limited(variables.number("Y_man"), -FULL, FULL)
    above = variables.number("Temp") - variables.number("Temp_set")
    return FULL * ((above < 0) - (above > DEAD_BAND)) if mode == AUTO else 0.0


BLOCKS: Final[Mapping[str, type[LoopBlock]]] = {"LCRTempPID": TemperaturePid}
"""What runs the blocks by their names."""
