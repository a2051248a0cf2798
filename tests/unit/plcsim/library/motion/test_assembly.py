"""Assemblies of shuttles and groups of axes: power and states, and axes that programs make."""

import pytest

from plcsim.core.context import Context
from plcsim.core.errors import PageFault
from plcsim.core.memory import Memory
from plcsim.library.members import StructMembers
from plcsim.library.models import modelled_block
from plcsim.library.motion.assembly import SHUTTLES
from plcsim.library.motion.axis import MOST_AXES, axes_of
from st_types import BOOL, DINT, LREAL, REAL, UDINT, UINT
from st_types.types.derived import DataBlockType, EnumerationType, Member, Section, StructType

MS = 1_000_000
AXIS = StructType("McAxisType", [Member("controlif", UDINT), Member("seqNo", DINT)])
STATES = {"mcACPTRAK_DISABLED": 0, "mcACPTRAK_READY": 1, "mcACPTRAK_ERRORSTOP": 2}
INFO = StructType(
    "Info",
    [
        Member("PowerOn", BOOL),
        Member("ReadyForPowerOn", BOOL),
        Member("ShuttlesCount", UINT),
        Member("PLCopenState", EnumerationType("States", STATES)),
    ],
)
MODES = EnumerationType("Modes", {"mcACPTRAK_USERDATA_SET": 0, "mcACPTRAK_USERDATA_GET": 1})
KINDS = {
    "Mode": MODES,
    "DataAddress": UDINT,
    "DataSize": UDINT,
    "Position": LREAL,
    "Velocity": REAL,
    "RouteVelocity": REAL,
    "Distance": LREAL,
}
ADDRESSES = ("Assembly", "Sector", "AxesGroup", "Axis", "Controller", "Segment")
RESULTS = "Valid Busy Error Done Active CommandAborted Acknowledge"


class Track:
    """A controller whose time goes on in cycles of 1 ms, with an assembly and a group."""

    def __init__(self):
        self.memory = Memory()
        self.context = Context(self.memory, None)
        self.assembly, self.group = self.memory.allocate(16), self.memory.allocate(16)

    def user_data(self, shuttle, mode, address, size):
        """The outputs that are TRUE once user data are copied."""
        copy = self.block(
            "MC_BR_ShCopyUserData_AcpTrak", "Axis Execute DataAddress DataSize Mode", "ErrorID"
        )
        copy(Axis=shuttle, Mode=mode, DataAddress=address, DataSize=size, Execute=True)
        return copy().on

    def block(self, name, inputs, outputs=""):
        return Block(self, name, inputs.split(), f"{RESULTS} {outputs}".split())

    def power(self, *, on=True):
        name = "On" if on else "Off"
        switch = self.block(f"MC_BR_AsmPower{name}_AcpTrak", "Assembly Execute")
        switch(Assembly=self.assembly, Execute=True)
        return switch()

    def add(self, position):
        """A copy of what names a new shuttle."""
        block = self.block("MC_BR_SecAddShuttle_AcpTrak", "Sector Execute Position", "Axis ID")
        block(Sector=self.assembly, Execute=True, Position=position)
        assert "Done" in block().on
        return self.copied(block)

    def copied(self, block):
        copy = self.memory.allocate(AXIS.size)
        self.memory.write(copy, self.memory.read(block.place("Axis"), AXIS.size))
        return copy

    def run(self, milliseconds, block):
        for _ in range(milliseconds):
            self.context.release_ns += MS
            block()


