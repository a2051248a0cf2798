"""Blocks of the MT libraries: filters, delays, tables and statistics."""

import math

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.members import StructMembers
from plcsim.library.models import modelled_block
from st_types import BOOL, DINT, REAL, UDINT, USINT
from st_types.types.derived import ArrayType, DataBlockType, Member, Section

MS = 1_000_000
KINDS = {
    "Enable": BOOL,
    "Update": BOOL,
    "SetOut": BOOL,
    "HoldOut": BOOL,
    "Reset": BOOL,
    "Order": USINT,
    "NumberOfNodes": USINT,
    "MovingWindowLength": UDINT,
    "NodeVectorX": ArrayType(REAL, [(0, 4)]),
    "FcnValues": ArrayType(REAL, [(0, 4)]),
}
BLOCKS = {
    "MTFilterLowPass": "Order CutOffFrequency In",
    "MTFilterHighPass": "Order CutOffFrequency In",
    "MTBasicsPT2": "Gain TimeConstant1 TimeConstant2 In OutPresetValue SetOut",
    "MTBasicsDT1": "Gain TimeConstant In",
    "MTBasicsDT2": "Gain TimeConstant1 TimeConstant2 In",
    "MTBasicsIntegrator": "Gain In OutPresetValue SetOut HoldOut",
    "MTLookUpTable": "NodeVectorX FcnValues NumberOfNodes InX",
    "MTDataStatistics": "MovingWindowLength In Reset",
    "MTDataMean": "In Reset",
}
OUTPUTS = {
    **dict.fromkeys(["Active", "Error", "UpdateDone"], BOOL),
    "StatusID": DINT,
    **dict.fromkeys(["Out", "MinValue", "MaxValue", "Mean", "RMS", "Variance"], REAL),
    "IndexMaxValue": UDINT,
}


class Block:
    def __init__(self, name):
        inputs = ["Enable", "Update", *BLOCKS[name].split()]
        members = [Member(n, KINDS.get(n, REAL), section=Section.INPUT) for n in inputs]
        members += [Member(n, kind, section=Section.OUTPUT) for n, kind in OUTPUTS.items()]
        data_type = DataBlockType(name, members)
        self.memory = Memory()
        self.context = Context(self.memory, None)
        self.context.release_ns = 5 * MS
        self._members = StructMembers(data_type)
        self._address = self.memory.allocate(data_type.size)
        self._run = modelled_block(data_type, lambda _name: None).bind(self.context)

    def __getitem__(self, name):
        place = self._members.find(name)
        return self.memory.get(place.data_type, self._address + place.offset)

    def __call__(self, **inputs):
        for name, value in inputs.items():
            place = self._members.find(name)
            self.memory.set(place.data_type, self._address + place.offset, value)
        self._run(self._address)
        self.context.release_ns += 10 * MS
        return self


def gain_at(block, frequency, **parameters):
    """How much of a sine goes through a filter, once it has settled."""
    block(Enable=True, **parameters)
    peaks = []
    for number in range(2000):
        block(In=math.sin(2 * math.pi * frequency * number * 0.01))
        peaks.append(abs(block["Out"]))
    return max(peaks[1000:])


@pytest.mark.parametrize("order", [1, 2, 3, 4])
@pytest.mark.parametrize(("frequency", "ratio"), [(1.0, 0.2), (5.0, 1.0), (20.0, 4.0)])
def test_a_low_pass_of_butterworth(order, frequency, ratio):
    found = gain_at(Block("MTFilterLowPass"), frequency, Order=order, CutOffFrequency=5.0)
    warped = math.tan(math.pi * frequency * 0.01) / math.tan(math.pi * 0.05)
    assert found == pytest.approx(1 / math.sqrt(1 + warped ** (2 * order)), abs=0.02)
    assert (warped > 1) is (ratio > 1)


@pytest.mark.parametrize("order", [1, 2, 3])
def test_a_high_pass_takes_what_does_not_change(order):
    block = Block("MTFilterHighPass")
    assert gain_at(block, 20.0, Order=order, CutOffFrequency=5.0) == pytest.approx(1, abs=0.05)
    for _ in range(1000):
        block(In=3.0)
    assert block["Out"] == pytest.approx(0, abs=1e-3)


def test_what_cannot_be_filtered_goes_through():
    block = Block("MTFilterLowPass")
    block(Enable=True, Order=2, CutOffFrequency=60.0)
    assert block(In=3.0)["Out"] == 3.0
    assert (block["Active"], block["Error"]) == (True, False)
    assert (block(Enable=False)["Out"], block["Active"]) == (0.0, False)


def test_parameters_count_when_they_are_taken_over():
    block = Block("MTBasicsIntegrator")
    block(Enable=True, Gain=2.0, In=1.0)
    for _ in range(50):
        block(Gain=100.0)
    assert block["Out"] == pytest.approx(1.0)
    block(Update=True)
    assert (block["Out"], block["UpdateDone"]) == (pytest.approx(2.0), True)
    assert block(HoldOut=True)["Out"] == pytest.approx(2.0)
    assert block(SetOut=True, OutPresetValue=-4.0)["Out"] == -4.0


@pytest.mark.parametrize(
    ("name", "parameters", "out"),
    [
        ("MTBasicsPT2", {"Gain": 3.0, "TimeConstant1": 2.0}, 30 * (1 - math.exp(-0.5))),
        ("MTBasicsDT1", {"Gain": 3.0, "TimeConstant": 0.5}, 0.0),
    ],
)
def test_a_value_that_is_held_for_a_second(name, parameters, out):
    block = Block(name)
    block(Enable=True, In=10.0, **parameters)
    for _ in range(100):
        block()
    assert block["Out"] == pytest.approx(out, rel=1e-5)


@pytest.mark.parametrize("name", ["MTBasicsDT1", "MTBasicsDT2"])
def test_the_rate_of_a_value_that_rises(name):
    block = Block(name)
    times = {"TimeConstant": 0.02} if name == "MTBasicsDT1" else {"TimeConstant2": 0.02}
    for number in range(200):
        block(Enable=True, Gain=2.0, In=0.05 * number, **times)
    assert block["Out"] == pytest.approx(10.0, rel=1e-3)


def test_a_table():
    block = Block("MTLookUpTable")
    nodes = {"NodeVectorX": [0.0, 2.0, 4.0], "FcnValues": [1.0, 5.0, 4.0], "NumberOfNodes": 3}
    values = [block(Enable=True, InX=x, **nodes)["Out"] for x in (-1.0, 1.0, 2.0, 3.0, 9.0)]
    assert values == [1.0, 3.0, 5.0, 4.5, 4.0]
    assert block(NumberOfNodes=0)["Out"] == 0.0


def test_statistics_of_a_window():
    block = Block("MTDataStatistics")
    for value in (9.0, 1.0, 2.0, 6.0):
        block(Enable=True, MovingWindowLength=3, In=value)
    found = [block[name] for name in ("MinValue", "MaxValue", "Mean", "Variance")]
    assert found == [1.0, 6.0, 3.0, 7.0]
    assert block["RMS"] == pytest.approx(math.sqrt(41 / 3))
    assert block["IndexMaxValue"] == 2
    block(Reset=True, In=4.0)
    assert (block["Mean"], block["Variance"]) == (4.0, 0.0)
    mean = Block("MTDataMean")
    for value in (1.0, 2.0):
        mean(Enable=True, In=value)
    assert mean["Out"] == 1.5
