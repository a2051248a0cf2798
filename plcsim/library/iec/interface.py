"""Library iec as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside

if TYPE_CHECKING:
    from plcsim.library.standard import TOF, TON, TP

__all__ = []

_DECLARED = declared_beside(__name__)


class CTU_INT(FunctionBlock):
    """Up-counter."""

    _plc_type = _DECLARED["CTU_INT"]

    CU: bool
    """Counts with its rising edge."""

    R: bool
    """Sets CV to 0."""

    PV: int
    """Limit that Q compares with."""

    Q: bool
    """TRUE where CV >= PV."""

    CV: int
    """Count."""

    M: bool
    """CU at the last call."""


class CTU_DINT(FunctionBlock):
    """Up-counter."""

    _plc_type = _DECLARED["CTU_DINT"]

    CU: bool
    """Counts with its rising edge."""

    R: bool
    """Sets CV to 0."""

    PV: int
    """Limit that Q compares with."""

    Q: bool
    """TRUE where CV >= PV."""

    CV: int
    """Count."""

    M: bool
    """CU at the last call."""


class CTU_LINT(FunctionBlock):
    """Up-counter."""

    _plc_type = _DECLARED["CTU_LINT"]

    CU: bool
    """Counts with its rising edge."""

    R: bool
    """Sets CV to 0."""

    PV: int
    """Limit that Q compares with."""

    Q: bool
    """TRUE where CV >= PV."""

    CV: int
    """Count."""

    M: bool
    """CU at the last call."""


class CTU_UDINT(FunctionBlock):
    """Up-counter."""

    _plc_type = _DECLARED["CTU_UDINT"]

    CU: bool
    """Counts with its rising edge."""

    R: bool
    """Sets CV to 0."""

    PV: int
    """Limit that Q compares with."""

    Q: bool
    """TRUE where CV >= PV."""

    CV: int
    """Count."""

    M: bool
    """CU at the last call."""


class CTU_ULINT(FunctionBlock):
    """Up-counter."""

    _plc_type = _DECLARED["CTU_ULINT"]

    CU: bool
    """Counts with its rising edge."""

    R: bool
    """Sets CV to 0."""

    PV: int
    """Limit that Q compares with."""

    Q: bool
    """TRUE where CV >= PV."""

    CV: int
    """Count."""

    M: bool
    """CU at the last call."""


class CTD_INT(FunctionBlock):
    """Down-counter."""

    _plc_type = _DECLARED["CTD_INT"]

    CD: bool
    """Counts with its rising edge."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Start of the count."""

    Q: bool
    """TRUE where CV <= 0."""

    CV: int
    """Count."""

    M: bool
    """CD at the last call."""


class CTD_DINT(FunctionBlock):
    """Down-counter."""

    _plc_type = _DECLARED["CTD_DINT"]

    CD: bool
    """Counts with its rising edge."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Start of the count."""

    Q: bool
    """TRUE where CV <= 0."""

    CV: int
    """Count."""

    M: bool
    """CD at the last call."""


class CTD_LINT(FunctionBlock):
    """Down-counter."""

    _plc_type = _DECLARED["CTD_LINT"]

    CD: bool
    """Counts with its rising edge."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Start of the count."""

    Q: bool
    """TRUE where CV <= 0."""

    CV: int
    """Count."""

    M: bool
    """CD at the last call."""


class CTD_UDINT(FunctionBlock):
    """Down-counter."""

    _plc_type = _DECLARED["CTD_UDINT"]

    CD: bool
    """Counts with its rising edge."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Start of the count."""

    Q: bool
    """TRUE where CV <= 0."""

    CV: int
    """Count."""

    M: bool
    """CD at the last call."""


class CTD_ULINT(FunctionBlock):
    """Down-counter."""

    _plc_type = _DECLARED["CTD_ULINT"]

    CD: bool
    """Counts with its rising edge."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Start of the count."""

    Q: bool
    """TRUE where CV <= 0."""

    CV: int
    """Count."""

    M: bool
    """CD at the last call."""


