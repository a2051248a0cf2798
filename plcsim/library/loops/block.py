"""What the blocks share: enable, status, the time since the call before, and what each keeps."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, ClassVar, Final

from plcsim.library.astime.structures import NS_PER_SECOND
from plcsim.library.block_model import BlockModel
from plcsim.library.runtime import ERR_FUB_ENABLE_FALSE, ERR_OK

if TYPE_CHECKING:
    from plcsim.core.context import Context
    from plcsim.library.members import BlockVariables

LCR_ERR_LCRPID_PAR_KP: Final = 12026
LCR_ERR_LCRPID_PAR_TF: Final = 12028
LCR_ERR_LCRPID_PAR_TN: Final = 12029
LCR_ERR_LCRPID_PAR_TV: Final = 12030
LCR_ERR_LCRPT1_T: Final = 12031
LCR_ERR_LCRPWM_TMINPULSE: Final = 12032
LCR_ERR_LCRPWM_TPERIOD: Final = 12033
LCR_ERR_LCRRamp_DYUP_DYDOWN: Final = 12034
LCR_ERR_MAXMIN: Final = 12037
LCR_ERR_LCRPID_PAR_WX_MAXMIN: Final = 12043
LCR_ERR_LCRPID_PAR_DEADBAND: Final = 12044
LCR_ERR_LCRCurveByPoints_TABLE: Final = 12045
LCR_ERR_LCRPT12_T1_NEG: Final = 12046
LCR_ERR_LCRPT12_T2_NEG: Final = 12047
LCR_ERR_LCRIntegrate_TN: Final = 31550
LCR_ERR_LCRPID_IDENT: Final = 31552
LCR_ERR_LCRPID_MODE: Final = 31553
LCR_ERR_LCRPID_PAR_DMODE: Final = 31556
LCR_ERR_LCRPID_PAR_DYMAX: Final = 31557
LCR_ERR_LCRPID_PAR_FBKMODE: Final = 31558
LCR_ERR_LCRPIDTune_INVALID_REQU: Final = 31559
LCR_ERR_POINTER: Final = 31563
"""Statuses, as the vendor's LoopConR.var has them."""


class LoopState:
    """What a block keeps between its calls, by name; 0 before the first.

    Attributes:
        last_ns: release of the call before, None before the first.
        values: by name.
        history: values in the order in which they came, for those that look back.
    """

    def __init__(self) -> None:
        self.last_ns: int | None = None
        self.values: dict[str, float] = {}
        self.history: list[float] = []

    def __getitem__(self, name: str) -> float:
        return self.values.get(name, 0.0)

    def __setitem__(self, name: str, value: float) -> None:
        self.values[name] = value


class LoopStates:
    """The states of the blocks of a controller by their addresses; a restart forgets them."""

    def __init__(self, _context: Context) -> None:
        self.by_block: dict[int, LoopState] = {}


class LoopBlock(BlockModel):
    """Runs the blocks of one type on one controller.

    With enable FALSE a block forgets what it kept, its outputs are 0 and its status is
    ERR_FUB_ENABLE_FALSE.

    Attributes:
        outputs: that are 0 with enable FALSE.
    """

    outputs: ClassVar[tuple[str, ...]] = ("y",)

    def run(self, address: int) -> None:
        """Run the block whose data block lies at an address.

        Raises:
            PageFault: an address in it is wild.
        """
        variables = self.variables(address)
        states = self.context.library(LoopStates).by_block
        if not self.is_enabled(variables):
            states.pop(address, None)
            variables.set(status=ERR_FUB_ENABLE_FALSE, **dict.fromkeys(self.outputs, 0))
            return
        state = states.setdefault(address, LoopState())
        now_ns = self.context.release_ns
        last_ns = now_ns if state.last_ns is None else state.last_ns
        status = self.step(address, variables, state, max(now_ns - last_ns, 0) / NS_PER_SECOND)
        state.last_ns = now_ns
        variables.set(status=status)

    def is_enabled(self, variables: BlockVariables) -> bool:
        """Whether it calculates."""
        return variables.is_true("enable")

    def step(self, address: int, variables: BlockVariables, state: LoopState, step_s: float) -> int:
        """Calculate one call.

        Args:
            address: of the data block.
            variables: of the block.
            state: what it keeps.
            step_s: seconds since the call before, 0 in the first.

        Returns:
            The status.
        """
        raise NotImplementedError(type(self).__name__)


def limited(value: float, low: float, high: float) -> float:
    """Return a value within limits; what is no number is the lower one."""
    return min(max(value, low), high) if not math.isnan(value) else low


OK: Final = ERR_OK
