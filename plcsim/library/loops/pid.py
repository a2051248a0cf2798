"""The PID controller of LoopConR: LCRPIDpara takes its parameters, LCRPID calculates.

In percent of what lies from WX_min to WX_max, with e = W - X (both negated by invert)::

    Yp = Kp * (Kw * W - X)
    Yi = Yi + Kp / Tn * e * h                       (0 for Tn = 0)
    Yd = (Tf * Yd - Kp * Tv * (X - X before)) / (Tf + h)    (e instead of -X for d_mode E)
    Y  = Yp + Yi + Yd + A, within Y_min and Y_max, by at most dY_max in a second

Yi is taken back by ``Kfbk / Tn * h`` times what was cut off of Y (of Y_fbk in the modes that have
it). Without Kfbk it does not grow where Y is at a limit.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar, Final

from plcsim.library.loops.block import (
    LCR_ERR_LCRPID_IDENT,
    LCR_ERR_LCRPID_MODE,
    LCR_ERR_LCRPID_PAR_DEADBAND,
    LCR_ERR_LCRPID_PAR_DMODE,
    LCR_ERR_LCRPID_PAR_DYMAX,
    LCR_ERR_LCRPID_PAR_FBKMODE,
    LCR_ERR_LCRPID_PAR_KP,
    LCR_ERR_LCRPID_PAR_TF,
    LCR_ERR_LCRPID_PAR_TN,
    LCR_ERR_LCRPID_PAR_TV,
    LCR_ERR_LCRPID_PAR_WX_MAXMIN,
    LCR_ERR_MAXMIN,
    LCR_ERR_POINTER,
    OK,
    LCR_ERR_LCRPIDTune_INVALID_REQU,
    LoopBlock,
    LoopState,
    limited,
)
from plcsim.library.loops.signals import differentiated
from plcsim.library.members import ReferredStructure

if TYPE_CHECKING:
    from collections.abc import Mapping
    from typing import Any

    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables, FindType
    from st_types.types.derived import StructType

OFF: Final = 0
AUTO: Final = 1
MANUAL: Final = 2
OPEN: Final = 3
CLOSE: Final = 4
FREEZE: Final = 5
JOLTFREE: Final = 100
"""Modes of LCRPID; added to one, Yi follows, so that AUTO goes on from there."""

FROM_X: Final = 1
FROM_E: Final = 2
"""What the derivative is of; 0 counts as the first."""

INTERN: Final = 1
EXTERN: Final = (2, 3)
MOST_FBK_MODE: Final = 5

NO_REQUEST: Final = (0, 3, 4)
"""Requests of LCRSlimPID that do not tune: off, read and write parameters."""


@dataclass(frozen=True)
class PidParameters:
    """The parameters of a controller; what is left out is its default.

    Attributes:
        gain: Kp.
        integration_s: Tn, 0 for no integral.
        derivative_s: Tv, 0 for no derivative.
        feedback: Kfbk.
        filter_s: Tf.
        weight: Kw, of W in the proportional part.
        least: WX_min, 0 percent.
        most: WX_max, 100 percent.
        deadband: difference that counts as none.
        slew: dY_max in a second, 0 for no limit.
        is_inverted: Y falls where X is too small.
        fbk_mode: what Kfbk is of.
        d_mode: what the derivative is of.
    """

    gain: float
    integration_s: float
    derivative_s: float
    feedback: float
    filter_s: float = 0.0
    weight: float = 1.0
    least: float = 0.0
    most: float = 100.0
    deadband: float = 0.0
    slew: float = 0.0
    is_inverted: bool = False
    fbk_mode: int = INTERN
    d_mode: int = FROM_X


class _Controllers:
    """The parameters of a controller by ident: the address of the block that took them."""

    def __init__(self, _context: Context) -> None:
        self.by_ident: dict[int, PidParameters] = {}


def _taken(variables: BlockVariables) -> PidParameters:
    """Return the parameters that LCRPIDpara has."""
    number = variables.number
    has_range = number("WX_min") != 0 or number("WX_max") != 0
    return PidParameters(
        number("Kp"),
        number("Tn"),
        number("Tv"),
        number("Kfbk"),
        number("Tf"),
        number("Kw"),
        number("WX_min"),
        number("WX_max") if has_range else 100.0,
        number("deadband"),
        number("dY_max"),
        variables.is_true("invert"),
        int(number("fbk_mode")),
        int(number("d_mode")),
    )


class Parameters(LoopBlock):
    """LCRPIDpara: takes the parameters while enter is TRUE, and gives their ident.

    WX_min and WX_max that are both 0 are 0 and 100.
    """

    outputs: ClassVar[tuple[str, ...]] = ("ident",)

    def step(
        self, address: int, variables: BlockVariables, state: LoopState, _step_s: float
    ) -> int:
        """Take them, or say what is wrong with them."""
        if variables.is_true("enter"):
            parameters = _taken(variables)
            state["status"] = _wrong(parameters)
            if not state["status"]:
                self.context.library(_Controllers).by_ident[address] = parameters
        is_known = address in self.context.library(_Controllers).by_ident
        variables.set(ident=address if is_known else 0)
        return int(state["status"])


def _wrong(given: PidParameters) -> int:
    """Return a status for the first parameter that is wrong."""
    checks = (
        (given.most > given.least, LCR_ERR_LCRPID_PAR_WX_MAXMIN),
        (given.deadband >= 0, LCR_ERR_LCRPID_PAR_DEADBAND),
        (given.slew >= 0, LCR_ERR_LCRPID_PAR_DYMAX),
        (given.gain > 0, LCR_ERR_LCRPID_PAR_KP),
        (given.integration_s >= 0, LCR_ERR_LCRPID_PAR_TN),
        (given.derivative_s >= 0, LCR_ERR_LCRPID_PAR_TV),
        (given.filter_s >= 0, LCR_ERR_LCRPID_PAR_TF),
        (given.fbk_mode <= MOST_FBK_MODE, LCR_ERR_LCRPID_PAR_FBKMODE),
        (given.d_mode <= FROM_E, LCR_ERR_LCRPID_PAR_DMODE),
    )
    return next((status for is_right, status in checks if not is_right), OK)


class PidController(LoopBlock):
    """LCRPID.

    MAN gives Y_man, OPEN Y_max, CLOSE Y_min, FREEZE what Y was, OFF 0 without a past.
    """

    outputs: ClassVar[tuple[str, ...]] = ("Y", "Yp", "Yi", "Yd", "e")

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Calculate Y."""
        ident = int(variables.number("ident"))
        given = self.context.library(_Controllers).by_ident.get(ident)
        if given is None:
            return LCR_ERR_LCRPID_IDENT
        low, high = variables.number("Y_min"), variables.number("Y_max")
        if low >= high:
            return LCR_ERR_MAXMIN
        mode = int(variables.number("mode"))
        if mode == OFF:
            state.values.clear()
            variables.set(**dict.fromkeys(self.outputs, 0))
            return OK
        if mode % JOLTFREE not in range(AUTO, FREEZE + 1) or mode > JOLTFREE + FREEZE:
            return LCR_ERR_LCRPID_MODE
        self.calculate(variables, state, given, (mode, low, high), step_s)
        return OK

    def calculate(
        self,
        variables: BlockVariables,
        state: LoopState,
        given: PidParameters,
        mode_and_limits: tuple[int, float, float],
        step_s: float,
    ) -> None:
        """Calculate Y of parameters that are right, in a mode and within limits."""
        mode, low, high = mode_and_limits
        error = _parts(variables, state, given, step_s)
        rest = state["Yp"] + state["Yd"] + variables.number("A")
        if mode == AUTO:
            if not variables.is_true("hold_I"):
                _integrate(state, given, error, (rest, low, high), step_s)
            y = limited(rest + state["Yi"], low, high)
        else:
            fixed = {MANUAL: variables.number("Y_man"), OPEN: high, CLOSE: low}
            y = limited(fixed.get(mode % JOLTFREE, state["Y"]), low, high)
        if given.slew > 0 and mode != MANUAL:
            most = given.slew * step_s
            y = limited(y, state["Y"] - most, state["Y"] + most)
        if mode > JOLTFREE:
            state["Yi"] = y - rest
        used = variables.number("Y_fbk") if given.fbk_mode in EXTERN else y
        state["cut"] = used - (rest + state["Yi"])
        state["Y"] = y
        variables.set(Y=y, e=error, Yp=state["Yp"], Yi=state["Yi"], Yd=state["Yd"])


