"""LCRTempPID: what it heats and cools."""

import pytest

from plcsim.library.loops.temperature import LCR_ERR_LCRTEMPPID_WR_PTR
from plcsim.library.members import BlockVariables, StructMembers
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE
from st_types import BOOL, REAL, UDINT, UINT
from st_types.types.derived import Member, ReferenceType, StructType

SETTINGS = StructType(
    "lcrtemp_set_typ", [Member("enable_cooling", BOOL), Member("disable_heating", BOOL)]
)
INPUTS = dict.fromkeys(("Temp_set", "Temp", "Y_man"), REAL) | {
    "enable": BOOL,
    "mode": UDINT,
    "pSettings": ReferenceType(SETTINGS),
}
OUTPUTS = {"y_heat": REAL, "y_cool": REAL, "status": UINT}


@pytest.fixture
def block(plc):
    made = plc.model("LCRTempPID", INPUTS, OUTPUTS)
    address = plc.memory.allocate(SETTINGS.size)
    settings = BlockVariables(plc.memory, StructMembers(SETTINGS), address)
    settings.set(enable_cooling=True)
    made(enable=True, mode=1, Temp_set=180.0, pSettings=address)
    return made, settings


@pytest.mark.parametrize(
    ("temperature", "outputs"), [(179.9, (100, 0)), (180.0, (0, 0)), (181.1, (0, 100))]
)
def test_it_heats_below_and_cools_above(block, temperature, outputs):
    made, settings = block
    assert made(Temp=temperature) == 0
    assert (made["y_heat"], made["y_cool"]) == outputs
    settings.set(enable_cooling=False, disable_heating=True)
    made()
    assert (made["y_heat"], made["y_cool"]) == (0, 0)


@pytest.mark.parametrize(
    ("value", "outputs"), [(30.0, (30, 0)), (-40.0, (0, 40)), (200.0, (100, 0))]
)
def test_a_value_of_the_program_is_passed_on(block, value, outputs):
    made, _ = block
    assert made(mode=2, Y_man=value) == 0
    assert (made["y_heat"], made["y_cool"]) == outputs


def test_without_settings_mode_or_enable_nothing_is_heated(block):
    made, _ = block
    assert made["y_heat"] == 100
    made(mode=0)
    assert made["y_heat"] == 0
    made(mode=1)
    assert made["y_heat"] == 100
    assert made(pSettings=0) == LCR_ERR_LCRTEMPPID_WR_PTR
    assert made["y_heat"] == 0
    assert made(enable=False) == ERR_FUB_ENABLE_FALSE
