"""Library MTBasics as Python sees it.

Written from its declarations by ``plcsim types library``; not to be edited.
"""

from __future__ import annotations

from enum import IntEnum
from typing import TYPE_CHECKING, Final

from plcsim.core.function_block import FunctionBlock
from plcsim.library.face import declared_beside
from st_types import Struct

if TYPE_CHECKING:
    from plcsim.library.mttypes import MTPIDIntegrationEnum, MTPIDParametersType

__all__ = [
    "MTBasicsInternalType",
    "MTBasicsLimiterInternalType",
    "MTBasicsPIDInternalType",
    "MTBasicsPT1InternalType",
    "MTBasicsPWMInternalType",
    "MTBasicsPWMModeEnum",
    "MTBasicsTimeDelayInternalType",
    "mtBCD_ERR_MAX_NEG_SLEW_RATE_NEG",
    "mtBCD_ERR_MAX_POS_SLEW_RATE_NEG",
    "mtBCD_ERR_MIN_PULSE_HIGH",
    "mtBCD_ERR_MIN_PULSE_LOW",
    "mtBCD_ERR_MODE_INVALID",
    "mtBCD_ERR_OUTPUT_LIMIT_INVALID",
    "mtBCD_ERR_PERIOD_LOW",
    "mtBCD_ERR_TIME_CONSTANT1_INVALID",
]

_DECLARED = declared_beside(__name__)

mtBCD_ERR_TIME_CONSTANT1_INVALID: Final = -1058012139
"""A time constant is below 0."""

mtBCD_ERR_OUTPUT_LIMIT_INVALID: Final = -1058012134
"""MinOut is not below MaxOut."""

mtBCD_ERR_MAX_POS_SLEW_RATE_NEG: Final = -1058012133
"""MaxPosSlewRate is below 0."""

mtBCD_ERR_MAX_NEG_SLEW_RATE_NEG: Final = -1058012132
"""MaxNegSlewRate is below 0."""

mtBCD_ERR_MIN_PULSE_HIGH: Final = -1058012124
"""MinPulseWidth is not below Period."""

mtBCD_ERR_MIN_PULSE_LOW: Final = -1058012123
"""MinPulseWidth is below 0."""

mtBCD_ERR_PERIOD_LOW: Final = -1058012122
"""Period is not above the cycle time."""

mtBCD_ERR_MODE_INVALID: Final = -1058012111
"""There is no such mode."""


class MTBasicsPWMModeEnum(IntEnum):
    """Enumeration MTBasicsPWMModeEnum."""

    mtBASICS_PULSE_BEGINNING = 0
    mtBASICS_PULSE_MIDDLE = 1


_DECLARED.enumeration(MTBasicsPWMModeEnum)


class MTBasicsInternalType(Struct):
    """What all blocks keep."""

    _plc_type = _DECLARED["MTBasicsInternalType"]

    Enabled: bool

    UpdateOld: bool

    SetOld: bool


class MTBasicsPWMInternalType(Struct):
    """MTBasicsPWMInternalType."""

    _plc_type = _DECLARED["MTBasicsPWMInternalType"]

    Common: MTBasicsInternalType

    Mode: int

    Period: float

    MinPulseWidth: float

    OnTime: float

    Elapsed: float


class MTBasicsPIDInternalType(Struct):
    """MTBasicsPIDInternalType."""

    _plc_type = _DECLARED["MTBasicsPIDInternalType"]

    Common: MTBasicsInternalType

    Parameters: MTPIDParametersType

    MinOut: float

    MaxOut: float

    Invert: bool

    Integral: float

    Derivative: float

    ErrorOld: float

    IsFirst: bool


class MTBasicsLimiterInternalType(Struct):
    """MTBasicsLimiterInternalType."""

    _plc_type = _DECLARED["MTBasicsLimiterInternalType"]

    Common: MTBasicsInternalType

    MinOut: float

    MaxOut: float

    MaxPosSlewRate: float

    MaxNegSlewRate: float

    Value: float

    IsFirst: bool


class MTBasicsPT1InternalType(Struct):
    """MTBasicsPT1InternalType."""

    _plc_type = _DECLARED["MTBasicsPT1InternalType"]

    Common: MTBasicsInternalType

    Gain: float

    TimeConstant: float

    Value: float


class MTBasicsTimeDelayInternalType(Struct):
    """MTBasicsTimeDelayInternalType."""

    _plc_type = _DECLARED["MTBasicsTimeDelayInternalType"]

    Common: MTBasicsInternalType

    pValues: int
    """Values on the heap."""

    Count: int

    Next: int


