"""Data blocks as ACP10_MC, McAxis and MpAxis declare them, and a context to run them."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.members import StructMembers
from plcsim.library.models import modelled_block
from st_types import BOOL, DINT, LREAL, REAL, UDINT, UINT, USINT
from st_types.types.derived import DataBlockType, Member, Section, StructType

MS = 1_000_000
AXIS = 0x200000

_IN = {
    "Axis": UDINT,
    "Master": UDINT,
    "Slave": UDINT,
    "AdrDriveStatus": UDINT,
    "Position": REAL,
    "Distance": REAL,
    "Velocity": REAL,
    "Acceleration": REAL,
    "Deceleration": REAL,
    "Direction": USINT,
    "HomingMode": USINT,
    "RatioNumerator": DINT,
    "RatioDenominator": DINT,
    "MasterSyncPosition": REAL,
    "SlaveSyncPosition": REAL,
    "MasterStartDistance": REAL,
    "MasterScaling": DINT,
    "SlaveScaling": DINT,
    "VelFactor": REAL,
    "AccFactor": REAL,
    "Torque": REAL,
    "CyclicVelocity": REAL,
    "CyclicPosition": LREAL,
    "Execute": BOOL,
    "Enable": BOOL,
    "JogPositive": BOOL,
    "JogNegative": BOOL,
}
_OUT = {
    "ErrorID": UINT,
    "AxisErrorID": UINT,
    "Error": BOOL,
    "Busy": BOOL,
    "Active": BOOL,
    "Done": BOOL,
    "CommandAborted": BOOL,
    "Status": BOOL,
    "Valid": BOOL,
    "InVelocity": BOOL,
    "InGear": BOOL,
    "InSync": BOOL,
    "InTorque": BOOL,
    "Jogging": BOOL,
    "PowerOn": BOOL,
    "IsHomed": BOOL,
}
STATES = [
    "Errorstop",
    "Disabled",
    "Stopping",
    "StandStill",
    "DiscreteMotion",
    "ContinuousMotion",
    "SynchronizedMotion",
    "Homing",
]
DRIVE_STATUS = StructType(
    "MC_DRIVESTATUS_TYP",
    [Member(name, BOOL) for name in ("ControllerReady", "ControllerStatus", "HomingOk")],
)


NUMBERS = ("Position", "Velocity", "Torque", "CyclicPosition")


def block_type(name, *more):
    """A block with all the members that any has, and some more outputs."""
    outputs = {each: LREAL if each in NUMBERS else BOOL for each in more}
    inputs = {each: kind for each, kind in _IN.items() if each not in outputs}
    members = [Member(each, kind, section=Section.INPUT) for each, kind in inputs.items()]
    members += [
        Member(each, kind, section=Section.OUTPUT) for each, kind in {**_OUT, **outputs}.items()
    ]
    return DataBlockType(name, members)


class Block:
    """A block of a program: inputs stay as they are, a call returns the block."""

    def __init__(self, plc, name, *more, axis=AXIS):
        self._plc = plc
        self._type = plc.types.get(name) or block_type(name, *more)
        self._members = StructMembers(self._type)
        self._address = plc.memory.allocate(self._type.size)
        self._run = modelled_block(self._type, {"MC_DRIVESTATUS_TYP": DRIVE_STATUS}.get).bind(
            plc.context
        )
        self.set(Axis=axis)

    def set(self, **values):
        for name, value in values.items():
            place = self._members.find(name)
            self._plc.memory.set(place.data_type, self._address + place.offset, value)

    def __getitem__(self, name):
        place = self._members.find(name)
        return self._plc.memory.get(place.data_type, self._address + place.offset)

    def __call__(self, **inputs):
        self.set(**inputs)
        self._run(self._address)
        return self

    @property
    def on(self):
        """The outputs that are TRUE."""
        outputs = (m for m in self._type.members if m.section is Section.OUTPUT)
        return {m.name for m in outputs if m.data_type is BOOL and self[m.name]}


class Plc:
    """A context whose time goes on in cycles of 1 ms."""

    def __init__(self):
        self.memory = Memory()
        self.context = Context(self.memory, None)
        self.types = {}
        self._on = []

    def block(self, name, *more, axis=AXIS):
        return Block(self, name, *more, axis=axis)

    def run(self, milliseconds, *blocks):
        for _ in range(milliseconds):
            self.context.release_ns += MS
            for block in blocks:
                block()

    def powered(self, axis=AXIS):
        power = self.block("MC_Power", axis=axis)
        power(Enable=True)
        return power


@pytest.fixture
def plc():
    return Plc()
