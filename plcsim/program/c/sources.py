"""What is compiled of programs and libraries in C: their files, with the headers around them."""

from __future__ import annotations

import shlex
from typing import TYPE_CHECKING, NamedTuple

from plcsim.ansi_c.build import BuildOrder, build
from plcsim.ansi_c.case_blind import written_overlay
from plcsim.ansi_c.headers import (
    INCLUDE,
    body_headers,
    identity_of,
    program_headers,
    written_headers,
)
from plcsim.ansi_c.toolchain import find_toolchain
from plcsim.library.installed import Scopes
from plcsim.machine.cache import CodeCache, default_folder
from plcsim.machine.shared_module import read_shared

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence
    from pathlib import Path

    from plcsim.library.library import CBuild, Library
    from plcsim.machine.shared_module import SharedModule
    from plcsim.program.language import ProgramSource
    from st_types.resolve.scope import Scope


class LinkedModule(NamedTuple):
    """A linked module, and what the compiler said about its sources."""

    module: SharedModule
    warnings: Sequence[str]


def compile_program(source: ProgramSource) -> LinkedModule:
    """Compile and link the files of a program.

    Raises:
        ConfigurationError: there are errors in them, or no compiler; all are told.
    """
    libraries = source.declarations.catalogue.scopes.by_dependency()
    around = [scope for scope in source.scope.chain if scope not in libraries]
    headers = _headers("program", [*around, *libraries], lambda: program_headers(around, libraries))
    own = source.declarations.own_libraries
    others = [each for each in source.declarations.catalogue.libraries if each not in own]
    brought = [*_with_own_header(own), *_with_headers(others)]
    c_build = source.declarations.layout.c_build
    folders = [source.folder, *c_build.include_folders, *brought, headers]
    return _compiled(source.name, source.files, folders, *_options(c_build))


def compile_library(library: Library, files: Sequence[Path]) -> LinkedModule:
    """Compile and link the files in C of a library.

    Raises:
        ConfigurationError: as for `compile_program`.
    """
    around = library.scope.outer
    libraries = around.by_dependency() if isinstance(around, Scopes) else around
    headers = _headers(
        "library", [library.scope, *libraries], lambda: body_headers(library.scope, libraries)
    )
    option = f"-D_{library.name.upper()}_EXPORT"
    folders = [library.folder, *library.c_build.include_folders, headers]
    return _compiled(library.name, files, folders, option, *_options(library.c_build))


def _options(c_build: CBuild) -> list[str]:
    """Return what a project says to the compiler, and which compiler its sources think it is."""
    parts = c_build.gcc_version.split(".")
    names = ("__GNUC__", "__GNUC_MINOR__", "__GNUC_PATCHLEVEL__")
    options = shlex.split(c_build.options)
    for name, number in zip(names, parts, strict=False):
        if number.isdecimal():
            options += [f"-U{name}", f"-D{name}={number}"]
    return options


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


def _compiled(
    name: str, files: Sequence[Path], folders: Sequence[Path], *options: str
) -> LinkedModule:
    cache = default_folder()
    overlay = written_overlay([*folders, INCLUDE], folders[-1].parent)
    order = BuildOrder(
        name,
        files,
        [*folders, INCLUDE],
        [*options, "-Xclang", "-ivfsoverlay", "-Xclang", str(overlay)],
    )
    built = build(order, find_toolchain(), CodeCache(cache.parent / "c" if cache else None))
    return LinkedModule(read_shared(built.wasm), built.warnings)
