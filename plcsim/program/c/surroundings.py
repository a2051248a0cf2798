"""What a module of C finds on its controller: variables, blocks, functions, its heap."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.ansi_c.heap import ProgramHeap, is_of_heap
from plcsim.ansi_c.plain_words import plain_name
from plcsim.ansi_c.prebuilt import declaring_header
from plcsim.core.errors import ConfigurationError
from plcsim.core.heap_use import Heaps
from plcsim.library.executable import CompiledExecutable
from plcsim.machine.placement import Placement, initial_values
from plcsim.program.c.files import DeviceFiles
from plcsim.program.compiled import CompiledPrograms
from plcsim.program.variables import variables_of
from st_types.types.derived import StructType
from st_types.types.values import initial_image

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
    from pathlib import Path

    from plcsim.ansi_c.c_library import CLibrary
    from plcsim.core.tag import Tag
    from plcsim.machine import Extern
    from plcsim.machine.engine import Type
    from plcsim.machine.shared_module import SharedModule
    from plcsim.program.site import Site
    from st_types.resolve.scope import Scope

HEAP_SIZE_NAMES: Final = ("bur_heap_size", "_bur_heap_size")
"""Variables by which a program says how many bytes its heap has."""


class SharedGlobal(NamedTuple):
    """A variable that C defines for all programs of a controller.

    Attributes:
        address: where it lies.
        size: in bytes.
        owner: the program in whose data it lies.
    """

    address: int
    size: int
    owner: str


class GlobalVariables(dict[str, SharedGlobal]):
    """Those of a controller, which C marks _GLOBAL and no .var file declares, by name."""


class ProgramSurroundings:
    """What a program or a library finds; see `plcsim.ansi_c.module.ModuleSurroundings`.

    Args:
        name: of its module.
        site: its controller.
        scope: in which names are looked up.
        own: the program's variables, and its constants.
        heap_size: in bytes, of the heap that it gets where it uses one.
        global_sizes: of the variables that it defines for all programs, by name.
        folders: where its sources lie.

    Attributes:
        heap: its heap, None where it uses none.

    Raises:
        ConfigurationError: another program defines a variable for all with another size.
    """

    def __init__(
        self,
        name: str,
        site: Site,
        scope: Scope,
        own: Sequence[Tag],
        heap_size: int,
        global_sizes: Mapping[str, int] | None = None,
        folders: Iterable[Path] = (),
    ) -> None:
        self._name = name
        self._folders = frozenset(folders)
        self._site = site
        self._scope = scope
        self._variables: dict[str, int] = {}
        for tag in reversed((*own, *site.shared)):
            self._variables |= _addresses(tag)
        self._global_sizes = global_sizes or {}
        self._globals = _of_controller(site)
        self._check_sizes()
        self._heap_size = heap_size
        self._library = _library(site)
        self._compiled = CompiledPrograms.of(site)
        self.heap: ProgramHeap | None = None

    def variable(self, name: str) -> int | None:
        """Return the address of a variable, what is declared nearest; None where there is none."""
        known, plain = self._variables, name
        while plain not in known and plain.endswith("_"):
            plain = plain[:-1]  # headers write it behind words of C, and behind names of types
        found = known.get(plain) or self._constant(plain) or self._library.variable(name)
        return found or (self._globals[name].address if name in self.foreign else None)

    @property
    def foreign(self) -> set[str]:
        """Names of variables that it defines for all programs, and another one has defined."""
        names = self._global_sizes.keys() & self._globals.keys()
        return {name for name in names if self._globals[name].owner != self._name}

    def define(self, addresses: Callable[[str], int | None]) -> None:
        """Define for all programs what no other one has defined.

        Args:
            addresses: gives that of a variable of the module, None where it has no such one.
        """
        for name, size in self._global_sizes.items():
            address = addresses(name)
            if address is not None and self.variable(name) is None:
                self._globals[name] = SharedGlobal(address, size, self._name)

    def _check_sizes(self) -> None:
        others = {name: self._globals[name] for name in self.foreign}
        findings = [
            f"{self._name}: _GLOBAL {name} has {self._global_sizes[name]} bytes here, "
            f"and {other.size} in {other.owner}"
            for name, other in sorted(others.items())
            if other.size != self._global_sizes[name]
        ]
        if findings:
            raise ConfigurationError(*findings)

    def _constant(self, name: str) -> int | None:
        """Return the address of a library's constant, None where there is none.

        Their headers give a constant of a number or a text as a macro; one of an ARRAY is a
        variable, of which each module that uses it has its own.
        """
        found = self._scope.find_variable(name)
        if found is None or found.name != name or not found.is_constant:
            return None
        alone = variables_of(self._name, [found]).constants
        return self._site.memory.keep(initial_image(alone), alone.alignment)

    def function(self, name: str, wanted: Type | None = None) -> Extern | None:
        """Return a block, a FUNCTION of a library or a function of C, None where there is none.

        A FUNCTION goes before one of C, other than where only the latter is of the type that is
        wanted: ``floor`` is one of AsMath with REAL, and one of math.h with double. Where no type
        is known, as for a pointer, it is that of C: so the headers declare it.
        """
        if is_of_heap(name):
            return self._own_heap().extern(name)
        found = self._block(name) or self._compiled_function(name)
        if found is None:
            return self._any_function(name) or (wanted and self._prebuilt(name, wanted))
        of_c = self._library.extern(name)
        if of_c is None or found.type in (wanted, of_c.type):
            return found
        return of_c if wanted in (None, of_c.type) else found

    def _block(self, name: str) -> Extern | None:
        block = self._scope.find_function_block(name)
        if block is None or block.name != name or block.data_type is None:
            return None
        if self._site.catalogue.executable(block.data_type) is None:
            return None
        return self._compiled.block(block.data_type)

    def _compiled_function(self, name: str) -> Extern | None:
        """Return a FUNCTION that was compiled: a user's own hides one of C by the same name."""
        function = self._scope.find_function(name)
        found = self._site.catalogue.find_function(name)
        if function is None or found is None or not isinstance(found[1], CompiledExecutable):
            return None
        return self._compiled.function_for_c(function)

    def _any_function(self, name: str) -> Extern | None:
        """Return a function of C, else a FUNCTION in Python."""
        extern = self._library.extern(name)
        function = self._scope.find_function(name)
        if extern is not None or function is None or function.name != name:
            return extern
        found = self._site.catalogue.find_function(name)
        if found is None or found[1] is None:
            return None
        return self._compiled.function_for_c(function)

    def _prebuilt(self, name: str, wanted: Type) -> Extern | None:
        """Return what stands for a function that only compiled code holds: it gives 0."""
        plain = plain_name(name)
        for owner, folder in self._compiled_code():
            if declaring_header(folder, plain):
                self._site.catalogue.note_idle(owner, plain)
                return self._site.machine.host_function(_zero, wanted.params, wanted.results)
        return None

    def _compiled_code(self) -> Iterator[tuple[str, Path]]:
        """Yield the names and folders of all whose compiled code may be idle."""
        catalogue = self._site.catalogue
        yield from ((x.name, x.folder) for x in catalogue.libraries if catalogue.has_stubs(x))
        if catalogue.has_idle_objects:
            yield from ((folder.name, folder) for folder in sorted(self._folders))

    def _own_heap(self) -> ProgramHeap:
        if self.heap is None:
            self.heap = ProgramHeap(self._name, self._site.machine, self._library, self._heap_size)
            Heaps.of(self._site.context).add(self._name, self.heap.use)
        return self.heap

    def reset(self) -> None:
        """Forget what lies on the heap."""
        if self.heap is not None:
            self.heap.reset()


