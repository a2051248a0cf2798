"""What executes the function blocks and functions of a library, whatever language it is written in.

One declaration has one implementation. Programs in all languages call that one, on the same data
block at the same address.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple, Protocol, TypeVar, runtime_checkable

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.core.context import Context
    from plcsim.library.library import Library
    from plcsim.machine import Extern

F = TypeVar("F", bound="Callable[..., object]")


class Executable(Protocol):
    """The body of a FUNCTION_BLOCK or a FUNCTION.

    Attributes:
        language: it is written in, as people call it.
    """

    @property
    def language(self) -> str:
        """The language, as people call it."""

    def bind(self, context: Context) -> Callable[..., Any]:
        """Return what runs it on a controller.

        Of a function block: called with the PLC address of the data block, it runs the block once.
        Of a function: called with its parameters in order, addresses as numbers, it returns the
        result.
        """


@runtime_checkable
class CompiledExecutable(Executable, Protocol):
    """A body that was compiled: other compiled code calls it directly, not by way of Python."""

    def extern(self, context: Context) -> Extern:
        """Return it for the imports of other modules on a controller.

        A block takes the PLC address of its data block. A function takes its parameters, what is
        larger than a value by its address; a result of such a type is written to an address that
        comes first.
        """


class BodyLanguage(Protocol):
    """A language that bodies of libraries may be written in.

    Attributes:
        name: as people call it.
    """

    @property
    def name(self) -> str:
        """As people call it."""

    def bodies(self, library: Library) -> Mapping[str, Executable]:
        """Return the bodies in this language that lie in a library's folder, by declared name.

        Raises:
            ConfigurationError: some cannot be loaded; all findings are told, with file and line.
        """


class FunctionBody(NamedTuple):
    """Which FUNCTION a Python function is the body of."""

    name: str


def function(name: str) -> Callable[[F], F]:
    """Mark a Python function as the body of the FUNCTION ``name`` of its library.

    It takes the controller's `Context` and the parameters in order, as plain values, and returns
    the result::

        @function("brsstrlen")
        def string_length(context: Context, pString: int) -> int:
            return len(context.memory.string(pString, MAX_LENGTH))
    """

    def mark(body: F) -> F:
        body._plc_function = FunctionBody(name)  # type: ignore[attr-defined]  # a mark on a function
        return body

    return mark
