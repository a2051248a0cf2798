"""Blocks of the MT libraries (MTBasics, MTFilter, MTLookUp, MTData) beside those with bodies.

Parameters are taken over when a block is enabled, and by a rising edge of Update. Filters are those
of Butterworth, whatever Type is, and begin at 0.
"""

from __future__ import annotations

import cmath
import math
from functools import cache
from typing import TYPE_CHECKING, ClassVar, Final, NamedTuple

from plcsim.library.loops.block import OK, LoopBlock, LoopState
from plcsim.library.loops.signals import between, delayed, delayed_twice, differentiated
from plcsim.library.members import rises

if TYPE_CHECKING:
    from collections.abc import Mapping

    from plcsim.library.members import BlockVariables

HIGHEST_ORDER: Final = 10
LONGEST_WINDOW: Final = 10_000


class TechnologyBlock(LoopBlock):
    """A block of the MT libraries.

    Attributes:
        parameters: inputs that are taken over.
    """

    outputs: ClassVar[tuple[str, ...]] = ("Out", "Active", "Error", "StatusID", "UpdateDone")
    parameters: ClassVar[tuple[str, ...]] = ()

    def step(self, address: int, variables: BlockVariables, state: LoopState, step_s: float) -> int:
        """Take parameters over, and calculate."""
        updates = rises(self.context, address, variables, "Update")
        if updates or state.last_ns is None:
            for name in self.parameters:
                state[name] = variables.number(name)
        self.calculate(variables, state, step_s)
        variables.set(Active=True, UpdateDone=variables.is_true("Update"))
        return OK

    def calculate(self, variables: BlockVariables, state: LoopState, step_s: float) -> None:
        """Calculate one call."""
        raise NotImplementedError(type(self).__name__)


class _Section(NamedTuple):
    """One part of a filter: (b0 + b1/z + b2/z²) / (1 + a1/z + a2/z²)."""

    b0: float
    b1: float
    b2: float
    a1: float
    a2: float


