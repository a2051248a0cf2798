"""Edge detection of IEC 61131-3: R_TRIG, F_TRIG; and RF_TRIG for both.

M holds CLK of the last call and is FALSE before the first one. So R_TRIG fires in its first call
where CLK is TRUE, as the standard notes, and F_TRIG never does. There the text of the standard
differs: it keeps NOT CLK in M, so that an F_TRIG whose CLK was never TRUE fires once after a
restart. We follow the controller: B&R's standard.fun wants a CLK that was TRUE in the last call,
the code that B&R's compiler makes of EDGENEG starts from FALSE in the same way, and the guideline
IEC 61131-8 advises to suppress that edge.
"""

from __future__ import annotations

from plcsim.library.standard import interface


class R_TRIG(interface.R_TRIG):  # noqa: N801  # the IEC name
    """Q is TRUE in the call in which CLK has become TRUE. Input: CLK. Output: Q."""

    def execute(self) -> None:
        """Compare CLK with the last call."""
        self.Q = self.CLK and not self.M
        self.M = self.CLK


class F_TRIG(interface.F_TRIG):  # noqa: N801  # the IEC name
    """Q is TRUE in the call in which CLK has become FALSE. Input: CLK. Output: Q."""

    def execute(self) -> None:
        """Compare CLK with the last call."""
        self.Q = self.M and not self.CLK
        self.M = self.CLK


class RF_TRIG(interface.RF_TRIG):  # noqa: N801  # the controller's name
    """Q is TRUE in the call in which CLK has changed. Input: CLK. Output: Q."""

    def execute(self) -> None:
        """Compare CLK with the last call."""
        self.Q = self.CLK is not self.M
        self.M = self.CLK