def _parts(
    variables: BlockVariables, state: LoopState, given: PidParameters, step_s: float
) -> float:
    """Calculate the proportional part and the derivative; return the difference W - X."""
    percent = 100.0 / (given.most - given.least) * (-1.0 if given.is_inverted else 1.0)
    w, x = variables.number("W"), variables.number("X")
    error = w - x
    if abs(error) <= given.deadband:
        error, w = 0.0, x
    state["percent"] = percent
    state["Yp"] = given.gain * (given.weight * w - x + (1.0 - given.weight) * given.least) * percent
    signal = (error if given.d_mode == FROM_E else -x) * percent
    change = (
        0.0 if state.last_ns is None or "signal" not in state.values else signal - state["signal"]
    )
    state["signal"] = signal
    state["Yd"] = (
        differentiated(
            state["Yd"], given.gain * given.derivative_s * change, given.filter_s, step_s
        )
        if given.derivative_s > 0
        else 0.0
    )
    return error


def _integrate(
    state: LoopState,
    given: PidParameters,
    error: float,
    rest_and_limits: tuple[float, float, float],
    step_s: float,
) -> None:
    """Let Yi grow by a step."""
    if given.integration_s <= 0:
        state["Yi"] = 0.0
        return
    rest, low, high = rest_and_limits
    growth = given.gain / given.integration_s * error * state["percent"] * step_s
    if given.feedback > 0:
        growth += min(given.feedback * step_s / given.integration_s, 1.0) * state["cut"]
    elif limited(rest + state["Yi"] + growth, low, high) != rest + state["Yi"] + growth:
        sum_ = rest + state["Yi"]
        growth = limited(growth, min(low - sum_, 0.0), max(high - sum_, 0.0))
    state["Yi"] += growth


class SlimController(PidController):
    """LCRSlimPID: a controller whose parameters lie at pPar; it does not tune itself."""

    outputs: ClassVar[tuple[str, ...]] = ("Y", "e")

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._parameters = ReferredStructure(data_type, "pPar")

    def step(
        self, _address: int, variables: BlockVariables, state: LoopState, step_s: float
    ) -> int:
        """Calculate Y."""
        values = self._parameters.of(self.context.memory, variables)
        if values is None:
            return LCR_ERR_POINTER
        if variables.number("request") not in NO_REQUEST:
            return LCR_ERR_LCRPIDTune_INVALID_REQU
        gain, feedback = values.number("Kp"), values.number("Kfbk")
        given = PidParameters(gain, values.number("Tn"), values.number("Tv"), feedback)
        low, high = values.number("Y_min"), values.number("Y_max")
        status = _wrong(given) or (LCR_ERR_MAXMIN if low >= high else OK)
        if not status:
            self.calculate(variables, state, given, (AUTO, low, high), step_s)
        return status


BLOCKS: Final[Mapping[str, type[LoopBlock]]] = {
    "LCRPIDpara": Parameters,
    "LCRPID": PidController,
    "LCRSlimPID": SlimController,
}
"""What runs the blocks by their names."""
