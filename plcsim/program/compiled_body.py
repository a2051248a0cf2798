"""Bodies of function blocks and functions that are compiled, whatever language they are written in.

A library's code is one module on each controller. Two libraries may call each other: while the
module of one is being linked, the other one reaches it by way of Python.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from plcsim.core.errors import ConfigurationError
from plcsim.program.site import Site
from plcsim.program.structured_text.calling import callable_of, extern_for_c, extern_of

if TYPE_CHECKING:
    from collections.abc import Callable

    from plcsim.core.context import Context
    from plcsim.machine import Extern
    from plcsim.program.structured_text.calling import Interface


class LinkedCode(Protocol):
    """A module on a controller."""

    def extern(self, name: str) -> Extern | None:
        """Return a function of it for other modules to import, None where there is none."""

    def function(self, name: str, params: str | None = None, results: str | None = None) -> Any:
        """Return a function of it as a Python callable."""


class LibraryCode(Protocol):
    """The compiled code of a library."""

    @property
    def language(self) -> str:
        """What it is written in, as people call it."""

    def on(self, site: Site) -> LinkedCode | None:
        """Return it on a controller; None while it is being linked there."""


class CompiledBody(NamedTuple):
    """The body of a FUNCTION_BLOCK or a FUNCTION (`plcsim.library.executable`).

    Attributes:
        library: that it belongs to.
        name: of the compiled function.
        interface: of a FUNCTION; None for a block.
        only_c: why nobody but C can call it, "" for what everybody can.
    """

    library: LibraryCode
    name: str
    interface: Interface | None = None
    only_c: str = ""

    @property
    def language(self) -> str:
        """That of the library."""
        return self.library.language

    def bind(self, context: Context) -> Callable[..., Any]:
        """Return what runs it on a controller, for Python.

        Raises:
            ConfigurationError: only C can call it.
        """
        if self.only_c:
            raise ConfigurationError(self.only_c)
        site = Site.of(context)
        linked = self.library.on(site)
        if linked is None:
            return partial(self._call, context)
        if self.interface is None:
            return site.machine.unit(linked.function(self.name, "I"))
        return site.machine.unit(callable_of(site.memory, linked, self.name, self.interface))

    def _call(self, context: Context, *arguments: Any) -> Any:
        return self.bind(context)(*arguments)

    def extern(self, context: Context) -> Extern:
        """Return it for other modules to import.

        Raises:
            ConfigurationError: only C can call it.
        """
        site = Site.of(context)
        linked = self.library.on(site)
        is_direct = self.interface is None or not self.interface.gives_address
        if linked is not None and is_direct:
            return self._in(linked)
        call = self.bind(context)
        if self.interface is None:
            return site.machine.host_function(call, "I")
        return extern_of(site.machine, site.memory, self.interface, call)

    def extern_for_c(self, context: Context) -> Extern:
        """Return a FUNCTION whose result is large for modules of C: it returns an address."""
        site, interface = Site.of(context), self.interface
        assert interface is not None
        if not interface.gives_address:
            return extern_for_c(site.machine, site.memory, interface, self.bind(context))
        linked = self.library.on(site)
        if linked is not None:
            return self._in(linked)
        call = partial(self._give_address, site)
        return site.machine.host_function(call, interface.params, interface.results)

    def _in(self, linked: LinkedCode) -> Extern:
        found = linked.extern(self.name)
        assert found is not None, self.name  # what has no code is no body
        return found

    def _give_address(self, site: Site, *arguments: Any) -> int:
        linked, interface = self.library.on(site), self.interface
        assert linked is not None
        assert interface is not None
        found: int = linked.function(self.name, interface.params, interface.results)(*arguments)
        return found
