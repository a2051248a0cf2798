"""Ramps, delays, integrals and pulses of LoopConR."""

from __future__ import annotations

import itertools
import math
import struct
from typing import TYPE_CHECKING, ClassVar, Final

from plcsim.library.loops.block import (
    LCR_ERR_LCRPT1_T,
    LCR_ERR_LCRPT12_T1_NEG,
    LCR_ERR_LCRPT12_T2_NEG,
    LCR_ERR_LCRPWM_TMINPULSE,
    LCR_ERR_LCRPWM_TPERIOD,
    LCR_ERR_MAXMIN,
    LCR_ERR_POINTER,
    OK,
    LCR_ERR_LCRCurveByPoints_TABLE,
    LCR_ERR_LCRIntegrate_TN,
    LCR_ERR_LCRRamp_DYUP_DYDOWN,
    LoopBlock,
    LoopState,
    limited,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.library.members import BlockVariables

_POINT: Final = struct.Struct("<ff")


class Ramp(LoopBlock):
    """LCRRamp: y follows x by at most dy_up and dy_down in a second, within y_min and y_max."""

    outputs: ClassVar[tuple[str, ...]] = ("y", "x_reached", "max_limit", "min_limit")

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Go on by a step."""
        low, high = variables.number("y_min"), variables.number("y_max")
        up, down = variables.number("dy_up"), variables.number("dy_down")
        if low >= high:
            return LCR_ERR_MAXMIN
        if up < 0 or down < 0:
            return LCR_ERR_LCRRamp_DYUP_DYDOWN
        x = variables.number("x")
        y = limited(x, state["y"] - down * step_s, state["y"] + up * step_s)
        if variables.is_true("set"):
            y = variables.number("y_set")
        state["y"] = held = limited(y, low, high)
        variables.set(y=held, x_reached=held == x, max_limit=held >= high, min_limit=held <= low)
        return OK


class Delay1(LoopBlock):
    """LCRPT1, LCRPT1e: a delay of first order, exact for an x that is held, with gain V."""

    time: ClassVar[str] = "t"
    status: ClassVar[int] = LCR_ERR_LCRPT1_T

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Go on by a step."""
        time_s = variables.number(self.time)
        if time_s < 0:
            return self.status
        state["y"] = delayed(state["y"], self.target(variables), time_s, step_s)
        if variables.is_true("set"):
            state["y"] = variables.number("y_set")
        variables.set(y=state["y"])
        return OK

    def target(self, variables: BlockVariables) -> float:
        """Return where y goes."""
        return variables.number("x")


class Delay1WithGain(Delay1):
    """LCRPT1e."""

    time: ClassVar[str] = "T1"
    status: ClassVar[int] = LCR_ERR_LCRPT12_T1_NEG

    def target(self, variables: BlockVariables) -> float:
        """Return where y goes."""
        return variables.number("V") * variables.number("x")


class Delay2(LoopBlock):
    """LCRPT2: two delays of first order, one behind the other, with gain V."""

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Go on by a step."""
        first_s, second_s = variables.number("T1"), variables.number("T2")
        if first_s < 0:
            return LCR_ERR_LCRPT12_T1_NEG
        if second_s < 0:
            return LCR_ERR_LCRPT12_T2_NEG
        target = variables.number("V") * variables.number("x")
        preset = variables.number("y_set") if variables.is_true("set") else None
        variables.set(y=delayed_twice(state, target, (first_s, second_s), step_s, preset))
        return OK


def delayed(value: float, target: float, time_s: float, step_s: float) -> float:
    """Return a value that goes to a target with a time constant, after a step."""
    rest = math.exp(-step_s / time_s) if time_s > 0 else 0.0
    return target + (value - target) * rest


def delayed_twice(
    state: LoopState,
    target: float,
    times_s: tuple[float, float],
    step_s: float,
    preset: float | None,
) -> float:
    """Return a value behind two delays, one behind the other, after a step.

    Args:
        state: of the block.
        target: where the first goes.
        times_s: their time constants.
        step_s: seconds since the call before.
        preset: what both are put to, None where they are not.
    """
    state["x"] = delayed(state["x"], target, times_s[0], step_s)
    state["y"] = delayed(state["y"], state["x"], times_s[1], step_s)
    if preset is not None:
        state["x"] = state["y"] = preset
    return state["y"]


class Integral(LoopBlock):
    """LCRIntegrate: y grows by x / tn in a second, within y_min and y_max."""

    outputs: ClassVar[tuple[str, ...]] = ("y", "max_limit", "min_limit")

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Go on by a step."""
        time_s = variables.number("tn")
        low, high = variables.number("y_min"), variables.number("y_max")
        if time_s <= 0:
            return LCR_ERR_LCRIntegrate_TN
        if low >= high:
            return LCR_ERR_MAXMIN
        y = state["y"] + variables.number("x") * step_s / time_s
        if variables.is_true("set"):
            y = variables.number("y_set")
        state["y"] = held = limited(y, low, high)
        variables.set(y=held, max_limit=held >= high, min_limit=held <= low)
        return OK


class Derivative(LoopBlock):
    """LCRDifferentiate: the rate of x in a second, times tv, with a delay of tf."""

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Go on by a step; the first value has no rate."""
        x = variables.number("x")
        change = 0.0 if state.last_ns is None else x - state["x"]
        state["x"] = x
        state["y"] = differentiated(
            state["y"], variables.number("tv") * change, variables.number("tf"), step_s
        )
        variables.set(y=state["y"])
        return OK


def differentiated(value: float, change: float, filter_s: float, step_s: float) -> float:
    """Return a filtered rate after a step in which its signal has changed."""
    span = max(filter_s, 0.0) + step_s
    return (max(filter_s, 0.0) * value + change) / span if span > 0 else value


class Extremes(LoopBlock):
    """LCRMinMax: the smallest and the largest value since reset."""

    def is_enabled(self, _variables: BlockVariables) -> bool:
        """It has no enable."""
        return True

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, _step_s: float
    ) -> int:
        """Take a value."""
        value = variables.number("in")
        if variables.is_true("reset") or state.last_ns is None:
            state["low"] = state["high"] = value
        state["low"], state["high"] = min(state["low"], value), max(state["high"], value)
        variables.set(out_min=state["low"], out_max=state["high"])
        return OK


class PulseWidth(LoopBlock):
    """LCRPWM: TRUE for the part of t_period that x is of what lies from min_value to max_value.

    A pulse, or a pause, that is shorter than t_min_pulse is left out.
    """

    outputs: ClassVar[tuple[str, ...]] = ("pulse", "t_on", "t_off")

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Go on by a step; a period keeps the width that it began with."""
        low, high = variables.number("min_value"), variables.number("max_value")
        period, least = variables.number("t_period"), variables.number("t_min_pulse")
        if low >= high:
            return LCR_ERR_MAXMIN
        if period <= 0:
            return LCR_ERR_LCRPWM_TPERIOD
        if least < 0 or least > period:
            return LCR_ERR_LCRPWM_TMINPULSE
        passed = state["passed"] + step_s
        if state.last_ns is None or passed >= period:
            share = (limited(variables.number("x"), low, high) - low) / (high - low)
            on = share * period
            on = 0.0 if on < least else period if period - on < least else on
            state["on"], passed = on, passed % period
        state["passed"] = passed
        variables.set(pulse=passed < state["on"], t_on=state["on"], t_off=period - state["on"])
        return OK


class Curve(LoopBlock):
    """LCRCurveByPoints: y on the straight lines between points, and on beyond them."""

    def is_enabled(self, _variables: BlockVariables) -> bool:
        """It has no enable."""
        return True

    def step(
        self, _address: int, variables: BlockVariables, _state: LoopState, _step_s: float
    ) -> int:
        """Look it up."""
        at, count = variables.address("ptr_table"), int(variables.number("NoOfPoints"))
        if not at:
            return LCR_ERR_POINTER
        data = self.context.memory.read(at, count * _POINT.size)
        points = list(_POINT.iter_unpack(data))
        has_line = len(points) > 1
        if not has_line or any(a[0] >= b[0] for a, b in itertools.pairwise(points)):
            return LCR_ERR_LCRCurveByPoints_TABLE
        x = variables.number("x")
        index = next((n for n, point in enumerate(points[1:-1]) if x < point[0]), len(points) - 2)
        variables.set(y=between(x, *points[index : index + 2]))
        return OK


def between(x: float, first: tuple[float, float], second: tuple[float, float]) -> float:
    """Return y at x on the straight line through two points."""
    (x1, y1), (x2, y2) = first, second
    return y1 + (x - x1) * (y2 - y1) / (x2 - x1)


BLOCKS: Final[Mapping[str, type[LoopBlock]]] = {
    "LCRRamp": Ramp,
    "LCRPT1": Delay1,
    "LCRPT1e": Delay1WithGain,
    "LCRPT2": Delay2,
    "LCRIntegrate": Integral,
    "LCRDifferentiate": Derivative,
    "LCRMinMax": Extremes,
    "LCRPWM": PulseWidth,
    "LCRCurveByPoints": Curve,
}
"""What runs the blocks by their names."""
