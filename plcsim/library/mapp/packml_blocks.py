"""The blocks and functions of MpPackML.

Core and modes have one machine on a controller, modules one for each MpLink: a command of a module
is not handed on to others. A command counts while it is TRUE, in the states that take it; there is
one change of state in a call.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

from plcsim.library.mapp.block import MappBlock
from plcsim.library.mapp.packml import COMMANDS, MODE_CHANGES, PackMlMachine, PackMlState
from plcsim.library.members import rises

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables

REFUSED: Final = 1
"""What functions that return a DINT give where a mode cannot be had; no number of the vendor's."""


class _Machines:
    """The machines of a controller; a restart makes them anew."""

    def __init__(self, _context: Context) -> None:
        self.main = PackMlMachine(PackMlState.STOPPED)
        self.modules: dict[int, PackMlMachine] = {}


def _main(context: Context) -> PackMlMachine:
    return context.library(_Machines).main


def _go(machine: PackMlMachine, variables: BlockVariables, prefix: str = "") -> None:
    """Let a machine take what its block is given."""
    for name in COMMANDS:
        if variables.is_true(f"{prefix}{name}") and machine.command(name):
            return
    if variables.is_true(f"{prefix}StateComplete"):
        machine.complete()


class MainBlock(MappBlock):
    """A block that knows the machine of the modes."""

    def seen(self, _variables: BlockVariables, _link: int) -> tuple[object, ...]:
        """Return the state and the mode."""
        machine = _main(self.context)
        return machine.state, machine.mode


class PackMLCore(MainBlock):
    """MpPackMLCore: shows the mode and the state."""

    def call(self, _address: int, variables: BlockVariables, _link: int) -> None:
        """Show them."""
        machine = _main(self.context)
        variables.set(ModeCurrent=machine.mode, StateCurrent=_shown(machine))

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Show none."""
        variables.set(ModeCurrent=0, StateCurrent=0)


def _shown(machine: PackMlMachine) -> int:
    return machine.state if machine.mode else PackMlState.UNDEFINED


class Mode(MainBlock):
    """MpPackMLMode: Activate makes ModeID the mode; the commands of the active mode count."""

    def call(self, address: int, variables: BlockVariables, _link: int) -> None:
        """Take the commands, and show what they led to."""
        machine, mode = _main(self.context), int(variables.number("ModeID"))
        begins = rises(self.context, address, variables, "Activate")
        if variables.is_true("Activate") and (begins or not machine.mode):
            machine.change_mode(mode)
        is_active = machine.mode == mode != 0
        if is_active:
            _go(machine, variables)
        variables.set(
            ModeActive=is_active,
            ChangeModeAllowed=machine.state in MODE_CHANGES,
            StateCurrent=machine.state if is_active else PackMlState.UNDEFINED,
        )

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Show none."""
        variables.set(ModeActive=False, ChangeModeAllowed=False, StateCurrent=0)


class PackMLModule(MappBlock):
    """MpPackMLModule: a machine of its own, ACTIVATING first."""

    def _machine(self, link: int) -> PackMlMachine:
        modules = self.context.library(_Machines).modules
        return modules.setdefault(link, PackMlMachine(PackMlState.ACTIVATING))

    def seen(self, _variables: BlockVariables, link: int) -> tuple[object, ...]:
        """Return the state."""
        return (self._machine(link).state,)

    def call(self, _address: int, variables: BlockVariables, link: int) -> None:
        """Take the commands, and show what they led to."""
        machine = self._machine(link)
        _go(machine, variables, "Command.")
        variables.set(
            StateCurrent=machine.state,
            SubStateCurrent=variables.number("SubState"),
            UpdateDone=variables.is_true("Update"),
            Info__StateCurrent=machine.state.name.capitalize(),
        )

    def rest(self, address: int, variables: BlockVariables) -> None:
        """Show none."""
        variables.set(StateCurrent=0)


def _state_is_active(context: Context, p_link: int, state: int, mode: int) -> bool:
    """MpPackMLStateIsActive: whether that is the state, and that the mode."""
    machine = context.library(_Machines).modules.get(p_link)
    if machine is not None:
        return machine.state == state
    return _main(context).mode == mode and _main(context).state == state


def _mode_is_active(context: Context, _p_link: int, mode: int) -> bool:
    """MpPackMLModeIsActive."""
    return _main(context).mode == mode != 0


def _state_complete(context: Context, p_link: int, mode: int) -> bool:
    """MpPackMLStateComplete: whether the state was one to complete."""
    return _mode_is_active(context, p_link, mode) and _main(context).complete()


def _abort(context: Context, p_link: int, mode: int) -> bool:
    """MpPackMLAbort: whether the state was one to abort."""
    return _mode_is_active(context, p_link, mode) and _main(context).command("Abort")


def _change_mode(context: Context, _p_link: int, mode: int) -> int:
    """MpPackMLChangeMode: 0, or `REFUSED`."""
    return 0 if _main(context).change_mode(mode) else REFUSED


def _change_is_allowed(context: Context, _p_link: int, _mode: int) -> int:
    """MpPackMLModeChangeIsAllowed: 0, or `REFUSED`."""
    return 0 if _main(context).state in MODE_CHANGES else REFUSED


def _mode_current(context: Context, _p_link: int) -> int:
    """MpPackMLModeCurrent."""
    return _main(context).mode


def _state_current(context: Context, _p_link: int) -> int:
    """MpPackMLStateCurrent."""
    return _shown(_main(context))


BLOCKS: Final[Mapping[str, type[MappBlock]]] = {
    "MpPackMLCore": PackMLCore,
    "MpPackMLMode": Mode,
    "MpPackMLModule": PackMLModule,
}
"""What runs the blocks by their names."""

FUNCTIONS: Final[Mapping[str, Callable[..., Any]]] = {
    "MpPackMLStateIsActive": _state_is_active,
    "MpPackMLModeIsActive": _mode_is_active,
    "MpPackMLStateComplete": _state_complete,
    "MpPackMLAbort": _abort,
    "MpPackMLChangeMode": _change_mode,
    "MpPackMLModeChangeIsAllowed": _change_is_allowed,
    "MpPackMLModeCurrent": _mode_current,
    "MpPackMLStateCurrent": _state_current,
}
"""What runs the functions by their names: with the context, then their parameters."""