def _zero(*_parameters: object) -> int:
    return 0


def _library(site: Site) -> CLibrary:
    """Return the C library of a controller, which finds the files of its devices."""
    library = site.c_library()
    if site.context.settings(DeviceFiles) is None:
        files = DeviceFiles(site.context)
        site.context.give_settings(files)
        library.use_files(files)
        site.memory.at_boot(files.close_all)
        site.memory.at_boot(library.reset)
    return library


def _of_controller(site: Site) -> GlobalVariables:
    found = site.context.settings(GlobalVariables)
    if found is None:
        found = GlobalVariables()
        site.context.give_settings(found)
    return found


def _addresses(tag: Tag) -> dict[str, int]:
    kind = tag.data_type
    assert isinstance(kind, StructType)
    members = zip(kind.members, kind.offsets, strict=True)
    return {member.name: tag.address + offset for member, offset in members}


class _Zeros(dict[str, int]):
    """Places of what has none yet."""

    def __missing__(self, _name: str) -> int:
        return 0


def heap_size_of(module: SharedModule, default: int) -> int:
    """Return the size that a program wants its heap to have, in bytes.

    Args:
        module: its module.
        default: where it does not say.
    """
    offsets = [module.variables[n] for n in HEAP_SIZE_NAMES if n in module.variables]
    for address, content in (
        initial_values(module, Placement(0, 0, _Zeros(), _Zeros())) if offsets else ()
    ):
        at = offsets[0] - address
        if 0 <= at <= len(content) - 4:
            return int.from_bytes(content[at : at + 4], "little") or default
    return default
