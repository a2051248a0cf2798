"""Bistables of IEC 61131-3: SR, RS, SEMA."""

from __future__ import annotations

from plcsim.library.standard import interface


class SR(interface.SR):
    """Set has priority. Inputs: SET1, RESET (S1 and R of IEC 61131-3). Output: Q1."""

    def execute(self) -> None:
        """Set, reset or keep Q1."""
        self.Q1 = self.SET1 or (self.Q1 and not self.RESET)


class RS(interface.RS):
    """Reset has priority. Inputs: SET, RESET1 (S and R1 of IEC 61131-3). Output: Q1."""

    def execute(self) -> None:
        """Set, reset or keep Q1."""
        self.Q1 = not self.RESET1 and (self.SET or self.Q1)


class SEMA(interface.SEMA):
    """A semaphore: whoever finds BUSY FALSE after CLAIM has it until RELEASE.

    Inputs: CLAIM, RELEASE. Output: BUSY, TRUE where it was claimed before this call.
    """

    def execute(self) -> None:
        """Claim or release."""
        self.BUSY = self.X
        if self.CLAIM:
            self.X = True
        elif self.RELEASE:
            self.BUSY = self.X = False
