"""One controller as its programs find it: memory, global variables, libraries."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from plcsim.core.errors import ConfigurationError
from plcsim.library.executable import CompiledExecutable
from st_types.types.derived import ArrayType, DataBlockType, StructType, resolve_alias
from st_types.types.views import address_of, type_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from plcsim.ansi_c.c_library import CLibrary
    from plcsim.core.context import Context
    from plcsim.core.memory import Memory
    from plcsim.core.tag import Tag
    from plcsim.library.catalogue import Catalogue
    from plcsim.machine import Frame, Machine
    from st_types.types.elementary import DataType
    from st_types.types.views import Struct


class Site:
    """What programs are put on; blocks find it by `Site.of`.

    Args:
        context: of the controller; its memory takes the programs' variables.
        catalogue: libraries of the project.
        shared: the global variables, and the global constants, as one tag each.
        watch: told of the stores of compiled programs, see `plcsim.machine.Machine`.
        counts_instructions: those of compiled programs; for the virtual clock, where no other
            measure of time means anything, and nothing else ends an endless loop.

    Attributes:
        context: as above.
        catalogue: likewise.
        shared: likewise.
        compile_shared: compile the modules that several programs share, of those that are placed;
            each returns whether that was in no cache.
    """

    def __init__(
        self,
        context: Context,
        catalogue: Catalogue,
        shared: Sequence[Tag] = (),
        *,
        counts_instructions: bool = False,
        watch: Callable[[Frame], None] | None = None,
    ) -> None:
        self.context = context
        self.catalogue = catalogue
        self.shared = tuple(shared)
        self.compile_shared: list[Callable[[], bool]] = []
        self._bound: dict[StructType[Any], Callable[[int], None]] = {}
        self._counts_instructions = counts_instructions
        self._watch = watch
        self._c_library: CLibrary | None = None
        context.give_settings(self)
        context.run_block = self._run_block

    @staticmethod
    def of(context: Context) -> Site:
        """Return the site of a controller.

        Raises:
            RuntimeError: nobody has made one.
        """
        found = context.settings(Site)
        if found is None:
            raise RuntimeError("this controller was made without a site")
        return found

    @property
    def memory(self) -> Memory:
        """The PLC memory."""
        return self.context.memory

    @cached_property
    def machine(self) -> Machine:
        """What compiled programs run on; made when the first of them asks for it.

        Raises:
            MachineError: the host has no room for it.
        """
        from plcsim.machine import Machine  # noqa: PLC0415  # 20 ms that not every project needs

        return Machine(self.memory, fuel=self._counts_instructions, watch=self._watch)

    def c_library(self) -> CLibrary:
        """Return the C library, which is placed at the first call."""
        if self._c_library is None:
            from plcsim.ansi_c.c_library import CLibrary  # noqa: PLC0415  # likewise

            self._c_library = self.machine.shared(CLibrary)
            self.compile_shared.append(self._c_library.compile)
        return self._c_library

    def block(self, data_type: StructType[Any]) -> Callable[[int], None]:
        """Return what runs a function block on the data block at an address.

        Raises:
            ConfigurationError: nothing executes this block.
        """
        if data_type not in self._bound:
            executable = self.catalogue.executable(data_type)
            if executable is None:
                raise ConfigurationError(no_body(data_type))
            self._bound[data_type] = executable.bind(self.context)
        return self._bound[data_type]

    def prepare(self, data_type: DataType[Any]) -> None:
        """Bind the compiled blocks in a variable, which else their first call would wait for.

        Raises:
            ConfigurationError: the body of a block cannot be loaded.
        """
        for block in blocks_in(data_type):
            if isinstance(self.catalogue.executable(block), CompiledExecutable):
                self.block(block)

    def _run_block(self, block: Struct) -> None:
        self.block(type_of(block))(address_of(block))  # type: ignore[arg-type]  # a data block


def blocks_in(data_type: DataType[Any]) -> Iterator[DataBlockType[Any]]:
    """Iterate over the types of the data blocks in a variable, those inside others first."""
    return _blocks_in(data_type, set())


def _blocks_in(data_type: DataType[Any], seen: set[int]) -> Iterator[DataBlockType[Any]]:
    found = resolve_alias(data_type)
    if isinstance(found, ArrayType):
        yield from _blocks_in(found.element, seen)
    elif isinstance(found, StructType) and id(found) not in seen:
        seen.add(id(found))
        for member in found.members:
            yield from _blocks_in(member.data_type, seen)
        if isinstance(found, DataBlockType):
            yield found


def no_body(data_type: StructType[Any]) -> str:
    """Return what is wrong with a block that nothing executes."""
    return f"FUNCTION_BLOCK {data_type.name} has no body: it is declared, and nothing executes it"
