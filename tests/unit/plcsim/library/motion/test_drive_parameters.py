"""Parameters of a drive: what is written is read back."""

import math

import pytest

from plcsim.library.members import StructMembers
from plcsim.library.models import modelled_block
from plcsim.library.motion.axis import NO_AXIS
from st_types import BOOL, DINT, INT, LREAL, REAL, SINT, UDINT, UINT, USINT
from st_types.types.derived import DataBlockType, EnumerationType, Member, Section, StructType

from .conftest import AXIS, Block
from .test_plcopen import FAST

KINDS = {BOOL: 1, SINT: 2, INT: 3, DINT: 4, USINT: 5, UINT: 6, UDINT: 7, REAL: 8, LREAL: 17}
SETTINGS = {"Axis": UDINT, "ParID": UINT, "DataAddress": UDINT, "DataType": UINT}
MODE = EnumerationType("McAcpAxProcessParIDModeEnum", {"PARID_GET": 0, "PARID_SET": 1})
ITEM = StructType(
    "McAcpAxProcessParIDType",
    [Member("ParID", UINT), Member("VariableAddress", UDINT), Member("DataType", DINT)],
)


@pytest.fixture
def block(plc):
    """``block(name)``: one of these blocks, of an axis."""

    def make(name, axis=AXIS, **more):
        inputs = {**SETTINGS, **more, "Execute": BOOL, "Enable": BOOL}
        outputs = {"ErrorID": UINT, **dict.fromkeys(("Done", "Busy", "Valid", "Error"), BOOL)}
        plc.types[name] = DataBlockType(
            name,
            [Member(each, kind, section=Section.INPUT) for each, kind in inputs.items()]
            + [Member(each, kind, section=Section.OUTPUT) for each, kind in outputs.items()],
        )
        return plc.block(name, axis=axis)

    return make


@pytest.fixture
def transfer(plc, block):
    """``transfer(name, ParID, type, value)``: run a block to its end; the variable then."""

    def run(name, number, kind, value=0):
        address = plc.memory.allocate(8)
        plc.memory.set(kind, address, value)
        made = block(name)
        made(Execute=True, ParID=number, DataAddress=address, DataType=KINDS[kind])
        assert made.on == {"Busy"}
        assert made().on == {"Done"}
        return plc.memory.get(kind, address)

    return run


@pytest.mark.parametrize(
    ("kind", "value"),
    [
        (BOOL, True),
        (SINT, -3),
        (INT, -300),
        (DINT, -70_000),
        (USINT, 200),
        (UINT, 60_000),
        (UDINT, 4_000_000_000),
        (REAL, 1.5),
        (LREAL, 1e300),
    ],
)
def test_what_is_written_is_read_back(transfer, kind, value):
    transfer("MC_BR_WriteParID", 719, kind, value)
    assert transfer("MC_BR_ReadParID", 719, kind) == value
    assert transfer("MC_BR_ReadParID", 720, kind, 1) == 0


@pytest.mark.parametrize(
    ("value", "kind", "found"),
    [(1e300, REAL, math.inf), (math.nan, DINT, 0), (-1.75, DINT, -1), (300.0, USINT, 44)],
)
def test_a_parameter_is_read_as_another_type(transfer, value, kind, found):
    transfer("MC_BR_WriteParID", 719, LREAL, value)
    assert transfer("MC_BR_ReadParID", 719, kind) == found


def test_the_position_is_that_of_the_axis(plc, transfer):
    plc.powered()
    move = plc.block("MC_MoveAbsolute")
    move(Execute=True, Position=42.0, **FAST)
    plc.run(1000, move)
    assert transfer("MC_BR_ReadParID", 111, DINT) == 42


def test_cyclic_blocks_transfer_in_each_call(plc, block):
    source, target = plc.memory.allocate(4), plc.memory.allocate(4)
    write, read = block("MC_BR_CyclicWrite"), block("MC_BR_CyclicRead")
    for value in (7, 8):
        plc.memory.set(DINT, source, value)
        assert write(Enable=True, ParID=5, DataAddress=source, DataType=4).on == {"Busy", "Valid"}
        read(Enable=True, ParID=5, DataAddress=target, DataType=4)
        assert plc.memory.get(DINT, target) == value
    plc.memory.set(DINT, source, 9)
    write(Enable=False)
    read()
    assert plc.memory.get(DINT, target) == 8


@pytest.mark.parametrize("name", ["MC_BR_ReadParID", "MC_BR_WriteParID"])
def test_without_an_axis_it_is_an_error_and_address_0_is_nothing(block, name):
    assert block(name, axis=0)(Execute=True)["ErrorID"] == NO_AXIS
    made = block(name)
    made(Execute=True, ParID=5, DataType=4)
    assert made().on == {"Done"}


def test_a_list_of_parameters_is_written_or_read_by_its_mode(plc):
    values, items = plc.memory.allocate(8), plc.memory.allocate(2 * ITEM.size)
    members = StructMembers(ITEM)
    for index, (number, kind) in enumerate(((10, 7), (11, 8))):
        for name, value in (
            ("ParID", number),
            ("VariableAddress", values + 4 * index),
            ("DataType", kind),
        ):
            place = members.find(name)
            plc.memory.set(place.data_type, items + index * ITEM.size + place.offset, value)
    inputs = {"Axis": UDINT, "DataAddress": UDINT, "NumberOfParIDs": UDINT, "Mode": MODE}
    plc.types["List"] = DataBlockType(
        "MC_BR_ProcessParID_AcpAx",
        [Member(n, k, section=Section.INPUT) for n, k in {**inputs, "Execute": BOOL}.items()]
        + [Member("Done", BOOL, section=Section.OUTPUT)],
    )
    made = Block(plc, "List")
    made._run = modelled_block(plc.types["List"], {ITEM.name: ITEM}.get).bind(plc.context)
    plc.memory.set(UDINT, values, 5)
    plc.memory.set(REAL, values + 4, 2.5)
    made(Execute=True, DataAddress=items, NumberOfParIDs=2, Mode=1)
    plc.memory.write(values, bytes(8))
    made(Execute=False)
    made(Execute=False)
    assert made(Execute=True, Mode=0)().on == {"Done"}
    assert plc.memory.get(UDINT, values) == 5
    assert plc.memory.get(REAL, values + 4) == 2.5
