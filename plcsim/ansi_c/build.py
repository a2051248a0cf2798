"""Compiles C files and links them to one position-independent module; what is known is kept.

An object is compiled again where its source, a header that it read, the options or the compiler
have changed, and a module is linked again where an object has.
"""

from __future__ import annotations

import hashlib
import itertools
import json
import os
import re
import subprocess
import sys
import tempfile
from collections import deque
from contextlib import ExitStack
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from plcsim.ansi_c.conversions import SATURATE, as_gcc_converts, may_convert
from plcsim.ansi_c.gcc_options import for_language, of_layout
from plcsim.ansi_c.loops import may_have_loops, seems_without_loops
from plcsim.ansi_c.mends import Mends
from plcsim.ansi_c.plain_words import defined_twice, explained, place_of
from plcsim.ansi_c.symbols import chosen, symbols_of, with_common, without_weak
from plcsim.ansi_c.undeclared import undeclared
from plcsim.core.errors import ConfigurationError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from plcsim.ansi_c.static_library import StaticLibrary
    from plcsim.ansi_c.toolchain import Toolchain
    from plcsim.machine.cache import CodeCache

_OPTIONS = (
    *("-c", "-fPIC", "-fvisibility=default", "-O2", "-gdwarf-4"),
    # what programs for the controller take for granted of its compiler
    *("-fno-strict-aliasing", "-fwrapv", "-fno-delete-null-pointer-checks", "-fsigned-char"),
    # a function that ends without its return goes on, a variable without a value has one
    *("-fno-strict-return", "-ftrivial-auto-var-init=zero"),
    SATURATE,
    # or a malloc that nobody uses is left out and cannot fail
    *("-fno-builtin-printf", "-fno-builtin-fprintf", "-fno-builtin-sprintf"),  # or iprintf ...
    *("-fno-builtin-malloc", "-fno-builtin-calloc", "-fno-builtin-realloc", "-fno-builtin-free"),
    *("-fno-builtin-aligned_alloc", "-fno-builtin-reallocarray"),
    *("-fno-math-errno", "-ffp-contract=off", "-fgnuc-version=11.3.0"),
    # long double is double: the one of 128 bits that WebAssembly has would be computed in software
    *("-Xclang", "-mlong-double-64"),
    # instructions that the machine does not run, and the saturating conversions of x86
    *("-mno-bulk-memory", "-mno-nontrapping-fptoint", "-mno-reference-types", "-mno-multivalue"),
    "-Wno-nonportable-include-path",  # headers are found in any case
    *("-nostdlibinc", "-fno-color-diagnostics", "-ferror-limit=0", "-Wno-unknown-warning-option"),
    *("-D_DEFAULT_INCLUDES", "-D_SG4", "-D_REPLACE_CONST"),
    # a jump through a table is one that the processor often takes to the wrong place first: the
    # kernel of texts in benchmarks/c_kernels takes a tenth longer with it
    "-fno-jump-tables",
    *("-mllvm", "-enable-emscripten-sjlj"),  # setjmp; see plcsim.ansi_c.nonlocal_jumps
    "-U__EMSCRIPTEN__",  # what the target is called says nothing about the system
)
_C_OPTIONS = (
    *("-std=gnu11", "-trigraphs"),  # in this order, and as Automation Studio calls its compiler
    # Errors in a newer clang that were none for the compilers of Automation Studio.
    *("-Wno-int-conversion", "-Wno-pointer-to-int-cast", "-Wno-int-to-pointer-cast"),
    *("-Wno-error=implicit-function-declaration", "-Wno-error=implicit-int"),
    *("-Wno-error=return-type", "-Wno-error=incompatible-pointer-types"),
    "-Wno-error=incompatible-function-pointer-types",
)
_CPP_OPTIONS = (
    *("-std=gnu++17", "-trigraphs", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics"),
    *("-fno-finite-loops", "-fcheck-new", "-Wno-register"),
    # errors in clang that are none, or warnings, in GCC
    *("-Wno-c++11-narrowing", "-Wno-reserved-user-defined-literal", "-Wno-dynamic-exception-spec"),
    # inline functions are the module's own; static objects live as long as the program
    *("-fvisibility-inlines-hidden", "-fno-c++-static-destructors"),
)
_TO_BITCODE = ("-Xclang", "-emit-llvm-bc")
_ROUNDS = (
    # Several rounds for one jump back, and one poll, in small loops whose rounds nobody knows (how
    # many, `Toolchain.rounds` says). In the first run the same option would keep loops of fixed
    # rounds from being written out.
    *("-mllvm", "-unroll-threshold=60", "-mllvm", "-pragma-unroll-threshold=60"),
)
"""A file goes through the compiler twice: to bitcode, and with these from there to an object."""
_NO_PASSES = ("-Xclang", "-disable-llvm-passes")
_TO_TEXT = ("-S", "-emit-llvm", "-w", *_NO_PASSES)
_LOOP = b"llvm.loop."
"""Stands in the bitcode of C where a loop that ends is left. Where none is there are no rounds to
write out, and the passes that the first run has done are not done again."""

_LINK_OPTIONS = ("--shared", "--experimental-pic", "--import-memory", "--import-undefined")

MANY = 8
"""Files to compile of which the user is told, as they take their time."""

_FINDING = re.compile(r"^(.+?):(\d+):(\d+): (?:fatal )?(error|warning): (.*)$", re.MULTILINE)
_LINKER = re.compile(r"^\S*wasm-ld\S*: (?:error|warning): (.*(?:\n>>> .*)*)$", re.MULTILINE)


@dataclass(frozen=True)
class BuildOrder:
    """What is to be built.

    Attributes:
        name: for people.
        sources: files in C and C++; what does not end with ``.c`` is C++.
        folders: where headers are looked for, in order.
        options: further ones of the compiler, such as ``-DX=1``.
        libraries: of which is linked what the sources need.
        made: folder whose headers always have the same content under their names; None for none.
    """

    name: str
    sources: Sequence[Path]
    folders: Sequence[Path] = ()
    options: Sequence[str] = ()
    libraries: Sequence[StaticLibrary] = ()
    made: Path | None = None


@dataclass
class Built:
    """A module.

    Attributes:
        wasm: as it was linked.
        warnings: of the compiler, as "file:line:column: text".
    """

    wasm: bytes
    warnings: list[str] = field(default_factory=list)


def build(order: BuildOrder, toolchain: Toolchain, cache: CodeCache) -> Built:
    """Compile and link.

    Raises:
        ConfigurationError: the compiler or the linker found errors; all of them are told, as
            "file:line:column: text".
    """
    with _WorkFolder() as work:
        objects = _compiled(order.sources, order, toolchain, cache, work)
        read = {file for o in objects for file in o.files}
        of_language = BuildOrder(
            "the library of C++", (), order.folders[-1:], of_layout(order.options)
        )
        offered = []
        for those, libraries in ((order, order.libraries), (of_language, toolchain.libraries)):
            for each in [library for library in libraries if library.is_used(read)]:
                own = replace(those, options=[*those.options, *each.options])
                offered += _compiled(each.sources, own, toolchain, cache, work)
        _check_initial_values(order, objects)
        taken = chosen([o.content for o in objects], [o.content for o in offered])
        objects += [offered[number] for number in taken]
        wasm = _link(order, objects, toolchain, cache, work)
    return Built(wasm, [warning for o in objects for warning in o.warnings])


def _check_initial_values(order: BuildOrder, objects: Sequence[_Object]) -> None:
    """Refuse a variable of the controller that is given initial values in two files of C.

    One in a header that both include is the same.
    """
    places: dict[str, list[str]] = {}
    for each in objects:
        if each.source.suffix.lower() == ".c":
            for name in symbols_of(each.content).valued:
                if (place := place_of(name, each.source)) != str(each.source):
                    places.setdefault(name, []).append(place)
    findings = [
        f"{order.name}: {name} has an initial value at {' and at '.join(found)}"
        for name, found in sorted(places.items())
        if len(found) > 1
    ]
    if findings:
        raise ConfigurationError(*findings)


def _compiled(
    sources: Sequence[Path],
    order: BuildOrder,
    toolchain: Toolchain,
    cache: CodeCache,
    work: _WorkFolder,
) -> list[_Object]:
    """Compile what is not known.

    Raises:
        ConfigurationError: there are errors; all of them are told.
    """
    objects = [_Object(source, work, order, toolchain) for source in sources]
    unknown = [o for o in objects if not o.load(cache)]
    if len(unknown) >= MANY:
        sys.stderr.write(f"plcsim: {order.name}: compiling {len(unknown)} files\n")
    _compile(unknown)
    findings = [finding for o in unknown for finding in o.errors]
    if findings:
        raise ConfigurationError(*findings)
    for each in unknown:
        each.store(cache)
    return objects


class _WorkFolder(ExitStack):
    """A folder for what compiler and linker write: it is made when something is written."""

    @cached_property
    def folder(self) -> Path:
        """The folder."""
        return Path(self.enter_context(tempfile.TemporaryDirectory(prefix="plcsim-c-")))

    @cached_property
    def _numbers(self) -> Iterator[int]:
        return itertools.count()

    def new_file(self) -> Path:
        """Return an object file that is not there yet."""
        return self.folder / f"{next(self._numbers)}.o"


class _Object:
    """One file to compile.

    A manifest names the headers that were read when it was compiled last, with their hashes; where
    all of them are still the same, so is the object.
    """

    def __init__(
        self, source: Path, work: _WorkFolder, order: BuildOrder, toolchain: Toolchain
    ) -> None:
        self.is_c = is_c = source.suffix.lower() == ".c"
        self.source = source
        self.content = b""
        self.errors: list[str] = []
        self.warnings: list[str] = []
        self.files: frozenset[str] = frozenset()
        self.toolchain = toolchain
        self._work = work
        self._sources = order.sources
        self._told: list[str] = []
        self._folders = order.folders
        self._made = "\0" if order.made is None else f"{order.made}{os.sep}"
        options = for_language(order.options, is_c=is_c)
        self.command = [
            *(toolchain.c if is_c else toolchain.cpp),
            *_OPTIONS,
            *(_C_OPTIONS if is_c else _CPP_OPTIONS),
            *options,
            *(part for folder in order.folders[:-1] for part in ("-I", str(folder))),
            *(() if is_c else toolchain.cpp_options),
            *(part for folder in order.folders[-1:] for part in ("-I", str(folder))),
            *("-x", "c" if is_c else "c++"),  # clang would take MAIN.C for C++
            str(source),
        ]
        self._rounds = [*_ROUNDS, "-mllvm", f"-unroll-count={toolchain.rounds}"]
        self._options = options
        ways = [*self._rounds, *_NO_PASSES]
        self._manifest = _key("manifest 4", toolchain.identity, *self.command, *ways)

    def load(self, cache: CodeCache) -> bool:
        """Take the object from the cache where nothing has changed."""
        try:
            manifest = json.loads(cache.load(self._manifest) or b"null")
            if manifest is None or any(self._hash(f) != h for f, h in manifest["files"].items()):
                return False
        except (ValueError, OSError):
            return False
        self.content = cache.load(manifest["object"]) or b""
        self.warnings = manifest["warnings"]
        self.files = frozenset(manifest["files"])
        return bool(self.content)

    @cached_property
    def _mends(self) -> Mends:
        return Mends(
            self.source,
            is_c=self.is_c,
            sources=self._sources,
            folders=self._folders,
            file=lambda: self.file,
            throwing=self.toolchain.throwing,
        )

    @cached_property
    def file(self) -> Path:
        """Where the compiler writes it, and what is linked."""
        return self._work.new_file()

    @cached_property
    def _dependencies(self) -> Path:
        return self.file.with_suffix(".d")

    @cached_property
    def _bitcode(self) -> Path:
        return self.file.with_suffix(".bc")  # the suffix tells the compiler what it is

    @cached_property
    def _text(self) -> Path:
        return self.file.with_suffix(".ll")

    @cached_property
    def is_made_at_once(self) -> bool:
        """Whether the first run of the compiler makes the object."""
        try:
            return self.is_c and seems_without_loops(self.source.read_text("latin-1"))
        except OSError:  # the compiler will tell
            return False

    def first_command(self) -> list[str]:
        """Return what compiles the source, to an object where no second run is expected."""
        if self.is_made_at_once:
            return self.command_that_tells()
        return self.command_to_bitcode()

    def command_to_bitcode(self) -> list[str]:
        """Return what compiles the source."""
        return [*self._whole_command(), *_TO_BITCODE, "-o", str(self._bitcode)]

    def command_to_object(self) -> list[str]:
        """Return what makes an object of the bitcode."""
        has_loops = not self.is_c or _LOOP in self._bitcode.read_bytes()
        passes = self._rounds if has_loops else _NO_PASSES
        options = [*self._later_options(), *passes]
        return [*self.toolchain.c, *options, str(self._bitcode), "-o", str(self.file)]

    def _later_options(self) -> list[str]:
        """Return the options for what a run of the compiler has written."""
        mended = self._mends.later_options()
        return [*_OPTIONS, *self._options, *mended, "-Wno-unused-command-line-argument"]

    def command_to_text(self) -> list[str]:
        """Return what writes the source as text of the compiler's intermediate representation."""
        return [*self._whole_command(), *_TO_TEXT, "-o", str(self._text)]

    def command_of_text(self) -> list[str]:
        """Return what compiles that text, as `first_command` does the source."""
        to_object = self.is_made_at_once
        target = [str(self.file)] if to_object else [str(self._bitcode), *_TO_BITCODE]
        options = [*self._later_options(), "-w"]
        return [*self.toolchain.c, *options, str(self._text), "-o", *target]

    def command_that_tells(self) -> list[str]:
        """Return what makes an object at once, and so knows where what is wrong in it stands."""
        return [*self._whole_command(), "-o", str(self.file)]

    def _whole_command(self) -> list[str]:
        return [*self.command, *self._mends.options(), "-MD", "-MF", str(self._dependencies)]

    def take(self, code: int, told: str) -> None:
        """Take what a run of the compiler has told."""
        found = [
            (m[4], f"{m[1]}:{m[2]}:{m[3]}: {m[5]}")
            for m in _FINDING.finditer(told)
            if m[1] != str(self._bitcode)  # it is no place in a source
        ]
        self.warnings += [text for kind, text in found if kind == "warning"]
        if code:
            self._told = [text for kind, text in found if kind == "error"]
            words = (explained(text, self._folders) for text in self._told)
            self.errors = list(dict.fromkeys(words))
            if not self.errors:
                self.errors = [f"{self.source}: the compiler ended with {code}: {told.strip()}"]

    def is_mended(self) -> bool:
        """Return whether the file is to be compiled again, after what was told of it."""
        is_mended = self._mends.find(self._told, self.warnings)
        if is_mended:
            self._begin_again()
        return is_mended

    def keeps_loops(self) -> bool:
        """Return whether there are loops in an object that was made at once.

        The file then goes through the compiler twice.
        """
        if self.errors or not self.is_made_at_once or not may_have_loops(self.file.read_bytes()):
            return False
        self.is_made_at_once = False
        self._begin_again()
        return True

    def converts(self) -> bool:
        """Return whether the object may make integers of numbers, which clang does its own way."""
        return not self.errors and may_convert(self.file.read_bytes())

    def is_rewritten(self) -> bool:
        """Return whether the text was, so that they are converted as GCC does it."""
        before = self._text.read_text("utf-8", "surrogateescape")
        after = as_gcc_converts(before)
        if after != before:
            self._text.write_text(after, "utf-8", "surrogateescape")
        return after != before

    def _begin_again(self) -> None:
        """Forget what the next run tells again."""
        self.warnings = list(self._mends.told)
        self._told, self.errors = [], []

    def finish(self) -> None:
        """Take what the compiler has made."""
        self.content = self.file.read_bytes()
        read = {str(self.source), *_read_dependencies(self._dependencies)}
        if undeclared(self.warnings):
            read |= {str(source) for source in self._sources}
        self.files = frozenset(read - {str(self._mends.header)})

    def _hash(self, file: str) -> str:
        """Return the hash of a file; "" where its name says already what is in it."""
        return "" if file.startswith(self._made) else _hash_of(file)

    def store(self, cache: CodeCache) -> None:
        """Keep the object."""
        key = _key("object", self.content)
        manifest = {
            "files": {file: self._hash(file) for file in sorted(self.files)},
            "object": key,
            "warnings": self.warnings,
        }
        cache.store(key, self.content)
        cache.store(self._manifest, json.dumps(manifest).encode())


def _compile(objects: Sequence[_Object]) -> None:
    """Compile files."""
    _run(objects, _Object.first_command)
    again = objects
    while again := [each for each in again if each.is_mended()]:
        _run(again, _Object.first_command)
    _run([each for each in objects if each.keeps_loops()], _Object.command_to_bitcode)
    right = [each for each in objects if not each.errors and not each.is_made_at_once]
    _run(right, _Object.command_to_object)
    _run([each for each in right if each.errors], _Object.command_that_tells)
    _convert([each for each in objects if each.converts()])
    for each in objects:
        if not each.errors:
            each.finish()


def _convert(objects: Sequence[_Object]) -> None:
    """Compile files again in which numbers become integers."""
    _run(objects, _Object.command_to_text)
    again = [each for each in objects if not each.errors and each.is_rewritten()]
    _run(again, _Object.command_of_text)
    _run([each for each in again if not each.is_made_at_once], _Object.command_to_object)


def _run(objects: Sequence[_Object], command: Callable[[_Object], list[str]]) -> None:
    """Run the compiler on files, on as many at a time as there are processors."""
    at_once = max(1, len(os.sched_getaffinity(0)))
    running: deque[tuple[_Object, subprocess.Popen[str]]] = deque()
    with ExitStack() as stack:
        for each in objects:
            if len(running) == at_once:
                _wait(*running.popleft())
            running.append((each, stack.enter_context(_started(each.toolchain, command(each)))))
        while running:
            _wait(*running.popleft())


def _wait(compiled: _Object, process: subprocess.Popen[str]) -> None:
    told, _ = process.communicate()
    compiled.take(process.returncode, told)


def _started(toolchain: Toolchain, command: list[str]) -> subprocess.Popen[str]:
    return subprocess.Popen(  # noqa: S603  # a compiler that we have found
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        encoding="utf-8",
        errors="replace",
        env=toolchain.environment(),
    )


def _link(
    order: BuildOrder,
    objects: Sequence[_Object],
    toolchain: Toolchain,
    cache: CodeCache,
    work: _WorkFolder,
) -> bytes:
    key = _key("module 2", toolchain.identity, *_LINK_OPTIONS, *(o.content for o in objects))
    known = cache.load(key)
    if known is not None:
        return known
    for compiled, content in zip(objects, _as_one(objects), strict=True):
        compiled.file.write_bytes(content)
    target = work.folder / "module.wasm"
    command = [
        *toolchain.linker,
        *_LINK_OPTIONS,
        *(str(o.file) for o in objects),
        "-o",
        str(target),
    ]
    done = subprocess.run(  # noqa: S603  # a linker that we have found
        command,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        errors="replace",
        check=False,
        env=toolchain.environment(),
    )
    if done.returncode:
        raise ConfigurationError(*_linker_findings(order, objects, done.stderr))
    wasm = target.read_bytes()
    cache.store(key, wasm)
    return wasm


def _as_one(objects: Sequence[_Object]) -> list[bytes]:
    """Return the objects of one module, in which the same name is the same as far as C has it."""
    common = iter(with_common([o.content for o in objects if o.is_c]))
    return without_weak([next(common) if o.is_c else o.content for o in objects])


def _linker_findings(order: BuildOrder, objects: Sequence[_Object], told: str) -> list[str]:
    """Return what the linker said, with the names of the sources in place of the objects."""
    for compiled in objects:
        told = told.replace(str(compiled.file), str(compiled.source))
    texts = [m[1].replace("\n>>>", ",") for m in _LINKER.finditer(told)]
    found = [f"{order.name}: {defined_twice(text)}" for text in texts]
    return found or [f"{order.name}: cannot be linked: {told.strip()}"]


def _read_dependencies(file: Path) -> Iterator[str]:
    """Yield the files that a source has read, from the rule that the compiler wrote for make."""
    rule = file.read_text("utf-8", "replace").replace("\\\n", " ")
    _, _, names = rule.partition(": ")
    for name in re.findall(r"(?:\\.|[^\s\\])+", names):
        yield re.sub(r"\\(.)", r"\1", name).replace("$$", "$")


def _key(*parts: str | bytes) -> str:
    state = hashlib.blake2b(digest_size=24)
    for part in parts:
        data = part.encode() if isinstance(part, str) else part
        state.update(len(data).to_bytes(8, "little") + data)
    return state.hexdigest()


def _hash_of(file: str) -> str:
    status = os.stat(file)  # noqa: PTH116  # of thousands of files
    return _content_hash(file, status.st_size, status.st_mtime_ns, status.st_ino)


@lru_cache(maxsize=4096)
def _content_hash(file: str, _size: int, _mtime_ns: int, _inode: int) -> str:
    """Return the hash of a file in this state: many programs read the same headers."""
    return hashlib.blake2b(Path(file).read_bytes(), digest_size=24).hexdigest()
