"""MpTempController of mapp Temp: heats below the set temperature, cools well above it.

The vendor's controller is a PID controller that tunes itself; this one is on or off. Tuning finds
nothing, and is done at once; a group commands its members by their own inputs only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

from plcsim.library.mapp.block import MappBlock

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.library.members import BlockVariables

FULL: Final = 100.0
"""HeatValue and CoolValue of an output that is on, percent."""

DEAD_BAND: Final = 1.0
"""How far above the set temperature cooling begins, in the units of the temperatures."""


class TemperatureController(MappBlock):
    """MpTempController: Control and Tune count by level."""

    def seen(self, _variables: BlockVariables, _link: int) -> tuple[object, ...]:
        """Return nothing: all that counts stands in the data block."""
        return ()

    def call(self, _address: int, variables: BlockVariables, _link: int) -> None:
        """Switch the outputs."""
        tune = variables.is_true("Tune")
        control = variables.is_true("Control") and not tune
        above = variables.number("ActualTemperature") - variables.number("SetTemperature")
        self._show(variables, heat=control and above < 0, cool=control and above > DEAD_BAND)
        variables.set(ControlActive=control, TuningDone=tune, TuningActive=False)
        variables.set(Simulation=variables.is_true("Simulate"))
        variables.set(UpdateDone=variables.is_true("Update"))

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Switch all off."""
        super().rest(address, variables)
        self._show(variables, heat=False, cool=False)
        variables.set(ControlActive=False, TuningDone=False, Simulation=False, UpdateDone=False)

    def _show(self, variables: BlockVariables, *, heat: bool, cool: bool) -> None:
        variables.set(Heat=heat, HeatValue=FULL * heat, Cool=cool, CoolValue=FULL * cool)


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {"MpTempController": TemperatureController}
"""What runs the blocks by their names."""
