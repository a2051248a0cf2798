"""Counters of IEC 61131-3: CTU, CTD, CTUD.

They count rising edges of CU and CD, as R_TRIG finds them: an input that is TRUE in the first call
counts. CV stops at the ends of its type (PVmin and PVmax of the standard) and never wraps; at PV it
goes on. RESET and LOAD win over counting, and an edge that comes under them is lost.
"""

from __future__ import annotations

from plcsim.library.standard import interface
from st_types import INT, UINT


class CTU(interface.CTU):
    """Up-counter. Inputs: CU, RESET (R of IEC 61131-3), PV. Outputs: Q where CV >= PV, CV."""

    def execute(self) -> None:
        """Reset, or count an edge of CU."""
        if self.RESET:
            self.CV = 0
        elif self.CU and not self.M:
            self.CV = min(self.CV + 1, UINT.maximum)
        self.M = self.CU
        self.Q = self.CV >= self.PV


class CTD(interface.CTD):
    """Down-counter. Inputs: CD, LOAD (LD of IEC 61131-3), PV. Outputs: Q where CV is 0, CV."""

    def execute(self) -> None:
        """Load, or count an edge of CD."""
        if self.LOAD:
            self.CV = self.PV
        elif self.CD and not self.M:
            self.CV = max(self.CV - 1, UINT.minimum)
        self.M = self.CD
        self.Q = self.CV == 0


class CTUD(interface.CTUD):
    """Up-down counter; RESET wins over LOAD, edges of both CU and CD in one call cancel.

    Inputs: CU, CD, RESET, LOAD (R and LD of IEC 61131-3), PV. Outputs: QU where CV >= PV, QD where
    CV <= 0, CV.
    """

    def execute(self) -> None:
        """Reset, load, or count the edges of CU and CD."""
        steps = (self.CU and not self.MU) - (self.CD and not self.MD)
        if self.RESET:
            self.CV = 0
        elif self.LOAD:
            self.CV = self.PV
        else:
            self.CV = max(INT.minimum, min(self.CV + steps, INT.maximum))
        self.MU = self.CU
        self.MD = self.CD
        self.QU = self.CV >= self.PV
        self.QD = self.CV <= 0
