"""Options of GCC, as a project names them, as far as they mean something here."""

from __future__ import annotations

import re
import shlex
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from collections.abc import Sequence

_MEANINGLESS: Final = re.compile(
    # the processor, how fast and how well to be looked into: that is decided here
    r"-m(?!llvm).*|-O.*|-g.*|-flto.*|-f(?:no-)?(?:pic|PIC|pie|PIE|common)|-fvisibility=.*"
    # what needs a library that a controller has not
    r"|-fstack-protector.*|-fprofile.*|-ftest-coverage|--coverage|-pg"
    # what a source throws tells the compiler
    r"|-f(?:no-)?(?:exceptions|rtti)"
    # clang warns of more than GCC
    r"|-Werror.*|-pedantic-errors"
    # by these warnings is known what is to be mended
    r"|-w|-Wno-(?:return-type|implicit-function-declaration|implicit)"
    r"|-f(?:no-)?strict-volatile-bitfields|-ansi|-[cSE]"
)
_STANDARD: Final = re.compile(r"-std=.*")
_FIRST_OF_C11: Final = 5


def split(options: str) -> list[str]:
    """Return the options that a project has in one line, as far as they mean something here."""
    try:
        found = shlex.split(options)
    except ValueError:  # a quotation mark without a second one
        found = options.split()
    return [each for each in found if not _MEANINGLESS.fullmatch(each)]


def of_version(gcc_version: str) -> list[str]:
    """Return the options by which sources find the GCC that they were written for.

    Args:
        gcc_version: such as "6.3.0"; "" for that of the compiler.
    """
    numbers = [int(part) for part in gcc_version.split(".") if part.isdecimal()]
    names = ("__GNUC__", "__GNUC_MINOR__", "__GNUC_PATCHLEVEL__")
    options = [
        option
        for name, number in zip(names, numbers, strict=False)
        for option in (f"-U{name}", f"-D{name}={number}")
    ]
    if numbers and numbers[0] < _FIRST_OF_C11:
        options.append("-fgnu89-inline")  # an inline function is defined for other files, too
    return options


def for_language(options: Sequence[str], *, is_c: bool) -> list[str]:
    """Return those of some options that clang is to have for a file of a language.

    Args:
        options: as of `split` and `of_version`.
        is_c: whether the file is C and not C++.
    """
    return [
        option
        for option in options
        if not (_STANDARD.fullmatch(option) and ("++" in option) == is_c)
        and (is_c or option != "-fgnu89-inline")
    ]


def of_layout(options: Sequence[str]) -> list[str]:
    """Return the options that sources which are not the project's have to share with its own.

    They are compiled once for all projects that have the same ones.
    """
    return [option for option in options if option.startswith("-f")]