class MTBasicsLimiter(FunctionBlock):
    """Limits a value and its slew rate."""

    _plc_type = _DECLARED["MTBasicsLimiter"]

    Enable: bool
    """Run the block; FALSE resets it."""

    MinOut: float

    MaxOut: float

    MaxPosSlewRate: float
    """Per second; 0 for no limit."""

    MaxNegSlewRate: float
    """Per second; 0 for no limit."""

    Update: bool
    """A rising edge takes over the parameters above."""

    In: float
    """Input."""

    OutPresetValue: float
    """What SetOut sets Out to."""

    SetOut: bool
    """A rising edge sets Out."""

    Active: bool
    """It runs."""

    Error: bool
    """Parameters are wrong, StatusID tells which."""

    StatusID: int
    """0 or an error."""

    UpdateDone: bool
    """They are taken over."""

    Out: float
    """Output."""

    Internal: MTBasicsLimiterInternalType
    """State."""


class MTBasicsPID(FunctionBlock):
    """PID controller."""

    _plc_type = _DECLARED["MTBasicsPID"]

    Enable: bool
    """Run the block; FALSE resets it."""

    PIDParameters: MTPIDParametersType

    MinOut: float

    MaxOut: float

    Invert: bool
    """For a plant with a falling characteristic."""

    Update: bool
    """A rising edge takes over the parameters above."""

    SetValue: float

    ActValue: float

    IntegrationPartPresetValue: float

    SetIntegrationPart: bool
    """A rising edge sets the integral part."""

    HoldOut: bool
    """Keeps Out as it is."""

    TrackingValue: float

    EnableTracking: bool
    """Out is TrackingValue."""

    HoldIntegration: MTPIDIntegrationEnum

    Busy: bool
    """It works on something."""

    Active: bool
    """It runs."""

    Error: bool
    """Parameters are wrong, StatusID tells which."""

    StatusID: int
    """0 or an error."""

    UpdateDone: bool
    """They are taken over."""

    Out: float
    """Output."""

    ControlError: float
    """SetValue less ActValue."""

    ProportionalPart: float

    IntegrationPart: float

    DerivativePart: float

    TrackingActive: bool

    IntegrationStatus: MTPIDIntegrationEnum

    SystemReference: int
    """Always 0."""

    Internal: MTBasicsPIDInternalType
    """State."""


class MTBasicsPT1(FunctionBlock):
    """First-order lag."""

    _plc_type = _DECLARED["MTBasicsPT1"]

    Enable: bool
    """Run the block; FALSE resets it."""

    Gain: float
    """Amplification."""

    TimeConstant: float
    """Seconds."""

    Update: bool
    """A rising edge takes over the parameters above."""

    In: float
    """Input."""

    OutPresetValue: float
    """What SetOut sets Out to."""

    SetOut: bool
    """A rising edge sets Out."""

    Busy: bool
    """It works on something."""

    Active: bool
    """It runs."""

    Error: bool
    """Parameters are wrong, StatusID tells which."""

    StatusID: int
    """0 or an error."""

    UpdateDone: bool
    """They are taken over."""

    Out: float
    """Output."""

    SystemReference: int
    """Always 0."""

    Internal: MTBasicsPT1InternalType
    """State."""


class MTBasicsPWM(FunctionBlock):
    """Pulse width modulator."""

    _plc_type = _DECLARED["MTBasicsPWM"]

    Enable: bool
    """Run the block; FALSE resets it."""

    Mode: MTBasicsPWMModeEnum
    """Where in the period the pulse lies."""

    MinPulseWidth: float
    """Seconds."""

    Period: float
    """Seconds."""

    Update: bool
    """A rising edge takes over the parameters above."""

    DutyCycle: float
    """Per cent."""

    Active: bool
    """It runs."""

    Error: bool
    """Parameters are wrong, StatusID tells which."""

    StatusID: int
    """0 or an error."""

    UpdateDone: bool
    """They are taken over."""

    Out: bool
    """Output."""

    Internal: MTBasicsPWMInternalType
    """State."""


class MTBasicsTimeDelay(FunctionBlock):
    """Delays a value."""

    _plc_type = _DECLARED["MTBasicsTimeDelay"]

    Enable: bool
    """Run the block; FALSE resets it."""

    DelayTime: float
    """Seconds."""

    In: float
    """Input."""

    InitialValue: float
    """Output until the delay has passed."""

    Active: bool
    """It runs."""

    Error: bool
    """Parameters are wrong, StatusID tells which."""

    StatusID: int
    """0 or an error."""

    Out: float
    """Output."""

    Internal: MTBasicsTimeDelayInternalType
    """State."""
