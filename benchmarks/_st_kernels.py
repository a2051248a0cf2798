"""Kernels in Structured Text and in C: compiled, on the same variables, ready to be timed."""

from __future__ import annotations

import ctypes
import itertools
import subprocess
from time import perf_counter_ns, process_time
from typing import TYPE_CHECKING, Any, NamedTuple

from plcsim.core.memory import Memory
from plcsim.machine import CodeCache, Machine
from plcsim.machine import opcodes as op
from plcsim.machine.encoder import NO_ARGUMENTS, ModuleWriter, Signature, sleb, uleb
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check.declared import declarations_of
from plcsim.program.structured_text.check.program import check_program
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.link import Linker
from plcsim.program.structured_text.lower.memory import Spot
from plcsim.program.structured_text.lower.module import lower
from plcsim.program.structured_text.syntax.parser import parse_structured_text
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source
from st_types.types.derived import ArrayType, Member, StringType, StructType, resolve_alias
from st_types.types.values import initial_image

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from plcsim.program.structured_text.codegen.object_code import ObjectCode
    from plcsim.program.structured_text.codegen.options import CodegenOptions
    from plcsim.program.structured_text.lower.semantics import Semantics

MOST_VARIABLES = 8 << 20
"""Bytes of PLC memory."""


class Text(NamedTuple):
    """A kernel as it is written.

    Attributes:
        name: of the kernel.
        declarations: texts of .var, .typ and .fun files, by their names.
        programs: texts of .st files, likewise.
        c: the same in C: a function ``cyclic`` on a struct ``v``.
        cycles: cycles of one measurement.
    """

    name: str
    declarations: dict[str, str]
    programs: dict[str, str]
    c: str
    cycles: int


def read(folder: Path, cycles: int) -> Text:
    """Return a kernel that lies in a folder."""
    texts = {file.name: file.read_text("utf-8") for file in sorted(folder.iterdir())}
    programs = {name: text for name, text in texts.items() if name.endswith(".st")}
    c = texts.pop("kernel.c")
    declared = {name: text for name, text in texts.items() if name not in programs}
    return Text(folder.name, declared, programs, c, cycles)


class Times(NamedTuple):
    """CPU seconds of the steps of a compiler, except for ``machine``."""

    parse_s: float
    check_s: float
    lower_s: float
    generate_s: float


class Compiled(NamedTuple):
    """A compiled kernel.

    Attributes:
        code: of the program.
        variables: all of them as one STRUCT.
        segment: name of the segment that they lie in.
        times: what each step took.
    """

    code: ObjectCode
    variables: StructType[Any]
    segment: str
    times: Times


def compile_text(text: Text, semantics: Semantics, options: CodegenOptions) -> Compiled:
    """Compile a kernel."""
    stamps = [process_time()]
    files = [parse_structured_text(Source(*item)) for item in text.programs.items()]
    stamps.append(process_time())
    declared = [parse_declarations(Source(*item)) for item in text.declarations.items()]
    scope = Scope(text.name, [*declared, *map(declarations_of, files)])
    program = check_program(text.name, files, scope)
    for file in files:
        file.diagnostics.raise_errors()
    stamps.append(process_time())
    variables = _variables(scope)
    segment = ir.Segment("program", variables.size, variables.alignment)
    names = [member.name for member in variables.members]
    offsets = dict(zip(names, variables.offsets, strict=True))
    area = {name: Spot(segment, offset) for name, offset in offsets.items()}
    module = lower(program, dict.fromkeys(program.scopes, area), semantics)
    stamps.append(process_time())
    code = generate(module, options)
    stamps.append(process_time())
    steps = [after - before for before, after in itertools.pairwise(stamps)]
    return Compiled(code, variables, segment.name, Times(*steps))


def _variables(scope: Scope) -> StructType[Any]:
    members = [
        Member(variable.name, variable.data_type, variable.initial)
        for variable in scope.variables
        if not variable.is_constant
    ]
    return StructType(scope.name, members)


class OnMachine:
    """A compiled kernel on a machine.

    Args:
        compiled: the kernel.
        fuel: instructions are counted.
    """

    def __init__(self, compiled: Compiled, *, fuel: bool = False) -> None:
        self._memory = Memory(MOST_VARIABLES)
        machine = Machine(self._memory, fuel=fuel, cache=CodeCache(None))
        addresses = {
            one.name: self._memory.allocate(max(one.size, 1), 8) for one in compiled.code.segments
        }
        for one in compiled.code.segments:
            if one.data:
                self._memory.write(addresses[one.name], one.data)
        self.address = addresses[compiled.segment]
        self._size = compiled.variables.size
        linker = Linker(machine)
        code = linker.compiled(compiled.code, addresses)
        instance = linker.link(compiled.code, code, _nothing)
        self.cyclic = instance.function("cyclic")
        self.machine = machine
        driver = machine.compile(_driver())
        caller = machine.instantiate(driver, {("program", "cyclic"): instance.extern("cyclic")})
        self._drive = caller.function("drive")

    def set(self, image: bytes) -> None:
        """Give all variables their values."""
        self._memory.write(self.address, image)

    def get(self) -> bytes:
        """Return all variables."""
        return self._memory.read(self.address, self._size)

    def ns_per_cycle(self, cycles: int) -> float:
        """Run that many cycles in a row."""
        start_ns = perf_counter_ns()
        self._drive(cycles)
        return (perf_counter_ns() - start_ns) / cycles


