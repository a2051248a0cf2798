"""Bistables of IEC 61131-3: SR, RS."""

from __future__ import annotations

from plcsim.core.function_block import FunctionBlock
from st_types import BOOL, var_input, var_output


class SR(FunctionBlock):
    """Set has priority. Inputs: SET1, RESET (S1 and R of IEC 61131-3). Output: Q1."""

    SET1 = var_input(BOOL)
    RESET = var_input(BOOL)
    Q1 = var_output(BOOL)

    def execute(self) -> None:
        """Set, reset or keep Q1."""
        self.Q1 = self.SET1 or (self.Q1 and not self.RESET)


class RS(FunctionBlock):
    """Reset has priority. Inputs: SET, RESET1 (S and R1 of IEC 61131-3). Output: Q1."""

    SET = var_input(BOOL)
    RESET1 = var_input(BOOL)
    Q1 = var_output(BOOL)

    def execute(self) -> None:
        """Set, reset or keep Q1."""
        self.Q1 = not self.RESET1 and (self.SET or self.Q1)
