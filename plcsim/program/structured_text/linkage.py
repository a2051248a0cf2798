"""All compiled Structured Text of one controller: programs, and the libraries that they call."""

from __future__ import annotations

from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

from plcsim.program.compiled import CompiledPrograms, no_function_body
from plcsim.program.compiled_body import CompiledBody
from plcsim.program.site import no_body
from plcsim.program.structured_text.check import located
from plcsim.program.structured_text.codegen.link import Linker
from plcsim.program.structured_text.coverage import MEASURING, CountedModule
from plcsim.program.structured_text.fault import locator
from plcsim.program.structured_text.layout import SHARED, addresses
from plcsim.program.structured_text.lower.memory import DIRECT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from plcsim.core.errors import Fault
    from plcsim.library.catalogue import Catalogue
    from plcsim.library.executable import Executable
    from plcsim.machine import Extern, Instance, MachineCode
    from plcsim.program.site import Site
    from plcsim.program.structured_text import ir
    from plcsim.program.structured_text.codegen.object_code import ObjectCode
    from st_types.resolve.scope import Scope
    from st_types.types.derived import DataBlockType


class PlacedCode:
    """A module whose variables have their places on a controller.

    Args:
        make: returns its machine code.
        link: gives machine code what it calls.
    """

    def __init__(
        self, make: Callable[[], MachineCode], link: Callable[[MachineCode], Instance]
    ) -> None:
        self._make = make
        self._link = link

    @cached_property
    def _code(self) -> MachineCode:
        return self._make()

    def compile(self) -> bool:
        """Compile it to machine code; return whether that was in no cache."""
        return self._code.is_new

    def link(self) -> Instance:
        """Return the module, ready to run.

        Raises:
            ConfigurationError: something that it calls has no body.
        """
        return self._link(self._code)


class Linkage:
    """The modules of one controller; see `of`.

    Attributes:
        counted: those that were compiled with counters.
    """

    def __init__(self, site: Site) -> None:
        self.counted: list[CountedModule] = []
        self._site = site
        self._linker = Linker(site.machine)
        site.c_library()  # compiled with the programs; the linker needs it for each
        self._libraries: dict[object, Instance | None] = {}
        self._compiled = CompiledPrograms.of(site)
        self._shared = addresses(SHARED, site.shared)

    @staticmethod
    def of(site: Site) -> Linkage:
        """Return the linkage of a controller, made at the first call."""
        found = site.context.settings(Linkage)
        if found is None:
            found = Linkage(site)
            site.context.give_settings(found)
        return found

    def place(
        self, code: ObjectCode, scope: Scope, own: Mapping[str, int], task: str = ""
    ) -> PlacedCode:
        """Return a module whose variables have their places.

        Args:
            code: the module.
            scope: in which its names were looked up.
            own: addresses of the segments of its variables.
            task: whose module it is, "" for that of a library.

        Raises:
            ConfigurationError: the memory is full.
        """
        places = {**self._shared, **own}
        for segment in code.segments:
            if segment.data is not None:
                places[segment.name] = self._site.memory.keep(segment.data, 8)
            elif segment.name == DIRECT:
                places[DIRECT] = self._direct
        return PlacedCode(
            partial(self._linker.compiled, code, places), partial(self._link, code, scope, task)
        )

    def _link(self, code: ObjectCode, scope: Scope, task: str, compiled: MachineCode) -> Instance:
        self._compiled.locate_by(code.name, locator(code.lines))
        instance = self._linker.link(code, compiled, partial(self._provide, scope))
        if code.profile is not None:
            module = CountedModule(task, code.profile, instance)
            self.counted.append(module)
            self._site.machine.deduct(module.overhead)
            MEASURING.link(module)
        return instance

    @cached_property
    def _direct(self) -> int:
        """The address of the direct addresses, which all programs share."""
        return self._site.memory.keep(bytes(located.SIZE), 8)

    def library(self, key: object, link: Callable[[], Instance]) -> Instance | None:
        """Return the module of a library; None while it is being linked.

        Args:
            key: of the library.
            link: links it at the first call.
        """
        if key not in self._libraries:
            self._libraries[key] = None
            self._libraries[key] = link()
        return self._libraries[key]

    def fault_of(self, error: BaseException) -> Fault:
        """Return what something that a unit raised means."""
        return self._compiled.fault_of(error)

    def _provide(self, scope: Scope, wanted: ir.Import) -> Extern:
        if wanted.space == "block":
            return self._compiled.block(_data_block(scope, wanted))
        function = scope.find_function(wanted.name)
        assert function is not None
        return self._compiled.function(function)


def _data_block(scope: Scope, wanted: ir.Import) -> DataBlockType[Any]:
    block = scope.find_function_block(wanted.name)
    assert block is not None
    assert block.data_type is not None
    return block.data_type


def executable_of(catalogue: Catalogue, scope: Scope, wanted: ir.Import) -> Executable | None:
    """Return what executes a block or function that a module calls, None where nothing does.

    Raises:
        ConfigurationError: the bodies of its library cannot be loaded.
    """
    if wanted.space == "block":
        return catalogue.executable(_data_block(scope, wanted))
    found = catalogue.find_function(wanted.name)
    return None if found is None else found[1]


def missing(
    catalogue: Catalogue, scope: Scope, imports: Iterable[ir.Import]
) -> list[tuple[ir.Import, str]]:
    """Return what is wrong with what a module calls: nothing executes it, or only C can call it."""
    wrong = ((each, _wrong(scope, each, executable_of(catalogue, scope, each))) for each in imports)
    return [(each, text) for each, text in wrong if text]


def _wrong(scope: Scope, wanted: ir.Import, executable: Executable | None) -> str:
    if executable is None:
        return _no_body(scope, wanted)
    return executable.only_c if isinstance(executable, CompiledBody) else ""


def _no_body(scope: Scope, wanted: ir.Import) -> str:
    if wanted.space == "block":
        return no_body(_data_block(scope, wanted))
    return no_function_body(wanted.name)
