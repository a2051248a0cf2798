"""Library standard as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

__all__ = []

_DECLARED = declared_beside(__name__)


class TON(FunctionBlock):
    """On-delay timer."""

    _plc_type = _DECLARED["TON"]

    IN: bool
    """Starts the timer with its rising edge."""

    PT: int
    """Delay."""

    Q: bool
    """TRUE once IN has been TRUE for PT."""

    ET: int
    """Time since the rising edge, up to PT."""

    StartTime: int
    """Low word of the start."""

    M: bool
    """IN at the last call."""

    Restart: int
    """High word of the start."""


class TOF(FunctionBlock):
    """Off-delay timer."""

    _plc_type = _DECLARED["TOF"]

    IN: bool
    """Starts the timer with its falling edge."""

    PT: int
    """Delay."""

    Q: bool
    """TRUE while IN is, and for PT after it."""

    ET: int
    """Time since the falling edge, up to PT."""

    M: bool
    """IN at the last call."""

    StartTime: int
    """Low word of the start."""

    Restart: int
    """High word of the start."""


class TP(FunctionBlock):
    """Pulse timer."""

    _plc_type = _DECLARED["TP"]

    IN: bool
    """Starts the pulse with its rising edge."""

    PT: int
    """Length of the pulse."""

    Q: bool
    """TRUE for PT, whatever IN does meanwhile."""

    ET: int
    """Time since the start of the pulse, up to PT."""

    StartTime: int
    """Low word of the start."""

    Restart: int
    """High word of the start."""


class CTU(FunctionBlock):
    """Up-counter."""

    _plc_type = _DECLARED["CTU"]

    CU: bool
    """Counts with its rising edge."""

    RESET: bool
    """Sets CV to 0; R of IEC 61131-3."""

    PV: int
    """Limit that Q compares with."""

    Q: bool
    """TRUE where CV >= PV."""

    CV: int
    """Count."""

    M: bool
    """CU at the last call."""


class CTD(FunctionBlock):
    """Down-counter."""

    _plc_type = _DECLARED["CTD"]

    CD: bool
    """Counts with its rising edge."""

    LOAD: bool
    """Sets CV to PV; LD of IEC 61131-3."""

    PV: int
    """Value to load."""

    Q: bool
    """TRUE where CV = 0."""

    CV: int
    """Count."""

    M: bool
    """CD at the last call."""


class CTUD(FunctionBlock):
    """Up-down counter."""

    _plc_type = _DECLARED["CTUD"]

    CU: bool
    """Counts up with its rising edge."""

    CD: bool
    """Counts down with its rising edge."""

    RESET: bool
    """Sets CV to 0; R of IEC 61131-3."""

    LOAD: bool
    """Sets CV to PV; LD of IEC 61131-3."""

    PV: int
    """Value to load, limit that QU compares with."""

    QU: bool
    """TRUE where CV >= PV."""

    QD: bool
    """TRUE where CV <= 0."""

    CV: int
    """Count."""

    MU: bool
    """CU at the last call."""

    MD: bool
    """CD at the last call."""


class R_TRIG(FunctionBlock):
    """Rising edge."""

    _plc_type = _DECLARED["R_TRIG"]

    CLK: bool
    """Signal."""

    Q: bool
    """TRUE in the call that sees CLK rise."""

    M: bool
    """CLK at the last call."""


class F_TRIG(FunctionBlock):
    """Falling edge."""

    _plc_type = _DECLARED["F_TRIG"]

    CLK: bool
    """Signal."""

    Q: bool
    """TRUE in the call that sees CLK fall."""

    M: bool
    """CLK at the last call."""


class SR(FunctionBlock):
    """Bistable, set has priority."""

    _plc_type = _DECLARED["SR"]

    SET1: bool
    """Sets Q1; S1 of IEC 61131-3."""

    RESET: bool
    """Resets Q1; R of IEC 61131-3."""

    Q1: bool
    """State."""


class RS(FunctionBlock):
    """Bistable, reset has priority."""

    _plc_type = _DECLARED["RS"]

    SET: bool
    """Sets Q1; S of IEC 61131-3."""

    RESET1: bool
    """Resets Q1; R1 of IEC 61131-3."""

    Q1: bool
    """State."""


class TON_10ms(FunctionBlock):
    """On-delay timer in ticks of 10 ms."""

    _plc_type = _DECLARED["TON_10ms"]

    IN: bool
    """Starts the timer with its rising edge."""

    PT: int
    """Ticks."""

    Q: bool
    """TRUE once IN has been TRUE for PT."""

    ET: int
    """Ticks since then, up to PT."""

    StartTime: int
    """1 + tick of the start."""

    M: bool
    """IN at the last call."""


class TOF_10ms(FunctionBlock):
    """Off-delay timer in ticks of 10 ms."""

    _plc_type = _DECLARED["TOF_10ms"]

    IN: bool
    """Starts the timer with its falling edge."""

    PT: int
    """Ticks."""

    Q: bool
    """TRUE while IN is, and for PT after it."""

    ET: int
    """Ticks since then, up to PT."""

    M: bool
    """IN at the last call."""

    StartTime: int
    """1 + tick of the start."""


class TP_10ms(FunctionBlock):
    """Pulse timer in ticks of 10 ms."""

    _plc_type = _DECLARED["TP_10ms"]

    IN: bool
    """Starts the pulse with its rising edge."""

    PT: int
    """Ticks."""

    Q: bool
    """The pulse."""

    ET: int
    """Ticks since then, up to PT."""

    StartTime: int
    """1 + tick of the start."""


class RF_TRIG(FunctionBlock):
    """Both edges."""

    _plc_type = _DECLARED["RF_TRIG"]

    CLK: bool
    """Signal."""

    Q: bool
    """TRUE in the call that sees CLK change."""

    M: bool
    """CLK at the last call."""


class SEMA(FunctionBlock):
    """Semaphore."""

    _plc_type = _DECLARED["SEMA"]

    CLAIM: bool
    """Claims it."""

    RELEASE: bool
    """Gives it back."""

    BUSY: bool
    """It was claimed before."""

    X: bool
    """It is claimed."""
