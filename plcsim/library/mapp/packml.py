"""The states of PackML (ANSI/ISA-TR88.00.02), numbered as MpPackMLStateEnum has them.

All transitions stand in the two tables of this module.
"""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Mapping


class PackMlState(IntEnum):
    """A state; the last three are those of modules, which the norm does not have."""

    UNDEFINED = 0
    CLEARING = 1
    STOPPED = 2
    STARTING = 3
    IDLE = 4
    SUSPENDED = 5
    EXECUTE = 6
    STOPPING = 7
    ABORTING = 8
    ABORTED = 9
    HOLDING = 10
    HELD = 11
    UNHOLDING = 12
    SUSPENDING = 13
    UNSUSPENDING = 14
    RESETTING = 15
    COMPLETING = 16
    COMPLETE = 17
    DEACTIVATING = 30
    DEACTIVATED = 31
    ACTIVATING = 32


_S = PackMlState

COMPLETED: Final[Mapping[PackMlState, PackMlState]] = {
    _S.CLEARING: _S.STOPPED,
    _S.STARTING: _S.EXECUTE,
    _S.EXECUTE: _S.COMPLETING,
    _S.STOPPING: _S.STOPPED,
    _S.ABORTING: _S.ABORTED,
    _S.HOLDING: _S.HELD,
    _S.UNHOLDING: _S.EXECUTE,
    _S.SUSPENDING: _S.SUSPENDED,
    _S.UNSUSPENDING: _S.EXECUTE,
    _S.RESETTING: _S.IDLE,
    _S.COMPLETING: _S.COMPLETE,
    _S.ACTIVATING: _S.STOPPED,
    _S.DEACTIVATING: _S.DEACTIVATED,
}
"""Where StateComplete leads, by the state it is given in."""

_RUNNING: Final = frozenset(
    [
        *(_S.IDLE, _S.STARTING, _S.EXECUTE, _S.COMPLETING, _S.COMPLETE, _S.RESETTING),
        *(_S.HOLDING, _S.HELD, _S.UNHOLDING, _S.SUSPENDING, _S.SUSPENDED, _S.UNSUSPENDING),
    ]
)
"""States that Stop ends."""

COMMANDS: Final[Mapping[str, tuple[frozenset[PackMlState], PackMlState]]] = {
    "Abort": (_RUNNING | {_S.CLEARING, _S.STOPPED, _S.STOPPING, _S.ACTIVATING}, _S.ABORTING),
    "Stop": (_RUNNING, _S.STOPPING),
    "Clear": (frozenset([_S.ABORTED]), _S.CLEARING),
    "Reset": (frozenset([_S.STOPPED, _S.COMPLETE]), _S.RESETTING),
    "Hold": (frozenset([_S.EXECUTE]), _S.HOLDING),
    "Unhold": (frozenset([_S.HELD]), _S.UNHOLDING),
    "Suspend": (frozenset([_S.EXECUTE]), _S.SUSPENDING),
    "Unsuspend": (frozenset([_S.SUSPENDED]), _S.UNSUSPENDING),
    "Start": (frozenset([_S.IDLE]), _S.STARTING),
}
"""The states that take a command, and where it leads; what is first counts where several are."""

MODE_CHANGES: Final = frozenset([_S.ABORTED, _S.STOPPED, _S.IDLE, _S.COMPLETE])
"""States in which the mode may change."""


class PackMlMachine:
    """One machine.

    Args:
        state: that it begins in.

    Attributes:
        state: of it.
        mode: number of its mode, 0 for none.
    """

    def __init__(self, state: PackMlState) -> None:
        self.state = state
        self.mode = 0

    def command(self, name: str) -> bool:
        """Take a command; return whether the state takes it."""
        takes, target = COMMANDS[name]
        if self.state not in takes:
            return False
        self.state = target
        return True

    def complete(self) -> bool:
        """Take StateComplete, likewise."""
        target = COMPLETED.get(self.state)
        if target is None:
            return False
        self.state = target
        return True

    def change_mode(self, mode: int) -> bool:
        """Change the mode, likewise."""
        if self.mode != mode and self.mode and self.state not in MODE_CHANGES:
            return False
        self.mode = mode
        return True
