"""MpOeeCore: what it makes of pieces and time."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.mapp.errors import MPLINK_NULL
from plcsim.library.mapp.oee_blocks import BLOCKS
from plcsim.library.members import BlockVariables, StructMembers
from st_types import BOOL, DINT, REAL, TIME, UDINT
from st_types.types.derived import DataBlockType, Member, ReferenceType, Section, StructType

PARAMETERS = StructType("MpOeeCoreParType", [Member("IdealCycleTime", TIME)])
INPUTS = {
    "MpLink": UDINT,
    "Parameters": ReferenceType(PARAMETERS),
    "PieceCounter": UDINT,
    "RejectCounter": UDINT,
    **dict.fromkeys(("Enable", "Update", "Downtime", "Reset", "Export"), BOOL),
}
RESULTS = ("Availability", "Performance", "Quality", "OEE")
SWITCHES = ("Active", "Error", "UpdateDone", "CommandDone", "ExportDone")
OUTPUTS = {"StatusID": DINT} | dict.fromkeys(RESULTS, REAL) | dict.fromkeys(SWITCHES, BOOL)
S = 1_000_000_000


@pytest.fixture
def oee():
    """``oee(seconds, PieceCounter=5)``: time passes, then a call; its results."""
    data_type = DataBlockType(
        "MpOeeCore",
        [Member(each, kind, section=Section.INPUT) for each, kind in INPUTS.items()]
        + [Member(each, kind, section=Section.OUTPUT) for each, kind in OUTPUTS.items()],
    )
    memory = Memory()
    address, parameters = memory.allocate(data_type.size), memory.allocate(PARAMETERS.size)
    memory.set(TIME, parameters, 2_000)
    variables = BlockVariables(memory, StructMembers(data_type), address)
    context = Context(memory, None)
    model = BLOCKS["MpOeeCore"](data_type, context, {}.get)

    def call(seconds=0, **inputs):
        context.release_ns += seconds * S
        variables.set(**inputs)
        model.run(address)
        return [round(variables.number(name), 4) for name in RESULTS]

    call.variables = variables
    call.parameters = parameters
    call(Enable=True, MpLink=1, PieceCounter=100, RejectCounter=7, Parameters=parameters)
    return call


def test_it_multiplies_availability_performance_and_quality(oee):
    assert oee() == [0, 0, 0, 0]
    assert oee(60, PieceCounter=120, RejectCounter=12) == [1, 0.6667, 0.75, 0.5]
    assert oee(20, Downtime=True) == [0.75, 0.6667, 0.75, 0.375]
    assert oee(0, PieceCounter=200)[1] == 1


def test_reset_and_update(oee):
    oee(60, PieceCounter=120)
    oee(0, Reset=True)
    assert oee.variables.is_true("CommandDone")
    assert oee(10, Reset=False, PieceCounter=122) == [1, 0.4, 1, 0.4]
    oee.variables.set(Parameters=0)
    assert oee(0)[1] == 0.4
    assert oee(0, Update=True)[1] == 0.2
    assert oee.variables.is_true("UpdateDone")


def test_it_wants_a_link_and_begins_anew_at_enable(oee):
    oee(60, PieceCounter=120)
    oee(0, MpLink=0)
    assert oee.variables.number("StatusID") == MPLINK_NULL
    assert oee(0, MpLink=1) == [0, 0, 0, 0]
