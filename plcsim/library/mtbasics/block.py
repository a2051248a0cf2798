"""What the blocks of MTBasics and MTFilter share: Enable, Update, Active, Error, the step."""

from __future__ import annotations

from typing import Any

from plcsim.core.controller import Controller
from plcsim.core.function_block import FunctionBlock

NS_PER_SECOND = 1_000_000_000
OK = 0


class ControlBlock(FunctionBlock):
    """Base of the blocks: parameters are taken over when the block is enabled.

    Where they are wrong the block is not enabled, and Error tells. With Enable FALSE all outputs
    are reset.
    """

    __slots__ = ()

    Enable: bool
    Active: bool
    Error: bool
    StatusID: int
    Out: Any

    @property
    def common(self) -> Any:
        """What the block keeps: Enabled, UpdateOld."""
        raise NotImplementedError

    def execute(self) -> None:
        """Run one call."""
        common = self.common
        if not self.Enable:
            self._disable(common)
            return
        begins = not common.Enabled
        if begins:
            self.take_over(common)
        self.Active = common.Enabled
        if self.Active:
            if begins:
                self.begin()
            self.run(self.step_s)

    def take_over(self, common: Any) -> None:
        """Look at the parameters, and take them over where they are right."""
        self.StatusID = self.wrong()
        self.Error = self.StatusID != OK
        if not self.Error:
            self.take()
            common.Enabled = True

    def _disable(self, common: Any) -> None:
        if common.Enabled:
            self.end()
        common.Enabled = False
        self.Active = self.Error = False
        self.StatusID = OK
        self.Out = 0

    @property
    def step_s(self) -> float:
        """Cycle time of the task class that calls, in seconds; 0 outside of one."""
        controller = Controller.of(self.context)
        running = None if controller is None else controller.running[0]
        return 0.0 if running is None else running.cycle_ns / NS_PER_SECOND

    def wrong(self) -> int:
        """Return the status of parameters that are wrong, 0 where none is."""
        return OK

    def take(self) -> None:
        """Take the parameters over."""

    def begin(self) -> None:
        """Begin with no past."""

    def run(self, step_s: float) -> None:
        """Calculate the outputs of this cycle."""
        raise NotImplementedError

    def end(self) -> None:
        """Give back what the block holds."""


class UpdatedBlock(ControlBlock):
    """Base of the blocks whose parameters are taken over by a rising edge of Update too.

    Where they are wrong the block goes on with the old ones, and Error tells.
    """

    __slots__ = ()

    Update: bool
    UpdateDone: bool

    def execute(self) -> None:
        """Run one call."""
        common = self.common
        wanted = self.Enable and self.Update
        if wanted and common.Enabled and not common.UpdateOld:
            self.take_over(common)
        common.UpdateOld = wanted
        super().execute()
        self.UpdateDone = wanted and not self.Error