class Block:
    """A block with the inputs and outputs that a test names."""

    def __init__(self, track, name, inputs, outputs):
        members = [
            Member(each, UDINT if each in ADDRESSES else KINDS.get(each, BOOL), section=kind)
            for each, kind in ((n, Section.INPUT) for n in inputs)
        ]
        kinds = {
            **KINDS,
            "Axis": AXIS,
            "AssemblyInfo": INFO,
            "TotalCount": UINT,
            "RemainingCount": UINT,
        }
        kinds |= {"ID": UDINT, "ErrorID": DINT}
        members += [Member(n, kinds.get(n, BOOL), section=Section.OUTPUT) for n in outputs]
        self._type = DataBlockType(name, members)
        self._members = StructMembers(self._type)
        self._memory = track.memory
        self._address = track.memory.allocate(self._type.size)
        self._run = modelled_block(self._type, {}.get).bind(track.context)

    def place(self, name):
        return self._address + self._type.find(name)[1]

    def __call__(self, **inputs):
        for name, value in inputs.items():
            place = self._members.find(name)
            self._memory.set(place.data_type, self._address + place.offset, value)
        self._run(self._address)
        return self

    def __getitem__(self, name):
        place = self._members.find(name)
        return self._memory.get(place.data_type, self._address + place.offset)

    @property
    def on(self):
        """The outputs that are TRUE."""
        outputs = (m for m in self._type.members if m.section is Section.OUTPUT)
        return {m.name for m in outputs if m.data_type is BOOL and self[m.name]}


@pytest.fixture
def track():
    return Track()


def test_an_assembly_is_ready_when_its_power_is_on(track):
    outputs = "AssemblyDisabled AssemblyReady AssemblyErrorStop"
    status = track.block("MC_BR_AsmReadStatus_AcpTrak", "Assembly Enable", outputs)
    assert "AssemblyDisabled" in status(Assembly=track.assembly, Enable=True).on
    assert track.power().on == {"Done", "Acknowledge"}
    assert status().on == {"Valid", "Busy", "AssemblyReady"}
    axes_of(track.context).at(track.assembly).fail()
    assert "AssemblyErrorStop" in status().on
    reset = track.block("MC_BR_AsmReset_AcpTrak", "Assembly Execute")
    reset(Assembly=track.assembly, Execute=True)
    assert "AssemblyReady" in status().on
    track.power(on=False)
    assert status().on == {"Valid", "Busy", "AssemblyDisabled"}
    assert status(Enable=False).on == set()


def test_the_structure_of_an_assembly_says_that_it_may_be_powered(track):
    info = track.block("MC_BR_AsmReadInfo_AcpTrak", "Assembly Enable", "AssemblyInfo")
    info(Assembly=track.assembly, Enable=True)
    assert info["AssemblyInfo.ReadyForPowerOn"]
    assert (info["AssemblyInfo.PowerOn"], info["AssemblyInfo.PLCopenState"]) == (False, 0)
    track.power()
    track.add(0.0)
    info()
    assert (info["AssemblyInfo.PowerOn"], info["AssemblyInfo.PLCopenState"]) == (True, 1)
    assert info["AssemblyInfo.ShuttlesCount"] == 1
    info(Enable=False)
    assert info["AssemblyInfo.ShuttlesCount"] == 0
    assert "Error" in info(Enable=True, Assembly=0).on


def test_a_shuttle_is_what_a_copy_of_its_axis_says_and_has_power_with_the_assembly(track):
    first, second = track.add(0.5), track.add(2.0)
    position = track.block("MC_ReadActualPosition", "Axis Enable", "Position")
    move = track.block("MC_BR_RoutedMoveAbs_AcpTrak", "Axis Execute Position Velocity")
    move(Axis=first, Execute=True, Position=1.5, Velocity=1.0)
    assert "Error" in move.on  # no power
    move(Execute=False)
    move()
    track.power()
    move(Execute=True)
    assert move.on == {"Busy", "Active", "Acknowledge"}
    track.run(1001, move)  # 1 unit at 1 unit/s, with 5000 units/s²
    assert "Done" in move.on
    axes = axes_of(track.context)
    assert axes.at(first).position == 1.5
    assert axes.at(second).position == 2.0
    assert axes.at(first) is not axes.at(second)
    assert position(Axis=second, Enable=True)["Position"] == 2.0
    assert axes.at(track.group) not in (axes.at(first), axes.at(second))


