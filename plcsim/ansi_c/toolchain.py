"""Finds a clang and a linker for WebAssembly: the package ``ziglang``, or those of the system.

Both make the same of C; what differs between their versions is kept here.
"""

from __future__ import annotations

import os
import re
import shutil
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from importlib.util import find_spec
from pathlib import Path
from typing import NamedTuple

from plcsim.ansi_c.static_library import FOLDER, StaticLibrary
from plcsim.core.errors import ConfigurationError

OLDEST, NEWEST = 14, 30
"""Versions of clang and LLD that are looked for; 14 is the oldest that links what is needed."""

MISSING = (
    "programs in C need a compiler, and there is none: install it by  pip install 'plcsim[c]'  "
    f"(or clang and lld {OLDEST} or newer by the system's own packages)"
)

_TARGET = "wasm32-unknown-emscripten"  # for it alone clang 14 makes position-independent code
_BEFORE_16 = ("-enable-trivial-auto-var-init-zero-knowing-it-will-be-removed-from-clang",)
_ZIG_OPTIONS = (
    *("clang", "--no-default-config", "--target=wasm32-unknown-unknown", "-mcpu=lime1"),
    "-ftrivial-auto-var-init-max-size=1024",  # bytes; what is larger takes time in each call
    "-mno-bulk-memory-opt",  # newer clangs write memory.fill without bulk memory
    *("-ffreestanding", "-fbuiltin"),
)
"""The compiler itself: `zig cc` keeps each object a second time, and takes longer to start."""

_DYNAMIC = "--unresolved-symbols=import-dynamic"  # what LLD 14 does by itself


_NOT_THERE = (
    *("THREADS", "MONOTONIC_CLOCK", "LOCALIZATION", "WIDE_CHARACTERS", "FILESYSTEM", "TERMINAL"),
    *("RANDOM_DEVICE", "UNICODE", "VENDOR_AVAILABILITY_ANNOTATIONS", "TIME_ZONE_DATABASE"),
)
"""Of C++'s library, on a controller."""

_CPP_SOURCES = ("hash.cpp",)

_THROWING_SOURCES = (
    *(f"libcxx/src/{name}.cpp" for name in ("any", "optional", "stdexcept", "variant")),
    *(f"libcxxabi/src/stdlib_{name}.cpp" for name in ("exception", "stdexcept", "typeinfo")),
    "libcxxabi/src/private_typeinfo.cpp",
)
"""Of what C++'s library throws, and of types at run time."""

THROWING = ("-fexceptions", "-frtti", "-mllvm", "-enable-emscripten-cxx-exceptions")
"""Options for sources that throw, catch or ask for types (docs/decisions/0046)."""

_READ_BY_THROWING = FOLDER / "plcsim_exceptions.h"


class Toolchain(NamedTuple):
    """A compiler and a linker.

    Attributes:
        name: with its version, for people.
        identity: tells one toolchain from another in what is kept of its work.
        c: command that compiles C, with its target.
        cpp: the same for C++.
        linker: command that links, with what its version needs.
        cpp_options: by which C++ finds the headers of its library, where the toolchain has it.
        libraries: what these headers need is linked from here.
        throwing: options for C++ that throws exceptions; () where that cannot be compiled.
        rounds: of a small loop for one jump back: what was fastest (docs/decisions/0034).
    """

    name: str
    identity: str
    c: tuple[str, ...]
    cpp: tuple[str, ...]
    linker: tuple[str, ...]
    cpp_options: tuple[str, ...] = ()
    libraries: tuple[StaticLibrary, ...] = ()
    throwing: tuple[str, ...] = ()
    rounds: int = 2

    def environment(self) -> dict[str, str]:
        """Return the environment to run it in: nothing of the user's C setup takes part."""
        ignored = ("CPATH", "C_INCLUDE_PATH", "CPLUS_INCLUDE_PATH", "CCC_OVERRIDE_OPTIONS")
        return {k: v for k, v in os.environ.items() if k not in ignored} | {"LC_ALL": "C"}


