"""Blocks of LoopConR on simple plants, with the data blocks that a version of the library has."""

import math

import pytest

from plcsim.core.context import Context
from plcsim.core.memory import Memory
from plcsim.library.members import StructMembers
from plcsim.library.models import modelled_block
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE
from st_types import BOOL, REAL, UDINT, UINT, USINT
from st_types.types.derived import DataBlockType, Member, ReferenceType, Section, StructType

MS = 1_000_000
KINDS = {
    "enable": BOOL,
    "enter": BOOL,
    "invert": BOOL,
    "hold_I": BOOL,
    "set": BOOL,
    "reset": BOOL,
    "pulse": BOOL,
    "x_reached": BOOL,
    "max_limit": BOOL,
    "min_limit": BOOL,
    "ident": UDINT,
    "request": UDINT,
    "ptr_table": UDINT,
    "status": UINT,
    "NoOfPoints": UINT,
    "mode": USINT,
    "fbk_mode": USINT,
    "d_mode": USINT,
}
PARAMETERS = "enable enter WX_max WX_min invert deadband dY_max Kp Tn Tv Tf Kw Kfbk fbk_mode d_mode"
BLOCKS = {
    "LCRPIDpara": (PARAMETERS, "status ident"),
    "LCRPID": ("enable ident W X Y_max Y_min A Y_man Y_fbk hold_I mode", "status e Y Yp Yi Yd"),
    "LCRRamp": (
        "enable x dy_up dy_down y_max y_min y_set set",
        "status y x_reached max_limit min_limit",
    ),
    "LCRPT1": ("enable x t y_set set", "status y"),
    "LCRPT1e": ("enable V T1 x y_set set", "status y"),
    "LCRPT2": ("enable V T1 T2 x y_set set", "status y"),
    "LCRIntegrate": ("enable x tn y_max y_min y_set set", "status y max_limit min_limit"),
    "LCRDifferentiate": ("enable x tv tf", "status y"),
    "LCRMinMax": ("reset in", "out_min out_max"),
    "LCRPWM": ("enable x max_value min_value t_min_pulse t_period", "status pulse t_on t_off"),
    "LCRCurveByPoints": ("x NoOfPoints ptr_table", "status y"),
}
SLIM = StructType(
    "lcrslimpid_par_typ",
    [Member(name, REAL) for name in ("Y_max", "Y_min", "Kp", "Tn", "Tv", "Kfbk")],
)


class Block:
    def __init__(self, plc, data_type):
        self._plc, self._type = plc, data_type
        self._members = StructMembers(data_type)
        self.address = plc.memory.allocate(data_type.size)
        self._run = modelled_block(data_type, lambda _name: None).bind(plc.context)

    def __getitem__(self, name):
        place = self._members.find(name)
        return self._plc.memory.get(place.data_type, self.address + place.offset)

    def __call__(self, **inputs):
        for name, value in inputs.items():
            place = self._members.find(name)
            self._plc.memory.set(place.data_type, self.address + place.offset, value)
        self._run(self.address)
        return self


class Plc:
    def __init__(self):
        self.memory = Memory()
        self.context = Context(self.memory, None)
        self.context.release_ns = 5 * MS

    def block(self, name, *more):
        inputs, outputs = (names.split() for names in BLOCKS.get(name, ("", "")))
        members = [Member(n, KINDS.get(n, REAL), section=Section.INPUT) for n in inputs]
        members += [Member(n, KINDS.get(n, REAL), section=Section.OUTPUT) for n in outputs]
        return Block(self, DataBlockType(name, [*members, *more]))

    def later(self, milliseconds=10):
        self.context.release_ns += milliseconds * MS


@pytest.fixture
def plc():
    return Plc()


def controller(plc, **parameters):
    """A controller with parameters, and what runs it."""
    given = {"Kp": 2.0, "Tn": 1.0, "Kw": 1.0, "Kfbk": 1.0, "fbk_mode": 1, "d_mode": 1}
    para = plc.block("LCRPIDpara")
    para(enable=True, enter=True, **{**given, **parameters})
    assert para["status"] == 0
    pid = plc.block("LCRPID")
    pid(ident=para["ident"], Y_max=100.0, Y_min=0.0)
    return pid


def controlled(plc, pid, seconds, goal, *, gain=0.8, time_s=2.0, start=0.0):
    """Let a plant of first order run under a controller; return all its values."""
    x, values = start, []
    for _ in range(round(seconds * 100)):
        pid(enable=True, mode=1, W=goal, X=x)
        x += (gain * pid["Y"] - x) * 0.01 / time_s
        values.append(x)
        plc.later()
    return values