@cache
def _sections(order: int, ratio: float, *, is_high: bool) -> tuple[_Section, ...]:
    """Return the parts of a Butterworth filter by the bilinear transform.

    Args:
        order: of it.
        ratio: cut-off frequency to that of the calls, below 0.5.
        is_high: it lets what is above pass.
    """
    warped = math.tan(math.pi * ratio)
    found = []
    for number in range(order // 2):
        pole = cmath.exp(1j * math.pi * (2 * number + 1 + order) / (2 * order))
        damping = -2.0 * pole.real * warped
        scale = 1.0 + damping + warped * warped
        first = (1.0 if is_high else warped * warped) / scale
        middle = -2.0 * first if is_high else 2.0 * first
        a1, a2 = 2.0 * (warped * warped - 1.0), 1.0 - damping + warped * warped
        found.append(_Section(first, middle, first, a1 / scale, a2 / scale))
    if order % 2:
        first = (1.0 if is_high else warped) / (1.0 + warped)
        second = -first if is_high else first
        found.append(_Section(first, second, 0.0, (warped - 1.0) / (warped + 1.0), 0.0))
    return tuple(found)


class LowPass(TechnologyBlock):
    """MTFilterLowPass: CutOffFrequency in Hz, of Order; what cannot be filtered goes through."""

    parameters: ClassVar[tuple[str, ...]] = ("Order", "CutOffFrequency")
    is_high: ClassVar[bool] = False

    def calculate(self, variables: BlockVariables, state: LoopState, step_s: float) -> None:
        """Filter a value."""
        value, ratio = variables.number("In"), state["CutOffFrequency"] * step_s
        order = min(max(int(state["Order"]), 1), HIGHEST_ORDER)
        if step_s > 0 and 0 < ratio < 0.5:  # of Nyquist
            for number, part in enumerate(_sections(order, round(ratio, 9), is_high=self.is_high)):
                first, second = f"first {number}", f"second {number}"
                out = part.b0 * value + state[first]
                state[first] = part.b1 * value - part.a1 * out + state[second]
                state[second] = part.b2 * value - part.a2 * out
                value = out
        elif step_s <= 0:
            value = 0.0
        variables.set(Out=value)


class HighPass(LowPass):
    """MTFilterHighPass."""

    is_high: ClassVar[bool] = True


class TechnologyDelay2(TechnologyBlock):
    """MTBasicsPT2: two delays one behind the other, with Gain; SetOut puts Out to its preset."""

    parameters: ClassVar[tuple[str, ...]] = ("Gain", "TimeConstant1", "TimeConstant2")

    def calculate(self, variables: BlockVariables, state: LoopState, step_s: float) -> None:
        """Go on by a step."""
        target = state["Gain"] * variables.number("In")
        times_s = state["TimeConstant1"], state["TimeConstant2"]
        preset = variables.number("OutPresetValue") if variables.is_true("SetOut") else None
        variables.set(Out=delayed_twice(state, target, times_s, step_s, preset))


class Rate1(TechnologyBlock):
    """MTBasicsDT1: the rate of In, times Gain, with a delay; the first value has none."""

    parameters: ClassVar[tuple[str, ...]] = ("Gain", "TimeConstant")

    def calculate(self, variables: BlockVariables, state: LoopState, step_s: float) -> None:
        """Go on by a step."""
        variables.set(Out=self.rate(variables, state, state["TimeConstant"], step_s))

    @staticmethod
    def rate(variables: BlockVariables, state: LoopState, filter_s: float, step_s: float) -> float:
        """Return the rate with a delay."""
        value = variables.number("In")
        change = state["Gain"] * (value - state.values.get("x", value))
        state["x"] = value
        state["rate"] = differentiated(state["rate"], change, filter_s, step_s)
        return state["rate"]


class Rate2(Rate1):
    """MTBasicsDT2: likewise, with one more delay."""

    parameters: ClassVar[tuple[str, ...]] = ("Gain", "TimeConstant1", "TimeConstant2")

    def calculate(self, variables: BlockVariables, state: LoopState, step_s: float) -> None:
        """Go on by a step."""
        rate = self.rate(variables, state, state["TimeConstant1"], step_s)
        state["y"] = delayed(state["y"], rate, state["TimeConstant2"], step_s)
        variables.set(Out=state["y"])


class Sum(TechnologyBlock):
    """MTBasicsIntegrator: Out grows by Gain * In in a second."""

    parameters: ClassVar[tuple[str, ...]] = ("Gain",)

    def calculate(self, variables: BlockVariables, state: LoopState, step_s: float) -> None:
        """Go on by a step."""
        if not variables.is_true("HoldOut"):
            state["y"] += state["Gain"] * variables.number("In") * step_s
        if variables.is_true("SetOut"):
            state["y"] = variables.number("OutPresetValue")
        variables.set(Out=state["y"])


class LookUp(TechnologyBlock):
    """MTLookUpTable: on the straight lines between nodes, and the last value beyond them."""

    def calculate(self, variables: BlockVariables, _state: LoopState, _step_s: float) -> None:
        """Look it up."""
        count = min(int(variables.number("NumberOfNodes")), variables.count_of("NodeVectorX"))
        x = variables.number("InX")
        nodes = [
            (variables.element("NodeVectorX", n), variables.element("FcnValues", n))
            for n in range(count)
        ]
        below = next((n for n in reversed(range(count)) if nodes[n][0] <= x), None)
        if not nodes:
            value = 0.0
        elif below is None or below == count - 1:
            value = nodes[below or 0][1]
        else:
            value = between(x, *nodes[below : below + 2])
        variables.set(Out=value)


class Statistics(TechnologyBlock):
    """MTDataStatistics and its parts: of all values since Reset, or of the latest of a window.

    Variance is that of a sample; indices count from 0.
    """

    outputs: ClassVar[tuple[str, ...]] = (
        *TechnologyBlock.outputs,
        *("MinValue", "MaxValue", "Mean", "RMS", "Variance", "StdDeviation"),
    )
    parameters: ClassVar[tuple[str, ...]] = ("MovingWindowLength",)
    shown: ClassVar[str] = ""

    def calculate(self, variables: BlockVariables, state: LoopState, _step_s: float) -> None:
        """Take a value."""
        if variables.is_true("Reset"):
            state.history.clear()
        state.history.append(variables.number("In"))
        longest = int(state["MovingWindowLength"]) or LONGEST_WINDOW
        del state.history[: -min(longest, LONGEST_WINDOW)]
        values = state.history
        mean = math.fsum(values) / len(values)
        squares = math.fsum((each - mean) ** 2 for each in values)
        variance = squares / (len(values) - 1) if len(values) > 1 else 0.0
        found: dict[str, float] = {
            "MinValue": min(values),
            "IndexMinValue": values.index(min(values)),
            "MaxValue": max(values),
            "IndexMaxValue": values.index(max(values)),
            "Mean": mean,
            "RMS": math.sqrt(math.fsum(each * each for each in values) / len(values)),
            "Variance": variance,
            "StdDeviation": math.sqrt(variance),
        }
        variables.set(**found)
        if self.shown:
            variables.set(Out=found[self.shown])


class Mean(Statistics):
    """MTDataMean."""

    shown: ClassVar[str] = "Mean"


class RootMeanSquare(Statistics):
    """MTDataRMS."""

    shown: ClassVar[str] = "RMS"


class Variance(Statistics):
    """MTDataVariance."""

    shown: ClassVar[str] = "Variance"


class Deviation(Statistics):
    """MTDataStdDeviation."""

    shown: ClassVar[str] = "StdDeviation"


BLOCKS: Final[Mapping[str, type[LoopBlock]]] = {
    "MTFilterLowPass": LowPass,
    "MTFilterHighPass": HighPass,
    "MTBasicsPT2": TechnologyDelay2,
    "MTBasicsDT1": Rate1,
    "MTBasicsDT2": Rate2,
    "MTBasicsIntegrator": Sum,
    "MTLookUpTable": LookUp,
    "MTDataStatistics": Statistics,
    "MTDataMinMax": Statistics,
    "MTDataMean": Mean,
    "MTDataRMS": RootMeanSquare,
    "MTDataVariance": Variance,
    "MTDataStdDeviation": Deviation,
}
"""What runs the blocks by their names."""