def find_toolchain() -> Toolchain:
    """Return the compiler and linker of this system.

    Raises:
        ConfigurationError: there is none; the message says how to get one.
    """
    found = zig() or system_clang()
    if found is None:
        raise ConfigurationError(MISSING)
    return found


@cache
def zig() -> Toolchain | None:
    """Return the toolchain in the package ``ziglang``, None where it is not installed."""
    spec = find_spec("ziglang")
    if spec is None or not spec.submodule_search_locations:
        return None
    program = Path(spec.submodule_search_locations[0]) / "zig"
    if not program.is_file():
        return None
    try:
        number = version("ziglang")
    except PackageNotFoundError:
        number = "unknown"
    folder = program.parent / "lib"
    compiler = (str(program), *_ZIG_OPTIONS, "-isystem", str(folder / "include"))
    return Toolchain(
        f"zig {number}",
        f"zig {number}",
        compiler,
        compiler,
        (str(program), "wasm-ld", _DYNAMIC),
        *_cpp_library(folder),
    )


def _cpp_library(
    folder: Path,
) -> tuple[tuple[str, ...], tuple[StaticLibrary, ...], tuple[str, ...]]:
    """Return the options for the headers of a libc++, what they need of its sources, and THROWING.

    Args:
        folder: with libcxx and libcxxabi.
    """
    headers = folder / "libcxx" / "include"
    if not headers.is_dir():
        return (), (), ()
    settings = {
        "ABI_VERSION": "1",
        "ABI_NAMESPACE": "__1",
        "HARDENING_MODE_DEFAULT": "_LIBCPP_HARDENING_MODE_FAST",
        "ASSERTION_SEMANTIC_DEFAULT": "_LIBCPP_ASSERTION_SEMANTIC_ENFORCE",
        **dict.fromkeys((f"HAS_{name}" for name in _NOT_THERE), "0"),
    }
    defined = (f"-D_LIBCPP_{name}={value}" for name, value in settings.items())
    more = tuple(folder / "libcxx" / "src" / name for name in _CPP_SOURCES)
    options = ("-nostdinc++", "-I", str(FOLDER / "include"), "-I", str(headers), *defined)
    inner = ("libcxxabi/include", "libcxxabi/src", "libcxx/src")
    found = tuple(part for name in inner for part in ("-I", str(folder / name)))
    header = (Path(_READ_BY_THROWING.name),)
    sources = (
        *(FOLDER / "cpp_throwing_library.cpp", *more),
        *(folder / name for name in _THROWING_SOURCES),
    )
    libraries = (
        StaticLibrary((FOLDER / "cpp_exceptions.cpp",), header, ("-frtti", "-g0", *found)),
        StaticLibrary(sources, header, (*THROWING, *found)),
        StaticLibrary((FOLDER / "cpp_library.cpp", *more), (headers,)),
    )
    return options, libraries, (*THROWING, "-include", str(_READ_BY_THROWING))


@cache
def system_clang() -> Toolchain | None:
    """Return the newest clang with a linker of the same version on the path, None without one."""
    for number in ("", *(f"-{n}" for n in range(NEWEST, OLDEST - 1, -1))):
        clang, cpp, linker = (
            shutil.which(name + number) for name in ("clang", "clang++", "wasm-ld")
        )
        if clang and cpp and linker and (found := _version(clang)) >= OLDEST:
            options = (f"--target={_TARGET}", *(_BEFORE_16 if found < 16 else ()))
            return Toolchain(
                f"clang {found}",
                f"{_state(clang)} {_state(linker)}",
                (clang, *options),
                (cpp, *options),
                (linker, _DYNAMIC) if found > OLDEST else (linker,),
                rounds=4 if found == OLDEST else 2,
            )
    return None


def _version(clang: str) -> int:
    """Return the main version of a clang by the name of its file, such as ``llvm-14/bin/clang``."""
    found = re.findall(r"(?:clang|llvm)-?(\d+)", str(Path(clang).resolve()))
    return int(found[-1]) if found else OLDEST


def _state(program: str) -> str:
    """Return what changes when a program is replaced by another version."""
    file = Path(program).resolve()
    status = file.stat()
    return f"{file} {status.st_size} {status.st_mtime_ns}"
