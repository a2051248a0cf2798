"""What is compiled of programs and libraries in C: their files, with the headers around them."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.case_blind import written_overlay
from plcsim.ansi_c.gcc_options import of_version, split
from plcsim.ansi_c.headers import (
    INCLUDE,
    body_headers,
    identity_of,
    library_headers,
    program_headers,
    written_headers,
)
from plcsim.ansi_c.static_library import UNIT_TEST, StaticLibrary
from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.library.installed import Scopes
from plcsim.machine.cache import CodeCache, default_folder
from plcsim.machine.shared_module import read_shared
from plcsim.program.c.names import c_files

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from pathlib import Path

    from plcsim.library.library import CBuild, Library
    from plcsim.machine.shared_module import SharedModule
    from plcsim.program.declarations import Declarations
    from plcsim.program.language import ProgramSource
    from st_types.resolve.scope import Scope


class LinkedModule(NamedTuple):
    """A linked module, what the compiler said about its sources, and these."""

    module: SharedModule
    warnings: Sequence[str]
    sources: Sequence[Path]


def compile_program(source: ProgramSource) -> LinkedModule:
    """Compile and link the files of a program.

    Raises:
        ConfigurationError: there are errors in them, or no compiler; all are told.
    """
    common = _common(source.declarations)
    libraries = common.scopes
    around = [scope for scope in source.scope.chain if scope not in libraries]
    headers = _headers("program", [*around, *libraries], lambda: program_headers(around, libraries))
    c_build = source.declarations.layout.c_build
    folders = [
        source.folder,
        *c_build.include_folders,
        *common.with_headers,
        headers,
        common.headers,
    ]
    options = compiler_options(c_build)
    return _compiled(
        BuildOrder(source.name, source.files, folders, options, common.static, headers.parent)
    )


class _Common(NamedTuple):
    """What all programs of a project have of its libraries.

    Attributes:
        scopes: of the libraries, each behind those that it needs.
        headers: folder with the headers that are made of their declarations.
        with_headers: folders of libraries that bring headers themselves.
        static: libraries that become part of a program.
    """

    scopes: Sequence[Scope]
    headers: Path
    with_headers: Sequence[Path]
    static: Sequence[StaticLibrary]


@lru_cache(maxsize=1)  # the programs of a project ask in turn
def _common(declarations: Declarations) -> _Common:
    scopes = declarations.catalogue.scopes.by_dependency()
    headers = _headers("libraries", scopes, lambda: library_headers(scopes))
    own = declarations.own_libraries
    others = [each for each in declarations.catalogue.libraries if each not in own]
    static = [StaticLibrary(c_files(each.files), (each.folder,)) for each in own if is_static(each)]
    with_headers = [*_with_own_header(own), *_with_headers(others)]
    return _Common(scopes, headers, with_headers, [*static, UNIT_TEST])


def is_static(library: Library) -> bool:
    """Return whether a library in C declares nothing that others could call by its module.

    Its code becomes part of each program that needs it. The library UnitTest has a runner here that
    takes the place of its own.
    """
    scope = library.scope
    if library.name.upper() == "UNITTEST":
        return False
    return not (scope.functions or scope.function_blocks) and bool(c_files(library.files))


def compile_library(library: Library, files: Sequence[Path]) -> LinkedModule:
    """Compile and link the files in C of a library.

    Raises:
        ConfigurationError: as for `compile_program`.
    """
    around = library.scope.outer
    libraries = around.by_dependency() if isinstance(around, Scopes) else around
    needed = around.needed_by(library) if isinstance(around, Scopes) else around
    names = ",".join(sorted(each.name for each in needed))
    headers = _headers(
        f"library {names}",
        [library.scope, *libraries],
        lambda: body_headers(library.scope, libraries, needed),
    )
    option = f"-D_{library.name.upper()}_EXPORT"
    folders = [library.folder, *library.c_build.include_folders, headers]
    options = [option, *compiler_options(library.c_build)]
    return _compiled(BuildOrder(library.name, files, folders, options, made=headers.parent))


def compiler_options(c_build: CBuild) -> list[str]:
    """Return what a project says to the compiler, and which compiler its sources think it is."""
    return [*of_version(c_build.gcc_version), *split(c_build.options)]


def _with_own_header(libraries: Iterable[Library]) -> list[Path]:
    """Return the folders of libraries that bring their header themselves."""
    return [
        library.folder
        for library in libraries
        if any(f.name.lower() == f"{library.name.lower()}.h" for f in library.folder.iterdir())
    ]


def _with_headers(libraries: Iterable[Library]) -> list[Path]:
    """Return the folders of libraries, beside the project's, that bring any header."""
    folders = [library.folder for library in libraries]
    return [folder for folder in folders if any(folder.glob("*.[hH]"))]


def _headers(kind: str, scopes: Sequence[Scope], make: Callable[[], Mapping[str, str]]) -> Path:
    cache = default_folder()
    parent = cache.parent / "include" if cache else None
    return written_headers(identity_of(kind, scopes), make, parent)


def _compiled(order: BuildOrder) -> LinkedModule:
    """Build what is ordered, with the headers that are the same for everybody."""
    cache = default_folder()
    folders = [*order.folders, INCLUDE]
    overlay = written_overlay(folders, order.folders[-1].parent)
    options = [*order.options, "-Xclang", "-ivfsoverlay", "-Xclang", str(overlay)]
    order = replace(order, folders=folders, options=options)
    built = build(order, find_toolchain(), CodeCache(cache.parent / "c" if cache else None))
    return LinkedModule(read_shared(built.wasm), built.warnings, order.sources)