def test_a_routed_move_with_no_velocity_behind_its_position_ends_there(track):
    shuttle = track.add(0.0)
    track.power()
    move = track.block(
        "MC_BR_RoutedMoveVel_AcpTrak",
        "Axis Execute Position Velocity RouteVelocity",
        "InVelocity PositionReached",
    )
    move(Axis=shuttle, Execute=True, Position=1.0, RouteVelocity=2.0)
    track.run(400, move)
    assert "PositionReached" not in move.on
    track.run(200, move)
    assert move.on >= {"InVelocity", "PositionReached"}
    assert axes_of(track.context).at(shuttle).position == 1.0
    move(Execute=False)
    move(Execute=True, Velocity=1.0)
    track.run(1000, move)
    assert axes_of(track.context).at(shuttle).velocity == 1.0


def test_shuttles_are_shown_one_after_the_other(track):
    get = track.block(
        "MC_BR_AsmGetShuttle_AcpTrak", "Assembly Enable Next", "Axis TotalCount RemainingCount"
    )
    shuttles = [track.add(number) for number in range(3)]
    get(Assembly=track.assembly, Enable=True)
    assert (get["TotalCount"], get["RemainingCount"]) == (3, 2)
    found = [track.copied(get)]
    for _ in range(2):
        get(Next=True)
        get()  # the same one as long as Next is TRUE
        found.append(track.copied(get))
        get(Next=False)
    assert get["RemainingCount"] == 0
    axes = axes_of(track.context)
    assert [axes.at(each) for each in found] == [axes.at(each) for each in shuttles]
    get(Enable=False)
    assert get(Enable=True)["RemainingCount"] == 2


def test_there_are_some_shuttles_where_a_program_adds_none(track):
    get = track.block(
        "MC_BR_AsmGetShuttle_AcpTrak", "Assembly Enable Next", "Axis TotalCount RemainingCount"
    )
    assert get(Assembly=track.assembly, Enable=True)["TotalCount"] == SHUTTLES
    assert get(Next=True)["RemainingCount"] == SHUTTLES - 2


def test_a_wild_address_of_a_shuttle_is_a_page_fault(track):
    track.add(0.0)
    move = track.block("MC_BR_RoutedMoveAbs_AcpTrak", "Axis Execute Position Velocity")
    with pytest.raises(PageFault):
        move(Axis=0x7FFF_0000, Execute=True, Position=1.0, Velocity=1.0)


def test_shuttles_beyond_the_most_axes_are_not_added(track):
    axes = axes_of(track.context)
    while axes.add() is not None:
        pass
    add = track.block("MC_BR_SecAddShuttle_AcpTrak", "Sector Execute Position", "Axis ID")
    for _ in range(3):
        add(Sector=track.assembly, Execute=True)
    assert "Done" not in add.on
    assert axes.by_handle(MOST_AXES) is None


def test_a_group_has_power_is_homed_and_stands_by(track):
    status = track.block(
        "MC_GroupReadStatus", "AxesGroup Enable", "GroupDisabled GroupStandby GroupErrorStop"
    )
    info = track.block("MC_BR_GroupReadInfo", "AxesGroup Enable", "PowerOn IsHomed")
    power = track.block("MC_BR_GroupPower", "AxesGroup Enable", "Status")
    home = track.block("MC_BR_GroupHome_15", "AxesGroup Execute")
    assert "GroupDisabled" in status(AxesGroup=track.group, Enable=True).on
    power(AxesGroup=track.group, Enable=True)
    assert "Status" in power().on
    assert "GroupStandby" in status().on
    home(AxesGroup=track.group, Execute=True)
    assert "Done" in home().on
    assert info(AxesGroup=track.group, Enable=True).on >= {"PowerOn", "IsHomed"}
    power(Enable=False)
    assert "PowerOn" not in info().on


def test_a_shuttle_carries_what_a_program_gave_it(track):
    first, second = track.add(0.0), track.add(1.0)
    place = track.memory.allocate(8)
    track.memory.write(place, b"product!")
    assert "Done" in track.user_data(first, 0, place, 8)
    track.memory.write(place, bytes(8))
    assert "Done" in track.user_data(first, 1, place, 4)
    assert track.memory.read(place, 8) == b"prod\0\0\0\0"
    track.user_data(second, 1, place, 8)
    assert track.memory.read(place, 8) == bytes(8)
    assert track.user_data(first, 0, place, 1 << 20) == {"Error"}
    with pytest.raises(PageFault):
        track.user_data(first, 1, 0x7FFF_0000, 4)