def _nothing(wanted: ir.Import) -> Any:
    raise LookupError(wanted.name)


def _driver() -> bytes:
    """Return a module that calls the unit again and again, as a C loop does."""
    writer = ModuleWriter("driver")
    writer.import_memory("env", "memory")
    cyclic = writer.import_function("program", "cyclic", NO_ARGUMENTS)
    drive = writer.function(Signature(bytes([op.I32])), "drive")
    count = uleb(0)
    code = op.LOOP + op.EMPTY + op.CALL + uleb(cyclic) + op.LOCAL_GET + count
    code += op.I32_CONST + sleb(1) + op.I32_SUB + op.LOCAL_TEE + count + op.BR_IF + uleb(0) + op.END
    writer.body(drive, code)
    writer.export_function("drive", drive)
    return writer.encode().wasm


C_TYPES = {
    "BOOL": "unsigned char",
    "USINT": "unsigned char",
    "SINT": "signed char",
    "UINT": "unsigned short",
    "INT": "short",
    "UDINT": "unsigned int",
    "DINT": "int",
    "TIME": "int",
    "REAL": "float",
    "LREAL": "double",
}

DRIVE = """
void drive(int cycles)
{
	while (cycles--) {
		cyclic();
		__asm__ volatile("" ::: "memory");
	}
}
"""


class InC:
    """A kernel as a C compiler compiles it.

    Args:
        text: the kernel.
        variables: all of them as one STRUCT.
        level: of optimisation, such as "-O2".
        folder: for files.
        compiler: gcc, or another one that takes its options.
    """

    def __init__(
        self,
        text: Text,
        variables: StructType[Any],
        level: str,
        folder: Path,
        compiler: str = "gcc",
    ) -> None:
        source = folder / f"{text.name}.c"
        library = folder / f"{text.name}{level}.{compiler}.so"
        source.write_text(f"{_c_types(variables)}\n{text.c}\n{DRIVE}", "utf-8")
        flags = ["-fno-strict-aliasing", "-fwrapv", "-shared", "-fPIC", "-w"]
        command = [compiler, level, *flags, "-o", str(library), str(source)]
        subprocess.run(command, check=True)
        loaded = ctypes.CDLL(str(library))
        self._drive = loaded.drive
        self._variables = (ctypes.c_char * variables.size).in_dll(loaded, "v")

    def set(self, image: bytes) -> None:
        """Give all variables their values."""
        ctypes.memmove(self._variables, image, len(image))

    def get(self) -> bytes:
        """Return all variables."""
        return bytes(self._variables)

    def ns_per_cycle(self, cycles: int) -> float:
        """Run that many cycles in a row."""
        start_ns = perf_counter_ns()
        self._drive(cycles)
        return (perf_counter_ns() - start_ns) / cycles


def _c_types(variables: StructType[Any]) -> str:
    """Return the structs of a kernel in C, and its variables as ``v``; offsets are checked."""
    written: dict[str, str] = {}
    _c_struct(variables, "Variables", written)
    return "\n".join([*written.values(), "Variables v;"])


def _c_struct(struct: StructType[Any], name: str, written: dict[str, str]) -> None:
    members = sorted(zip(struct.offsets, struct.members, strict=True))
    fields = [_c_member(member.data_type, member.name, written) for _, member in members]
    checks = [
        f'_Static_assert(__builtin_offsetof({name}, {member.name}) == {offset}, "{member.name}");'
        for offset, member in members
    ]
    body = "".join(f"\t{field};\n" for field in fields)
    written[name] = f"typedef struct {{\n{body}}} {name};\n" + "\n".join(checks)


def _c_member(data_type: Any, name: str, written: dict[str, str]) -> str:
    kind = resolve_alias(data_type)
    if isinstance(kind, ArrayType):
        sizes = "".join(f"[{high - low + 1}]" for low, high in kind.bounds)
        return _c_member(kind.element, name + sizes, written)
    if isinstance(kind, StringType):
        return f"char {name}[{kind.length + 1}]"
    if isinstance(kind, StructType):
        if kind.name not in written:
            _c_struct(kind, kind.name, written)
        return f"{kind.name} {name}"
    return f"{C_TYPES[kind.name]} {name}"


def start_of(variables: StructType[Any]) -> bytes:
    """Return the initial values of all variables."""
    return initial_image(variables)


def check_equal(kernels: Sequence[OnMachine | InC], image: bytes, cycles: int) -> None:
    """Run all from the same values, and compare all variables.

    Raises:
        AssertionError: they differ.
    """
    results = []
    for kernel in kernels:
        kernel.set(image)
        kernel.ns_per_cycle(cycles)
        results.append(kernel.get())
    assert all(result == results[0] for result in results), "the kernels differ"