def test_a_plant_goes_to_the_set_value_and_stays(plc):
    pid = controller(plc)
    values = controlled(plc, pid, 20, 40.0)
    assert values[-1] == pytest.approx(40.0, abs=0.01)
    assert max(values) < 46
    assert (pid["Y"], pid["status"]) == (pytest.approx(50.0, abs=0.1), 0)
    assert pid["Y"] == pytest.approx(pid["Yp"] + pid["Yi"] + pid["Yd"], abs=1e-3)


def test_without_integral_a_difference_is_left(plc):
    pid = controller(plc, Tn=0.0)
    values = controlled(plc, pid, 20, 40.0)
    assert values[-1] == pytest.approx(40.0 * 1.6 / 2.6, rel=1e-3)
    assert pid["Yi"] == 0


def test_the_range_of_w_and_x_changes_the_gain(plc):
    pid = controller(plc, Tn=0.0, WX_max=200.0, WX_min=0.0)
    pid(enable=True, mode=1, W=30.0, X=10.0)
    assert (pid["Y"], pid["e"]) == (pytest.approx(20.0), 20.0)


@pytest.mark.parametrize("feedback", [0.0, 1.0])
def test_the_integral_does_not_wind_up_where_the_goal_is_out_of_reach(plc, feedback):
    pid = controller(plc, Kfbk=feedback)
    assert controlled(plc, pid, 60, 95.0)[-1] == pytest.approx(80.0, abs=0.1)
    assert pid["Y"] == 100.0
    values = controlled(plc, pid, 10, 40.0, start=80.0)
    assert values[-1] == pytest.approx(40.0, abs=0.5)
    assert next(n for n, x in enumerate(values) if x < 50) < 300


def test_inverted_it_cools(plc):
    pid = controller(plc, invert=True, Tn=0.0)
    pid(enable=True, mode=1, W=20.0, X=30.0)
    assert pid["Y"] == pytest.approx(20.0)


def test_modes(plc):
    pid = controller(plc)
    controlled(plc, pid, 20, 40.0)
    held = pid["Y"]
    assert pid(mode=5, X=0.0)["Y"] == held
    assert pid(mode=3)["Y"] == 100
    assert pid(mode=4)["Y"] == 0
    assert pid(mode=2, Y_man=33.0)["Y"] == 33
    assert pid(mode=102, Y_man=70.0, X=40.0)["Y"] == 70
    plc.later()
    assert pid(mode=1)["Y"] == pytest.approx(70.0, abs=0.5)
    assert (pid(mode=0)["Y"], pid["Yi"]) == (0, 0)
    assert pid(mode=7)["status"] == 31553


def test_the_derivative_acts_against_a_change_of_x(plc):
    pid = controller(plc, Kp=1.0, Tn=0.0, Tv=1.0, Tf=0.09)
    pid(enable=True, mode=1, W=50.0, X=10.0)
    plc.later()
    pid(X=10.5)
    assert pid["Yd"] == pytest.approx(-5.0)
    plc.later()
    assert pid(X=10.5)["Yd"] == pytest.approx(-4.5)


def test_y_changes_by_no_more_than_its_rate(plc):
    pid = controller(plc, dY_max=50.0)
    pid(enable=True, mode=1, W=90.0, X=0.0)
    plc.later(100)
    assert pid()["Y"] == pytest.approx(5.0)


@pytest.mark.parametrize(
    ("wrong", "status"),
    [
        ({"Kp": 0.0}, 12026),
        ({"Kp": 1.0, "Tn": -1.0}, 12029),
        ({"Kp": 1.0, "Tv": -1.0}, 12030),
        ({"Kp": 1.0, "Tf": -1.0}, 12028),
        ({"Kp": 1.0, "WX_min": 5.0, "WX_max": 5.0}, 12043),
        ({"Kp": 1.0, "fbk_mode": 6}, 31558),
    ],
)
def test_parameters_that_are_wrong_are_told_and_not_taken(plc, wrong, status):
    para = plc.block("LCRPIDpara")
    para(enable=True, enter=True, **wrong)
    assert (para["status"], para["ident"]) == (status, 0)


def test_a_controller_without_parameters_or_limits_or_enable(plc):
    pid = plc.block("LCRPID")
    assert pid(enable=True, mode=1, Y_max=100.0)["status"] == 31552
    pid = controller(plc)
    assert pid(enable=True, mode=1, Y_min=100.0)["status"] == 12037
    assert pid(enable=False)["status"] == ERR_FUB_ENABLE_FALSE
    assert pid["Y"] == 0


