"""Bodies of libraries in Python.

The body of a FUNCTION_BLOCK is a class derived from the block's face, under its name; the body of
a FUNCTION is a function marked with `plcsim.library.executable.function`. They may stand in any
module of the library's folder.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.function_block import FunctionBlock
from plcsim.core.suggestion import did_you_mean
from plcsim.library.face import names_of
from plcsim.library.installed import installed
from plcsim.program.python.method_check import check_methods
from plcsim.program.python.modules import body_modules, own_names
from plcsim.program.site import Site

if TYPE_CHECKING:
    from collections.abc import Callable
    from types import ModuleType

    from plcsim.core.context import Context
    from plcsim.library.executable import Executable
    from plcsim.library.library import Library

LANGUAGE: Final = "Python"


class PythonBlock(NamedTuple):
    """The body of a FUNCTION_BLOCK.

    Attributes:
        view: the class of views of its data block.
    """

    view: type[FunctionBlock]

    @property
    def language(self) -> str:
        """Python."""
        return LANGUAGE

    def bind(self, context: Context) -> Callable[[int], None]:
        """Return what runs the block on the data block at an address."""
        site = context.settings(Site)
        if site is not None:
            site.prepare(self.view._plc_type)
        views: dict[int, FunctionBlock] = {}
        access, view = context.memory.access, self.view

        def run(address: int) -> None:
            block = views.get(address)
            if block is None:
                block = views[address] = access(view, address, context)
            block.execute()

        return run


class PythonFunction(NamedTuple):
    """The body of a FUNCTION.

    Attributes:
        body: takes the context, then the parameters.
    """

    body: Callable[..., Any]

    @property
    def language(self) -> str:
        """Python."""
        return LANGUAGE

    def bind(self, context: Context) -> Callable[..., Any]:
        """Return the function with its context."""
        return partial(self.body, context)


class PythonBodies:
    """See `plcsim.library.executable.BodyLanguage`."""

    name: Final = LANGUAGE

    def bodies(self, library: Library) -> dict[str, Executable]:
        """Import the modules of a library and return the bodies in them."""
        findings = Findings()
        found: dict[str, Executable] = {}
        for module in body_modules(library):
            for value in own_names(module).values():
                with findings.gathered():
                    name, body = _body(library, module, value)
                    if body is not None:
                        found[name] = body
        findings.check()
        return found


def _body(library: Library, module: ModuleType, value: object) -> tuple[str, Executable | None]:
    mark = getattr(value, "_plc_function", None)
    if mark is not None and callable(value):
        if mark.name not in library.scope.index.names("functions"):
            hint = did_you_mean(mark.name, names_of(library.scope))
            raise ConfigurationError(
                f"{module.__file__}: {library.name} declares no FUNCTION {mark.name}{hint}"
            )
        return mark.name, PythonFunction(value)
    if isinstance(value, type) and issubclass(value, FunctionBlock):
        return _block(library, value)
    return "", None


def _block(library: Library, view: type[FunctionBlock]) -> tuple[str, Executable | None]:
    """Return a class that stands for a declared block; others help, or declare themselves."""
    name, scope = view._plc_type.name, library.scope
    if name not in scope.index.names("types") or scope.find_type(name) is not view._plc_type:
        return "", None
    if view.execute is FunctionBlock.execute:
        raise ConfigurationError(f"{library.folder}: class {name} has no method execute")
    if installed().get(library.package) is not library:
        check_methods(view, FunctionBlock)
    return name, PythonBlock(view)