class CTUD_INT(FunctionBlock):
    """Up-down-counter."""

    _plc_type = _DECLARED["CTUD_INT"]

    CU: bool
    """Counts up with its rising edge."""

    CD: bool
    """Counts down with its rising edge."""

    R: bool
    """Sets CV to 0."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Limit, and what LD loads."""

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

    up: bool
    """CU has risen."""

    down: bool
    """CD has risen."""


class CTUD_DINT(FunctionBlock):
    """Up-down-counter."""

    _plc_type = _DECLARED["CTUD_DINT"]

    CU: bool
    """Counts up with its rising edge."""

    CD: bool
    """Counts down with its rising edge."""

    R: bool
    """Sets CV to 0."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Limit, and what LD loads."""

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

    up: bool
    """CU has risen."""

    down: bool
    """CD has risen."""


class CTUD_LINT(FunctionBlock):
    """Up-down-counter."""

    _plc_type = _DECLARED["CTUD_LINT"]

    CU: bool
    """Counts up with its rising edge."""

    CD: bool
    """Counts down with its rising edge."""

    R: bool
    """Sets CV to 0."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Limit, and what LD loads."""

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

    up: bool
    """CU has risen."""

    down: bool
    """CD has risen."""


class CTUD_UDINT(FunctionBlock):
    """Up-down-counter."""

    _plc_type = _DECLARED["CTUD_UDINT"]

    CU: bool
    """Counts up with its rising edge."""

    CD: bool
    """Counts down with its rising edge."""

    R: bool
    """Sets CV to 0."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Limit, and what LD loads."""

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

    up: bool
    """CU has risen."""

    down: bool
    """CD has risen."""


class CTUD_ULINT(FunctionBlock):
    """Up-down-counter."""

    _plc_type = _DECLARED["CTUD_ULINT"]

    CU: bool
    """Counts up with its rising edge."""

    CD: bool
    """Counts down with its rising edge."""

    R: bool
    """Sets CV to 0."""

    LD: bool
    """Sets CV to PV."""

    PV: int
    """Limit, and what LD loads."""

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

    up: bool
    """CU has risen."""

    down: bool
    """CD has risen."""


class TON_LTIME(FunctionBlock):
    """On-delay timer for LTIME, in steps of 1 ms."""

    _plc_type = _DECLARED["TON_LTIME"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TON
    """That measures in ms."""


class LTON(FunctionBlock):
    """On-delay timer for LTIME as CODESYS calls it, in steps of 1 ms."""

    _plc_type = _DECLARED["LTON"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TON
    """That measures in ms."""


class TON_TIME(FunctionBlock):
    """On-delay timer under the name of its type."""

    _plc_type = _DECLARED["TON_TIME"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TON
    """That measures."""


class TOF_LTIME(FunctionBlock):
    """Off-delay timer for LTIME, in steps of 1 ms."""

    _plc_type = _DECLARED["TOF_LTIME"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TOF
    """That measures in ms."""


class LTOF(FunctionBlock):
    """Off-delay timer for LTIME as CODESYS calls it, in steps of 1 ms."""

    _plc_type = _DECLARED["LTOF"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TOF
    """That measures in ms."""


class TOF_TIME(FunctionBlock):
    """Off-delay timer under the name of its type."""

    _plc_type = _DECLARED["TOF_TIME"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TOF
    """That measures."""


class TP_LTIME(FunctionBlock):
    """Pulse timer for LTIME, in steps of 1 ms."""

    _plc_type = _DECLARED["TP_LTIME"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TP
    """That measures in ms."""


class LTP(FunctionBlock):
    """Pulse timer for LTIME as CODESYS calls it, in steps of 1 ms."""

    _plc_type = _DECLARED["LTP"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TP
    """That measures in ms."""


class TP_TIME(FunctionBlock):
    """Pulse timer under the name of its type."""

    _plc_type = _DECLARED["TP_TIME"]

    IN: bool
    """Starts the timer."""

    PT: int
    """Length."""

    Q: bool
    """Result."""

    ET: int
    """Time that has run, up to PT."""

    timer: TP
    """That measures."""
