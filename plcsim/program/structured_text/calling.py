"""Calls of functions between Structured Text and Python, by what a FUNCTION declares.

Values go over as values, what is larger by its address. A function whose result is a STRING, a
STRUCT or an ARRAY writes it to an address that the caller hands over as the first parameter; one
in C returns the address of its STRING instead, as its header declares it.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Protocol

from plcsim.program.structured_text.check.kinds import plain
from plcsim.program.structured_text.lower.memory import is_scalar, width_of
from st_types.types.derived import StringType, WStringType
from st_types.types.elementary import BOOL, DINT, TIME
from st_types.types.values import decode, encode

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.memory import Memory
    from plcsim.machine import Extern, Machine
    from plcsim.program.structured_text.ir import Width
    from st_types.resolve.declared import DeclaredFunction
    from st_types.types.elementary import DataType

PARAMETERS: Final = frozenset(["VAR_INPUT", "VAR_IN_OUT", "VAR_OUTPUT"])
_BY_VALUE: Final = "VAR_INPUT"
_CODES: Final[dict[Width, str]] = {
    "s8": "i",
    "u8": "I",
    "s16": "i",
    "u16": "I",
    "w32": "I",
    "w64": "Q",
    "f32": "f",
    "f64": "d",
}
_SIGNED: Final = {"I": "i", "Q": "q"}


class Functions(Protocol):
    """A module whose functions Python may call."""

    def function(self, name: str, params: str | None = None, results: str | None = None) -> Any:
        """Return a function as a Python callable."""


@dataclass(frozen=True, slots=True)
class Interface:
    """How a FUNCTION is called.

    Attributes:
        params: codes of its parameters (see `plcsim.machine.calls`), without that of the result.
        results: code of its result, "" where it has none, or one that is written to an address;
            "I" with a large one whose address is returned.
        large: the type of a result that is larger than a value, None otherwise.
        flags: numbers of the parameters that are BOOLs.
        is_flag: the result is a BOOL.
    """

    params: str
    results: str
    large: DataType[Any] | None
    flags: tuple[int, ...]
    is_flag: bool

    @property
    def gives_address(self) -> bool:
        """Whether it returns the address of its result, as functions in C do."""
        return self.large is not None and bool(self.results)


def gives_large(function: DeclaredFunction) -> bool:
    """Return whether the result of a function is larger than a value."""
    return function.result is not None and not is_scalar(plain(function.result))


def interface_of(function: DeclaredFunction) -> Interface:
    """Return how a function is called."""
    codes, flags = "", []
    for variable in function.variables:
        if variable.block.section not in PARAMETERS or variable.is_constant:
            continue
        assert variable.data_type is not None
        data_type = plain(variable.data_type)
        by_value = variable.block.section == _BY_VALUE and is_scalar(data_type)
        if by_value and data_type is BOOL:
            flags.append(len(codes))
        codes += _code(data_type) if by_value else "I"
    result = None if function.result is None else plain(function.result)
    is_small = result is not None and is_scalar(result)
    return Interface(
        codes,
        _code(result) if result is not None and is_small else "",
        None if is_small else result,
        tuple(flags),
        result is BOOL,
    )


def _code(data_type: DataType[Any]) -> str:
    width = width_of(data_type)
    code = _CODES[width]
    is_signed = data_type in (DINT, TIME) or getattr(data_type, "name", "") == "LINT"
    return _SIGNED[code] if is_signed else code


def extern_of(
    machine: Machine, memory: Memory, interface: Interface, call: Callable[..., Any]
) -> Extern:
    """Return a function in Python as something that modules can import."""
    flags, large = interface.flags, interface.large
    if flags:
        call = _with_flags(call, flags)
    if large is None:
        return machine.host_function(call, interface.params, interface.results)

    def write_result(address: int, *arguments: Any) -> None:
        memory.write(address, encode(large, call(*arguments)))

    return machine.host_function(write_result, "I" + interface.params)


def extern_for_c(
    machine: Machine, memory: Memory, interface: Interface, call: Callable[..., Any]
) -> Extern:
    """Return a function in Python whose result is large as C calls it: it returns its address.

    The result stands there until the next call.
    """
    large = interface.large
    assert large is not None
    address = memory.keep(bytes(large.size), large.alignment)
    flagged = _with_flags(call, interface.flags)

    def give_address(*arguments: Any) -> int:
        memory.write(address, encode(large, flagged(*arguments)))
        return address

    return machine.host_function(give_address, interface.params, "I")


def _with_flags(call: Callable[..., Any], flags: tuple[int, ...]) -> Callable[..., Any]:
    """Return a function whose BOOLs are those of Python."""

    def call_with_flags(*arguments: Any) -> Any:
        given = [*arguments]
        for number in flags:
            given[number] = bool(given[number])
        return call(*given)

    return call_with_flags


def callable_of(
    memory: Memory, instance: Functions, name: str, interface: Interface
) -> Callable[..., Any]:
    """Return a compiled function for Python to call with plain values."""
    large = interface.large
    if large is None:
        function = instance.function(name, interface.params, interface.results)
        return (lambda *given: bool(function(*given))) if interface.is_flag else function
    if interface.gives_address:
        give_address = instance.function(name, interface.params, interface.results)
        return lambda *given: _text(memory, give_address(*given), large)
    write_result = instance.function(name, "I" + interface.params)
    address = memory.keep(bytes(large.size), large.alignment)

    def call(*arguments: Any) -> object:
        write_result(address, *arguments)
        return decode(large, memory.read(address, large.size))

    return call


def _text(memory: Memory, address: int, data_type: DataType[Any]) -> str:
    """Return the text at an address, cut off at the length of a STRING or WSTRING."""
    if isinstance(data_type, StringType):
        return memory.string(address, data_type.length).decode("latin-1")
    assert isinstance(data_type, WStringType)
    units = bytearray()
    while len(units) < 2 * data_type.length:
        unit = memory.read(address + len(units), 2)  # what lies behind the end may not be valid
        if unit == b"\0\0":
            break
        units += unit
    return str(decode(data_type, bytes(units) + b"\0\0"))
