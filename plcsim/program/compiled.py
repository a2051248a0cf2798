"""Compiled programs and libraries of one controller, whatever language they are written in.

They call blocks and functions as imports of their modules, each of which is made once; and a fault
in one of them is located by who has compiled its module.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from plcsim.core.errors import ConfigurationError, Fault
from plcsim.library.executable import CompiledExecutable
from plcsim.machine import frames_of, trace_inside
from plcsim.program.compiled_body import CompiledBody
from plcsim.program.fault import describe, frames
from plcsim.program.structured_text.calling import (
    extern_for_c,
    extern_of,
    gives_large,
    interface_of,
)

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from plcsim.library.executable import Executable
    from plcsim.machine import Extern, Frame
    from plcsim.program.site import Site
    from st_types.resolve.declared import DeclaredFunction
    from st_types.types.derived import StructType

    Locate = Callable[[Frame], "CallSite | None"]
    """Returns where a frame of a module is in its sources, None for what no user has written."""


class CallSite(NamedTuple):
    """Where in the sources a function was when it called another one, or had a fault.

    Attributes:
        location: "file:line".
        function: its name.
        reason: what a fault here means, None for what the machine tells of it.
    """

    location: str
    function: str
    reason: str | None = None


class CompiledPrograms:
    """What the compiled programs of a controller share; see `of`."""

    def __init__(self, site: Site) -> None:
        self._site = site
        self._externs: dict[object, Extern] = {}
        self._locators: dict[str, Locate] = {}

    @staticmethod
    def of(site: Site) -> CompiledPrograms:
        """Return those of a controller, made at the first call."""
        found = site.context.settings(CompiledPrograms)
        if found is None:
            found = CompiledPrograms(site)
            site.context.give_settings(found)
        return found

    def locate_by(self, module: str, locate: Locate) -> None:
        """Have the frames of a module located by ``locate``."""
        self._locators[module] = locate

    def block(self, data_type: StructType[Any]) -> Extern:
        """Return a function block; it takes the PLC address of its data block.

        Raises:
            ConfigurationError: nothing executes it.
        """
        if data_type not in self._externs:
            site = self._site
            executable = site.catalogue.executable(data_type)
            if isinstance(executable, CompiledExecutable):
                found = executable.extern(site.context)
            else:
                found = site.machine.host_function(site.block(data_type), "I")
            self._externs[data_type] = found
        return self._externs[data_type]

    def function(self, function: DeclaredFunction) -> Extern:
        """Return a FUNCTION, called as any `plcsim.library.executable.CompiledExecutable`.

        Raises:
            ConfigurationError: nothing executes it.
        """
        key = function.scope
        if key not in self._externs:
            self._externs[key] = self._made(function)
        return self._externs[key]

    def function_for_c(self, function: DeclaredFunction) -> Extern:
        """Return a FUNCTION as its header declares it: what is large is returned as an address.

        Raises:
            ConfigurationError: nothing executes it.
        """
        if not gives_large(function):
            return self.function(function)
        key = ("for C", function.scope)
        if key not in self._externs:
            self._externs[key] = self._made_for_c(function)
        return self._externs[key]

    def _made_for_c(self, function: DeclaredFunction) -> Extern:
        site, executable = self._site, self._executable(function)
        if isinstance(executable, CompiledBody):
            return executable.extern_for_c(site.context)
        call = executable.bind(site.context)
        return extern_for_c(site.machine, site.memory, interface_of(function), call)

    def _executable(self, function: DeclaredFunction) -> Executable:
        found = self._site.catalogue.find_function(function.name)
        if found is None or found[1] is None:
            raise ConfigurationError(no_function_body(function.name))
        return found[1]

    def _made(self, function: DeclaredFunction) -> Extern:
        site, executable = self._site, self._executable(function)
        if isinstance(executable, CompiledExecutable):
            return executable.extern(site.context)
        call = executable.bind(site.context)
        return extern_of(site.machine, site.memory, interface_of(function), call)

    def location_of(self, frame: Frame) -> str:
        """Return "file:line" of a frame, "" for what no user has written."""
        locate = self._locators.get(frame.module)
        call = locate(frame) if locate else None
        return call.location if call else ""

    def fault_of(self, error: BaseException) -> Fault:
        """Return what something that a unit raised means, with the chain of calls.

        Args:
            error: what came out of the call of a unit: a trap, the end of its budget, or what a
                block or function in Python has raised.
        """
        return fault_of(error, self._locators.get)


def no_function_body(name: str) -> str:
    """Return what is wrong with a FUNCTION that nothing executes."""
    return f"FUNCTION {name} has no body: it is declared, and nothing executes it"


def fault_of(error: BaseException, locator_of: Callable[[str], Locate | None]) -> Fault:
    """Return what something that a unit raised means.

    Args:
        error: as for `CompiledPrograms.fault_of`.
        locator_of: gives what locates the frames of a module, by its name.
    """
    chain = list(_calls(error, locator_of))
    reason = chain[-1].reason if chain else None
    calls = [(call.location, call.function) for call in chain]
    calls += frames(trace_inside(error))
    texts = tuple(f"{location} in {function}" for location, function in calls)
    return Fault(calls[-1][0] if calls else "", reason or describe(error), texts)


def _calls(error: BaseException, locator_of: Callable[[str], Locate | None]) -> Iterator[CallSite]:
    """Yield where in the sources the calls were that an exception has passed, outermost first."""
    for frame in reversed(frames_of(error)):
        locate = locator_of(frame.module)
        call = locate(frame) if locate else None
        if call is not None:
            yield call
