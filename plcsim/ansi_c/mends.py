"""What GCC takes and clang does not, made the same for both when clang has told where it stands."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, Final

from plcsim.ansi_c.case_blind import spelled
from plcsim.ansi_c.nested_functions import NEEDED, OPTION, as_block
from plcsim.ansi_c.plain_words import THROWS
from plcsim.ansi_c.rewriting import Rewriting
from plcsim.ansi_c.toolchain import THROWING
from plcsim.ansi_c.undeclared import declarations, undeclared

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Sequence

_NO_FILE: Final = re.compile(r"(.+?):\d+:\d+: '[^']+' file not found$")
_INCLUDE: Final = re.compile(rb'^([ \t]*#[ \t]*include[ \t]*["<])([^">\n]+)(?=[">])', re.MULTILINE)
_NO_RETURN: Final = re.compile(
    r"(.+?):(\d+):(\d+): non-void (?:function|lambda|block) does not return a value"
)
_NO_NUMBER: Final = re.compile(r"(.+?):(\d+):(\d+): returning 'int' from a function with")
_NESTED: Final = re.compile(r"(.+?):(\d+):(\d+): function definition is not allowed here")
_NO_NAME: Final = re.compile(r"(.+?):(\d+):(\d+): expected identifier")
_NEW_IN_CPP_17: Final = re.compile(
    r": reference to '\w+' is ambiguous|ISO C\+\+17 does not allow|"
    r"'(?:auto_ptr|random_shuffle|unary_function|binary_function|bind1st|bind2nd|ptr_fun|mem_fun)'"
)
_CPP_14: Final = "-std=gnu++14"
_TRUTH: Final = re.compile(rb"\b(?:TRUE|FALSE)\b")
_OWN_TRUTH: Final = "#define PLCSIM_OWN_TRUTH\n"
_VALUE_IN_C: Final = b"return ((0));"
_VALUE_IN_CPP: Final = b"return plcsim_no_value();"
_ANY_VALUE: Final = """
struct plcsim_no_value {
	template <class T> operator T &() const { alignas(16) static char z[4096]; return (T &)z; }
};
"""


class Mends:
    """How one source is read after what the compiler told of it.

    Args:
        source: the file that is compiled.
        is_c: whether it is C and not C++.
        sources: all of the program, which may define what this one calls.
        folders: where headers are looked for, besides the one of the file that includes them.
        file: gives the name of a file of its own for what is written; its suffix is replaced.
        throwing: options for C++ that throws exceptions, none where that cannot be compiled.

    Attributes:
        told: warnings that do not come again, as what they tell of is mended.
    """

    def __init__(
        self,
        source: Path,
        *,
        is_c: bool,
        sources: Sequence[Path],
        folders: Sequence[Path],
        file: Callable[[], Path],
        throwing: Sequence[str] = (),
    ) -> None:
        self._rewriting = Rewriting(source, file)
        self._is_c = is_c
        self._sources = sources
        self._folders = folders
        self._file = file
        self._head = ""
        self._given: set[tuple[Path, int]] = set()
        self._standard: tuple[str, ...] = ()
        self._can_throw = throwing
        self._throwing: Sequence[str] = ()
        self.told: list[str] = []

    @property
    def header(self) -> Path:
        """The file that is read before the source, where there is something to be said."""
        return self._file().with_suffix(".h")

    def options(self) -> list[str]:
        """Return the options by which the compiler reads what was changed."""
        options = [*self._standard, *self._throwing]
        if not self._head:
            return [*options, *self._rewriting.options()]
        self.header.write_text(self._head, "utf-8")
        blocks = [OPTION] if NEEDED in self._head else []
        return [*options, *blocks, "-include", str(self.header), *self._rewriting.options()]

    def later_options(self) -> list[str]:
        """Return those that also count where the compiler goes on from what it has written."""
        return list(self._throwing[: len(THROWING)])

    def find(self, errors: Sequence[str], warnings: Sequence[str]) -> bool:
        """Mend what can be mended; return whether the source is to be compiled again.

        Args:
            errors: of the last run of the compiler, as "file:line:column: text".
            warnings: likewise.
        """
        found = [self._declare(warnings), self._find_headers(errors), self._own_truth(errors)]
        found += [self._use_blocks(errors), self._use_cpp_14(errors), self._let_throw(errors)]
        return any([*found, self._without_numbers(errors) or self._give_values(warnings, errors)])

    def _declare(self, warnings: Sequence[str]) -> bool:
        """Declare functions that are called undeclared, and are not what C takes them for."""
        names = undeclared(warnings) - undeclared(self.told)
        text = declarations(names, self._sources) if names and self._is_c else ""
        self._head += text
        self.told += [each for each in warnings if undeclared([each]) & names] if text else []
        return bool(text)

    def _own_truth(self, errors: Sequence[str]) -> bool:
        """Leave TRUE and FALSE to a source that declares them itself: ``enum { FALSE, TRUE };``."""
        is_new = _OWN_TRUTH not in self._head and any(
            _TRUTH.match(self._rewriting.line(file, line), column - 1)
            for file, line, column in _places(_NO_NAME, errors)
        )
        self._head += _OWN_TRUTH if is_new else ""
        return is_new

    def _use_blocks(self, errors: Sequence[str]) -> bool:
        """Make a function in a function a block; the next one comes the next time."""
        for file, line, column in _places(_NESTED, errors if self._is_c else ()):
            text = as_block(self._rewriting.text(file), line, column)
            if self._rewriting.put(file, text):
                self._head += "" if NEEDED in self._head else NEEDED
                return True
        return False

    def _use_cpp_14(self, errors: Sequence[str]) -> bool:
        """Read C++ as GCC did before version 11: without std::byte, std::size and std::data."""
        is_new = not (self._is_c or self._standard) and any(map(_NEW_IN_CPP_17.search, errors))
        self._standard = (_CPP_14,) if is_new else self._standard
        return is_new

    def _let_throw(self, errors: Sequence[str]) -> bool:
        """Have exceptions, and types at run time, in a source that uses them."""
        is_new = not self._throwing and any(map(THROWS.search, errors))
        self._throwing = self._can_throw if is_new else self._throwing
        return bool(is_new and self._throwing)

    def _find_headers(self, errors: Sequence[str]) -> bool:
        r"""Give headers that were not found the spelling that they have on the disk.

        ``#include "..\Common\types.h"`` means on Windows the file ``../common/Types.h``.
        """
        files = [Path(found[1]) for text in errors if (found := _NO_FILE.match(text))]
        seen: set[Path] = set()
        return any(self._spell_headers(file, seen) for file in files)

    def _spell_headers(self, file: Path, seen: set[Path]) -> bool:
        """Spell what a file includes, and what those files include."""
        if file in seen:
            return False
        seen.add(file)
        further: list[Path] = []

        def replaced(found: re.Match[bytes]) -> bytes:
            name = os.fsdecode(found[2]).replace("\\", "/")
            for folder in (file.parent, *self._folders):
                if known := spelled(folder, name):
                    further.append(Path(os.path.normpath(folder / known)))
                    return found[1] + os.fsencode(known)
            return found[0]

        text = _INCLUDE.sub(replaced, self._rewriting.text(file))
        is_new = self._rewriting.put(file, text)
        return any([is_new, *(self._spell_headers(each, seen) for each in further)])

    def _give_values(self, warnings: Sequence[str], errors: Sequence[str]) -> bool:
        """Let functions that end without a return give 0, as if a register happened to hold that.

        clang takes for granted that no function of C++ comes there, and that of C nobody looks at
        the value.
        """
        is_new = False
        places = {*_places(_NO_RETURN, (*warnings, *errors))}
        for file, line, column in sorted(places, reverse=True):  # so that columns before stay
            if (file, line) not in self._given:
                is_new |= self._insert(file, line, column)
        if is_new:
            self._given |= {(file, line) for file, line, _ in places}
            self.told += [each for each in warnings if _NO_RETURN.match(each)]
            if not self._is_c and _ANY_VALUE not in self._head:
                self._head += _ANY_VALUE
        return is_new

    def _insert(self, file: Path, line: int, column: int) -> bool:
        """Insert a return before the brace at a place."""
        whole = self._rewriting.line(file, line)
        head, tail = whole[: column - 1], whole[column - 1 :]
        if not tail.startswith(b"}"):
            return False  # it comes out of a macro
        value = _VALUE_IN_C if self._is_c else _VALUE_IN_CPP
        return self._rewriting.put_line(file, line, head + value + tail)

    def _without_numbers(self, errors: Sequence[str]) -> bool:
        """Take the 0 away again where a function of C returns a structure."""
        is_new = False
        for file, line, _ in _places(_NO_NUMBER, errors):
            text = self._rewriting.line(file, line).replace(_VALUE_IN_C, b"")
            is_new |= self._rewriting.put_line(file, line, text)
        return is_new


def _places(kind: re.Pattern[str], told: Iterable[str]) -> Iterator[tuple[Path, int, int]]:
    """Yield file, line and column of what the compiler told of a kind."""
    for found in filter(None, map(kind.match, told)):
        yield Path(found[1]), int(found[2]), int(found[3])
