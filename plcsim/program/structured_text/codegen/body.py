"""The code of one function while it is being written."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.ansi_c.c_library import STACK_SIZE
from plcsim.core.memory import SYSTEM_AREA
from plcsim.machine.encoder import sleb, uleb
from plcsim.machine.opcodes import (
    EMPTY,
    END,
    GLOBAL_GET,
    GLOBAL_SET,
    I32_ADD,
    I32_CONST,
    I32_LT_U,
    I32_SUB,
    IF,
    LOCAL_GET,
    LOCAL_TEE,
    RETURN,
    UNREACHABLE,
)
from plcsim.program.structured_text import ir
from plcsim.program.structured_text.codegen.copies import Copies, join
from plcsim.program.structured_text.codegen.operators import VALUE_TYPES
from plcsim.program.structured_text.codegen.places import ScalarPlace, key_of

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from plcsim.program.structured_text.codegen.accesses import Accesses, Effects
    from plcsim.program.structured_text.codegen.copies import Known
    from plcsim.program.structured_text.codegen.options import CodegenOptions

HOLE: Final = b"\x80\x80\x80\x80\x00"
"""Place of an address in the code, as long as any below 2**31: see `object_code`."""

NO_OFFSET: Final = b"\0\0"
"""Memory argument of an access whose address is complete."""

STACK_POINTER: Final = 0
"""Number of the global variable that is the stack pointer, in modules with frames."""

LOWEST: Final = SYSTEM_AREA - STACK_SIZE
"""Lowest address of the stack."""

_OF_BLOCKS: Final = ("block", "action", "method")
"""Kinds of functions whose only parameter, if there is one, is the address of a data block."""

_IF: Final = IF + EMPTY
_TRAP: Final = _IF + UNREACHABLE + END


class GenerationContext(NamedTuple):
    """What the functions of a module share while they are being compiled.

    Attributes:
        indices: of all functions that may be called, by name.
        segments: numbers of the segments, by identity.
        effects: what calls may change.
    """

    indices: Mapping[str, int]
    segments: Mapping[int, int]
    effects: Effects


class FunctionWriter:
    """The code of one function while it is being written.

    Attributes:
        function: what is compiled.
        indices: see `GenerationContext`.
        segments: see `GenerationContext`.
        effects: see `GenerationContext`.
        options: what is compiled in.
        statements: writes statements inside an expression.
        code: the instructions so far.
        holes: three numbers for each hole in ``code`` that takes an address: its position, the
            segment, the bytes to add to the segment's address.
        line: that the next instruction belongs to.
        lines: (position in ``code``, line), ascending, where the line changes.
        traps: (position in ``code``, reason) of instructions that are there to end the program.
        conditions: line of each IF and BR_IF that stands for a condition of the source, and the
            line of the statement that is all that follows from it, 0 where there is more; by
            position.
        cases: line of the selector, by the position at which a case of a Switch begins.
        polls: end of each poll of the budget, by its position.
        finals: identities of the statements after which the function ends.
        leaves: positions of RETURNs that stand for no statement of the source.
        copies: variables that locals hold here.
        accesses: of the loops around this point, by their identity.
        depth: blocks of WebAssembly around this point.
        breaks: where Break leads to, by label.
        continues: where Continue leads to, by label.
        this: local 0 is the address of the data block.
    """

    __slots__ = (
        "_locals",
        "_parameters",
        "_scratch",
        "accesses",
        "breaks",
        "cases",
        "code",
        "conditions",
        "continues",
        "copies",
        "depth",
        "effects",
        "finals",
        "function",
        "holes",
        "indices",
        "leaves",
        "line",
        "lines",
        "options",
        "polls",
        "segments",
        "statements",
        "this",
        "traps",
    )

    def __init__(
        self,
        function: ir.Function,
        module: GenerationContext,
        options: CodegenOptions,
        statements: Callable[[FunctionWriter, Sequence[ir.Statement]], None],
    ) -> None:
        self.function = function
        self.indices = module.indices
        self.segments = module.segments
        self.effects = module.effects
        self.options = options
        self.statements = statements
        self.code = bytearray()
        self.holes: list[int] = []
        self.lines = [(0, function.line)]
        self.traps: list[tuple[int, str]] = []
        self.conditions: dict[int, tuple[int, int]] = {}
        self.cases: dict[int, int] = {}
        self.polls: dict[int, int] = {}
        self.finals = _finals(function) if function.result is None else frozenset()
        self.leaves: set[int] = set()
        self.accesses: dict[int, Accesses] = {}
        self.depth = 0
        self.breaks: dict[int, BranchLabel] = {}
        self.continues: dict[int, BranchLabel] = {}
        self.this = function.kind in _OF_BLOCKS and bool(function.parameters)
        self.copies = Copies(self._local_for_copy, this=self.this)
        self.line = function.line
        self._parameters = len(function.parameters)
        self._locals = bytearray(VALUE_TYPES[kind] for kind in function.locals)
        self._scratch: dict[tuple[int, int], int] = {}

    @property
    def locals(self) -> bytes:
        """Value types of the locals after the parameters."""
        return bytes(self._locals)

    @property
    def reached(self) -> bool:
        """Whether some path of the program leads here."""
        return self.copies.known is not None

    def local(self, kind: int) -> int:
        """Return a new local of a value type."""
        self._locals.append(kind)
        return self._parameters + len(self._locals) - 1

    def scratch(self, kind: int, slot: int = 0) -> int:
        """Return a local of a value type whose value is used before other code is written."""
        found = self._scratch.get((kind, slot))
        if found is None:
            found = self._scratch[kind, slot] = self.local(kind)
        return found

    def _local_for_copy(self, width: ir.Width) -> int:
        return self.local(VALUE_TYPES[ir.VALUE_TYPE[width]])

    def key_of(self, place: ir.Place, width: ir.Width) -> ScalarPlace | None:
        """Return the key of an access of which a copy may be kept."""
        return key_of(place, width, this=self.this) if self.options.copies else None

    def mark(self, line: int) -> None:
        """Say what line the next instruction belongs to."""
        if line != self.line:
            self.line = line
            self.lines.append((len(self.code), line))

    def condition(self, leaves: int = 0) -> None:
        """Say that the IF or BR_IF that follows decides what the source says; see `conditions`."""
        self.conditions[len(self.code)] = self.line, leaves

    def trap_if(self, reason: str) -> None:
        """End the program where the value on the stack is not 0.

        The fault is at the IF where wasmtime makes one instruction of it and what is inside, and
        inside where it does not.
        """
        start = len(self.code)
        self.code += _TRAP
        self.traps += (start, reason), (start + len(_IF), reason)

    def hole(self, segment: ir.Segment, offset: int) -> None:
        """Append an address; it is the same five bytes after i32.const and as an offset."""
        self.holes += len(self.code), self.segments[id(segment)], offset
        self.code += HOLE

    def open(self, opcode: bytes, kind: bytes = EMPTY) -> int:
        """Begin a block, a loop or an if; return its depth, for `branch`."""
        self.code += opcode + kind
        self.depth += 1
        return self.depth

    def close(self) -> None:
        """End the innermost block."""
        self.code += END
        self.depth -= 1

    def take_frame(self) -> None:
        """Append the instructions by which a call gets its frame on the stack."""
        size, local = self.function.frame
        pointer, bytes_needed = uleb(STACK_POINTER), I32_CONST + sleb(size)
        self.code += GLOBAL_GET + pointer + I32_CONST + sleb(LOWEST + size) + I32_LT_U
        self.trap_if("stack")
        self.code += GLOBAL_GET + pointer + bytes_needed + I32_SUB
        self.code += LOCAL_TEE + uleb(local) + GLOBAL_SET + pointer

    def return_(self) -> None:
        """Append RETURN; a value that the function gives lies on the stack."""
        self.give_frame_back()
        self.code += RETURN

    def give_frame_back(self) -> None:
        """Append the instructions by which a call gives its frame back, if it has one."""
        size, local = self.function.frame
        if size:
            self.code += LOCAL_GET + uleb(local) + I32_CONST + sleb(size) + I32_ADD
            self.code += GLOBAL_SET + uleb(STACK_POINTER)

    def branch(self, opcode: bytes, depth: int) -> None:
        """Append br or br_if to a block that `open` began."""
        self.code += opcode + uleb(self.depth - depth)


def _finals(function: ir.Function) -> frozenset[int]:
    """Return the identities of the statements of choice after which a function ends."""
    found = set[int]()
    left_over = [function.body]
    while left_over:
        sequence = left_over.pop()
        last = sequence[-1] if sequence else None
        if isinstance(last, ir.If):
            left_over += [last.other, *(arm.body for arm in last.arms)]
        elif isinstance(last, ir.Switch):
            left_over += [last.other, *(case.body for case in last.cases)]
        else:
            continue
        found.add(id(last))
    return frozenset(found)


class BranchLabel:
    """Where branches meet.

    Attributes:
        depth: of the block, as `FunctionWriter.open` returns it.
        known: what is known on all paths that lead there, None where there is none.
    """

    __slots__ = ("depth", "known")

    def __init__(self, depth: int) -> None:
        self.depth = depth
        self.known: Known | None = None

    def arrive(self, known: Known | None) -> None:
        """Say what is known on one more path that leads here."""
        self.known = join(self.known, known)
