"""Linking: compiled modules get addresses for their variables and functions for their imports."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.ansi_c.c_library import CLibrary
from plcsim.program.structured_text.codegen.runtime import MATHEMATICS

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from plcsim.machine import Extern, Instance, Machine, MachineCode
    from plcsim.program.structured_text import ir
    from plcsim.program.structured_text.codegen.lines import ModuleLines
    from plcsim.program.structured_text.codegen.object_code import ObjectCode


class Linker:
    """Links the modules of one controller.

    What a module imports may be a function of another module, called directly, or a block or
    function in another language, called as a function of the host.

    Args:
        machine: what the modules run on.
    """

    def __init__(self, machine: Machine) -> None:
        self._machine = machine
        self._mathematics: dict[str, Extern] = {}
        self._lines: dict[str, ModuleLines] = {}

    def compiled(self, code: ObjectCode, addresses: Mapping[str, int]) -> MachineCode:
        """Return the machine code of a module for addresses of its segments, by name."""
        identity = code.identity(addresses)
        return self._machine.compile_made(identity, lambda: code.place(addresses))

    def link(
        self, code: ObjectCode, compiled: MachineCode, provide: Callable[[ir.Import], Extern]
    ) -> Instance:
        """Return a module that is ready to run.

        Args:
            code: the module; one may be linked several times, with other addresses.
            compiled: its machine code for some addresses.
            provide: gives what the module imports; it may link other modules for that. What it
                raises is raised here.

        Raises:
            ValueError: another module has its name.
        """
        if self._lines.setdefault(code.name, code.lines) is not code.lines:
            raise ValueError(f"two modules are called {code.name}")
        imports: dict[tuple[str, str], Extern | int] = {}
        for wanted in code.imports:
            imports[wanted.space, wanted.name] = provide(wanted)
        return self._machine.instantiate(compiled, imports | self._mathematical())

    def _mathematical(self) -> dict[tuple[str, str], Extern | int]:
        if not self._mathematics:
            library = self._machine.shared(CLibrary)
            names = [name.removeprefix("rt.") for name in MATHEMATICS]
            self._mathematics = {n: f for n in names if (f := library.extern(n)) is not None}
        return {("rt", name): extern for name, extern in self._mathematics.items()}
