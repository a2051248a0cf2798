"""Structured Text from its text to values in memory: compiled, linked, run."""

from pathlib import Path

from plcsim.core.memory import Memory
from plcsim.machine import CodeCache, Machine
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.check import located
from plcsim.program.structured_text.check.declared import declarations_of
from plcsim.program.structured_text.check.program import check_program
from plcsim.program.structured_text.codegen.generate import generate
from plcsim.program.structured_text.codegen.link import Linker
from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.languages.readers import parse_units
from plcsim.program.structured_text.lower.memory import DIRECT, Spot
from plcsim.program.structured_text.lower.module import lower
from plcsim.program.structured_text.lower.semantics import AUTOMATION_STUDIO
from st_types.resolve import dialect as dialects
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source
from st_types.types.derived import Member, StructType
from st_types.types.paths import find
from st_types.types.values import decode, encode

SIZE = 1 << 20
NOT_STORED = ("VAR_EXTERNAL", "VAR_TEMP")


STANDARD = Path(__file__).parents[5] / "plcsim" / "library" / "standard" / "standard.fun"


def standard(dialect):
    """The scope of the library standard."""
    return Scope("standard", [parse_declarations(Source.read(STANDARD))], dialect=dialect)


def checked(
    text,
    declarations="",
    dialect=dialects.AUTOMATION_STUDIO,
    hidden=(FindingCode.UNUSED_VARIABLE,),
    path="a.st",
):
    """Return the checked program, its scope, and the findings as ``line:column CODE message``."""
    file = parse_units(Source(path, text))
    file.diagnostics.raise_errors()
    declared = parse_declarations(Source("a.var", declarations))
    declared.diagnostics.raise_errors()
    files = [declared, declarations_of(file)]
    scope = Scope("program", files, [standard(dialect)], dialect=dialect)
    program = check_program("program", [file], scope, hidden=hidden)
    found = [
        f"{record.line}:{record.column} {record.code} {record.message}"
        + (f" | {record.hint}" if record.hint else "")
        for record in sorted(file.diagnostics.records, key=lambda r: (r.line, r.column))
    ]
    return program, scope, found


def struct_of(scope):
    """The variables of a scope as one STRUCT."""
    return StructType(
        scope.name,
        [
            Member(variable.name, variable.data_type, variable.initial)
            for variable in scope.variables
            if not variable.is_constant and variable.block.section not in NOT_STORED
        ],
    )


class Running:
    """A program on a machine.

    Args:
        text: Structured Text.
        declarations: what a .typ, .var or .fun file beside it declares.
        semantics: of the dialect.
        dialect: of names.
        path: of the file; its suffix tells the language.
        imports: Python functions by the name that the program knows; they get the object itself
            first.
    """

    def __init__(
        self,
        text,
        declarations="",
        semantics=AUTOMATION_STUDIO,
        dialect=dialects.AUTOMATION_STUDIO,
        path="a.st",
        **imports,
    ):
        program, _, found = checked(text, declarations, dialect, path=path)
        errors = [each for each in found if " ST5" not in each]
        assert not errors, errors
        self.imports = imports
        self.memory = Memory(SIZE)
        self.structs = {each: struct_of(each) for each in program.scopes}
        segments = {each: ir.Segment(f"program {n}") for n, each in enumerate(program.scopes)}
        areas = {
            each: {
                member.name: Spot(segments[each], offset)
                for member, offset in zip(s.members, s.offsets, strict=True)
            }
            for each, s in self.structs.items()
        }
        self.module = lower(program, areas, semantics)
        self.machine = Machine(self.memory, cache=CodeCache(None))
        self.addresses = {}
        for each, s in self.structs.items():
            address = self.memory.allocate(max(s.size, 1))
            self.memory.write(address, encode(s, None))
            self.addresses[segments[each].name] = address
        if any(segment.name == DIRECT for segment in self.module.segments):
            self.addresses[DIRECT] = self.memory.allocate(located.SIZE)
        hidden = next(s for s in self.module.segments if s.name == "hidden")
        self.addresses["hidden"] = self.memory.allocate(max(hidden.size, 1))
        self.memory.write(self.addresses["hidden"], hidden.data)
        self.segments = segments
        linker = Linker(self.machine)
        code = generate(self.module)
        self.instance = linker.link(code, linker.compiled(code, self.addresses), self._provide)

    def _provide(self, wanted):
        codes = {"i32": "i", "i64": "q", "f32": "f", "f64": "d", None: ""}
        function = self.imports[wanted.name]
        return self.machine.host_function(
            lambda *arguments: function(self, *arguments),
            "".join(codes[each] for each in wanted.signature.parameters),
            codes[wanted.signature.result],
        )

    def run(self, cycles=1, unit="cyclic"):
        function = self.instance.function(unit)
        for _ in range(cycles):
            function()
        return self

    def call(self, name, *arguments):
        return self.instance.function(name)(*arguments)

    def _place(self, path):
        for scope, struct_type in self.structs.items():
            try:
                data_type, offset = find(struct_type, path)
            except KeyError:
                continue
            return data_type, self.addresses[self.segments[scope].name] + offset
        raise KeyError(path)

    def __getitem__(self, path):
        data_type, address = self._place(path)
        return decode(data_type, self.memory.read(address, data_type.size))

    def __setitem__(self, path, value):
        data_type, address = self._place(path)
        self.memory.write(address, encode(data_type, value))

    def address(self, path):
        return self._place(path)[1]

    def string(self, address):
        data = self.memory.read(address, 256)
        return data.split(b"\0")[0].decode("latin-1")

    def write(self, address, data):
        self.memory.write(address, data)

    def close(self):
        self.machine.close()


def values(text, *names, declarations="", **options):
    """The values of variables after one cycle of statements with VAR blocks before them."""
    running = Running(f"PROGRAM _CYCLIC\n{text}\nEND_PROGRAM", declarations, **options)
    running.run()
    found = [running[name] for name in names]
    running.close()
    return found[0] if len(found) == 1 else found
