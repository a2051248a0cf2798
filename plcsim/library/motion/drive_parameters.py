"""Blocks that read and write parameters of a drive by their numbers (ParIDs).

There is no drive: what a program writes it reads back, and what nobody wrote is 0. The position is
that of the axis.
"""

from __future__ import annotations

import math
from struct import Struct
from typing import TYPE_CHECKING, Any, ClassVar, Final

from plcsim.library.members import BlockVariables, StructMembers
from plcsim.library.motion.block import EnableBlock, ExecuteBlock
from st_types.types.derived import StructType

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from plcsim.core.context import Context
    from plcsim.core.memory import Memory
    from plcsim.library.members import FindType
    from plcsim.library.motion.axis import Axis, MotionCommand
    from plcsim.library.motion.block import MotionBlock
    from st_types.types.elementary import DataType

POSITIONS: Final = frozenset([111, 113])
"""ACP10PAR_PCTRL_S_ACT and ..._S_SET: the actual and the set position, units."""

_INTEGERS: Final = {1: (1, False), 2: (1, True), 3: (2, True), 4: (4, True), 5: (1, False)} | {
    6: (2, False),
    7: (4, False),
}
"""ncPAR_TYP_BOOL, SINT, INT, DINT, USINT, UINT and UDINT: bytes, and whether there is a sign."""

_REALS: Final = {8: Struct("<f"), 17: Struct("<d")}
"""ncPAR_TYP_REAL and ncPAR_TYP_LREAL."""

MOST: Final = 0xFFFF
"""Parameters that one block transfers; there are no more numbers of them."""


def read_parameter(axis: Axis, number: int, memory: Memory, kind: int, address: int) -> None:
    """Store a parameter in a variable; a type without a size stores nothing, nor does address 0.

    Args:
        axis: that the drive moves.
        number: of the parameter.
        memory: of the controller.
        kind: type of the variable, as the vendor numbers it.
        address: of the variable.

    Raises:
        PageFault: the address is wild.
    """
    value = axis.position if number in POSITIONS else axis.parameters.get(number, 0)
    if address and kind in _REALS:
        memory.write(address, _packed(_REALS[kind], value))
    elif address and kind in _INTEGERS:
        size, _ = _INTEGERS[kind]
        whole = int(value) if math.isfinite(value) else 0
        memory.write(address, (whole % (1 << 8 * size)).to_bytes(size, "little"))


def _packed(form: Struct, value: float) -> bytes:
    try:
        return form.pack(value)
    except OverflowError:  # of an LREAL that no REAL holds
        return form.pack(math.copysign(math.inf, value))


def write_parameter(axis: Axis, number: int, memory: Memory, kind: int, address: int) -> None:
    """Take a parameter from a variable, likewise.

    Raises:
        PageFault: the address is wild.
    """
    if address and kind in _REALS:
        form = _REALS[kind]
        (axis.parameters[number],) = form.unpack(memory.read(address, form.size))
    elif address and kind in _INTEGERS:
        size, signed = _INTEGERS[kind]
        data = memory.read(address, size)
        axis.parameters[number] = int.from_bytes(data, "little", signed=signed)


class ReadParameter(ExecuteBlock):
    """MC_BR_ReadParID."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Read it."""
        read_parameter(axis, *_place(self, variables))
        command.finish()


class WriteParameter(ExecuteBlock):
    """MC_BR_WriteParID."""

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Write it."""
        write_parameter(axis, *_place(self, variables))
        command.finish()


class ReadCyclically(EnableBlock):
    """MC_BR_CyclicRead: in each call."""

    settles: ClassVar[bool] = False

    def read(self, _address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Read it."""
        if enable:
            read_parameter(axis, *_place(self, variables))


class WriteCyclically(EnableBlock):
    """MC_BR_CyclicWrite: in each call."""

    settles: ClassVar[bool] = False

    def read(self, _address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Write it."""
        if enable:
            write_parameter(axis, *_place(self, variables))


def _place(block: MotionBlock, variables: BlockVariables) -> tuple[int, Memory, int, int]:
    number, kind = (int(variables.number(name)) for name in ("ParID", "DataType"))
    return number, block.context.memory, kind, variables.address("DataAddress")


class _ParameterList:
    """The parameters that an ARRAY at DataAddress names.

    Args:
        context: of the controller.
        element: type of its elements, None where the library has none.
    """

    def __init__(self, context: Context, element: DataType[Any] | None) -> None:
        self._memory = context.memory
        self._size = element.size if isinstance(element, StructType) else 0
        self._members = StructMembers(element) if isinstance(element, StructType) else None

    def process(self, variables: BlockVariables, axis: Axis) -> None:
        """Write them where the name of the Mode says SET or WRITE, else read them.

        Raises:
            PageFault: an address is wild.
        """
        mode = variables.enumerator("Mode").upper()
        do = write_parameter if mode.endswith(("SET", "WRITE")) else read_parameter
        for each in self._elements(variables):
            number, kind = (int(each.number(name)) for name in ("ParID", "DataType"))
            do(axis, number, self._memory, kind, each.address("VariableAddress"))

    def _elements(self, variables: BlockVariables) -> Iterator[BlockVariables]:
        count = min(int(variables.number("NumberOfParIDs")), MOST)
        start = variables.address("DataAddress")
        if self._members is not None:
            for index in range(count):
                yield BlockVariables(self._memory, self._members, start + index * self._size)


class ProcessParameters(ExecuteBlock):
    """MC_BR_ProcessParID_AcpAx."""

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._list = _ParameterList(context, find_type("McAcpAxProcessParIDType"))

    def begin(self, variables: BlockVariables, axis: Axis, command: MotionCommand) -> None:
        """Transfer them."""
        self._list.process(variables, axis)
        command.finish()


class ProcessCyclically(EnableBlock):
    """MC_BR_CyclicProcessParID_AcpAx: in each call."""

    settles: ClassVar[bool] = False

    def __init__(self, data_type: StructType[Any], context: Context, find_type: FindType) -> None:
        super().__init__(data_type, context, find_type)
        self._list = _ParameterList(context, find_type("McAcpAxCycParIDType"))

    def read(self, _address: int, variables: BlockVariables, axis: Axis, *, enable: bool) -> None:
        """Transfer them."""
        if enable:
            self._list.process(variables, axis)


BLOCKS: Final[Mapping[str, type[MotionBlock]]] = {
    "MC_BR_ReadParID": ReadParameter,
    "MC_BR_WriteParID": WriteParameter,
    "MC_BR_CyclicRead": ReadCyclically,
    "MC_BR_CyclicWrite": WriteCyclically,
    "MC_BR_ProcessParID_AcpAx": ProcessParameters,
    "MC_BR_CyclicProcessParID_AcpAx": ProcessCyclically,
}
"""What runs the blocks by their names."""
