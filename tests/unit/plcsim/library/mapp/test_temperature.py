"""MpTempController: what it heats and cools."""

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.mapp.errors import MPLINK_NULL
from plcsim.library.mapp.temperature_blocks import BLOCKS
from plcsim.library.members import BlockVariables, StructMembers
from st_types import BOOL, DINT, REAL, UDINT
from st_types.types.derived import DataBlockType, Member, Section

INPUTS = {
    "MpLink": UDINT,
    "SetTemperature": REAL,
    "ActualTemperature": REAL,
    **dict.fromkeys(("Enable", "Control", "Tune", "Simulate", "Update"), BOOL),
}
SWITCHES = ("Active", "Error", "Heat", "Cool", "ControlActive", "TuningActive", "TuningDone")
OUTPUTS = {"StatusID": DINT, "HeatValue": REAL, "CoolValue": REAL, **dict.fromkeys(SWITCHES, BOOL)}


@pytest.fixture
def controller():
    data_type = DataBlockType(
        "MpTempController",
        [Member(each, kind, section=Section.INPUT) for each, kind in INPUTS.items()]
        + [Member(each, kind, section=Section.OUTPUT) for each, kind in OUTPUTS.items()],
    )
    memory = Memory()
    address = memory.allocate(data_type.size)
    variables = BlockVariables(memory, StructMembers(data_type), address)
    model = BLOCKS["MpTempController"](data_type, Context(memory, None), {}.get)

    def call(**inputs):
        variables.set(**inputs)
        model.run(address)
        return {name for name in SWITCHES if variables.is_true(name)}, variables

    call(Enable=True, MpLink=1, SetTemperature=180.0)
    return call


@pytest.mark.parametrize(
    ("temperature", "on"),
    [(179.9, {"Heat"}), (180.0, set()), (180.9, set()), (181.1, {"Cool"})],
)
def test_it_heats_below_and_cools_above(controller, temperature, on):
    shown, variables = controller(Control=True, ActualTemperature=temperature)
    assert shown == {"Active", "ControlActive", *on}
    assert variables.number("HeatValue") == 100.0 * ("Heat" in on)
    assert variables.number("CoolValue") == 100.0 * ("Cool" in on)


def test_tuning_is_done_as_long_as_it_is_asked_for(controller):
    assert controller(Tune=True, Control=True)[0] == {"Active", "TuningDone"}
    assert controller(Tune=False)[0] == {"Active", "ControlActive", "Heat"}


def test_without_enable_or_link_all_is_off(controller):
    assert "Heat" in controller(Control=True)[0]
    shown, variables = controller(MpLink=0)
    assert (shown, variables.number("StatusID")) == ({"Error"}, MPLINK_NULL)
    controller(MpLink=1)
    shown, variables = controller(Enable=False)
    assert (shown, variables.number("HeatValue")) == (set(), 0.0)