def test_a_controller_whose_parameters_lie_elsewhere(plc):
    parameters = plc.memory.allocate(SLIM.size)
    for number, value in enumerate([100.0, 0.0, 2.0, 1.0, 0.0, 1.0]):
        plc.memory.set(REAL, parameters + 4 * number, value)
    inputs = [Member(n, KINDS.get(n, REAL), section=Section.INPUT) for n in ("enable", "W", "X")]
    inputs.append(Member("request", UDINT, section=Section.INPUT))
    inputs.append(Member("pPar", ReferenceType(SLIM), section=Section.INPUT))
    outputs = [Member(n, KINDS.get(n, REAL), section=Section.OUTPUT) for n in ("e", "Y", "status")]
    pid = plc.block("LCRSlimPID", *inputs, *outputs)
    assert pid(enable=True)["status"] == 31563
    pid(pPar=parameters)
    x = 0.0
    for _ in range(2000):
        pid(W=40.0, X=x)
        x += (0.8 * pid["Y"] - x) * 0.005
        plc.later()
    assert x == pytest.approx(40.0, abs=0.01)
    assert pid(request=1)["status"] == 31559


def test_a_ramp_goes_up_and_down_by_its_rates(plc):
    ramp = plc.block("LCRRamp")
    ramp(enable=True, x=5.0, dy_up=10.0, dy_down=20.0, y_max=3.0, y_min=-1.0)
    plc.later(100)
    assert (ramp()["y"], ramp["x_reached"], ramp["max_limit"]) == (pytest.approx(1.0), False, False)
    plc.later(500)
    assert (ramp()["y"], ramp["max_limit"]) == (3.0, True)
    plc.later(100)
    assert ramp(x=0.5)["y"] == pytest.approx(1.0)
    plc.later(100)
    assert (ramp()["y"], ramp["x_reached"]) == (0.5, True)
    assert ramp(set=True, y_set=2.0)["y"] == 2.0
    assert ramp(set=False, dy_up=-1.0)["status"] == 12034
    assert ramp(y_min=9.0)["status"] == 12037


@pytest.mark.parametrize(
    ("name", "inputs", "y"),
    [
        ("LCRPT1", {"t": 2.0, "x": 10.0}, 10 * (1 - math.exp(-0.5))),
        ("LCRPT1e", {"T1": 2.0, "V": 3.0, "x": 10.0}, 30 * (1 - math.exp(-0.5))),
        ("LCRPT2", {"T1": 0.0, "T2": 2.0, "V": 1.0, "x": 10.0}, 10 * (1 - math.exp(-0.5))),
        ("LCRIntegrate", {"tn": 2.0, "x": 10.0, "y_max": 100.0}, 5.0),
        ("LCRDifferentiate", {"tv": 2.0, "x": 10.0}, 0.0),
    ],
)
def test_after_a_second(plc, name, inputs, y):
    block = plc.block(name)
    block(enable=True, **inputs)
    for _ in range(100):
        plc.later()
        block()
    assert block["y"] == pytest.approx(y, rel=1e-5)
    assert block(enable=False)["y"] == 0


def test_the_rate_of_a_signal_that_rises(plc):
    block = plc.block("LCRDifferentiate")
    for n in range(50):
        block(enable=True, tv=1.0, tf=0.05, x=0.3 * n)
        plc.later()
    assert block["y"] == pytest.approx(30.0, rel=0.01)


def test_the_extremes_since_reset(plc):
    block = plc.block("LCRMinMax")
    for value in (3.0, -1.0, 2.0):
        block(**{"in": value})
    assert (block["out_min"], block["out_max"]) == (-1.0, 3.0)
    block(reset=True)
    assert (block["out_min"], block["out_max"]) == (2.0, 2.0)


@pytest.mark.parametrize(
    ("x", "share"), [(0.0, 0), (25.0, 25), (100.0, 100), (2.0, 0), (99.0, 100)]
)
def test_pulses_have_the_share_of_the_signal(plc, x, share):
    block = plc.block("LCRPWM")
    on = 0
    for _ in range(200):
        block(enable=True, x=x, max_value=100.0, t_period=1.0, t_min_pulse=0.05)
        on += block["pulse"]
        plc.later()
    assert on == 2 * share


def test_a_curve_by_points(plc):
    table = plc.memory.allocate(24)
    for number, value in enumerate([0.0, 1.0, 2.0, 5.0, 3.0, 4.0]):
        plc.memory.set(REAL, table + 4 * number, value)
    block = plc.block("LCRCurveByPoints")
    assert block(NoOfPoints=3)["status"] == 31563
    values = [block(ptr_table=table, x=x)["y"] for x in (1.0, 2.0, 2.5, 3.0, -1.0, 4.0)]
    assert values == [3.0, 5.0, 4.5, 4.0, -1.0, 3.0]
    assert block(NoOfPoints=1)["status"] == 12045
