"""Intermediate representation of compiled Structured Text: what `lower` makes and `codegen` takes.

Everything that the language, its dialect or the vendor decides is explicit here: conversions, the
width of each load and store, the guard of MOD, how a FOR ends. The back end knows values of
WebAssembly and places in the PLC memory, and nothing of types, names, strings or enumerations.

**Values.** BOOL and all integers up to 32 bits are ``i32`` on the stack: a signed type sign
extended, an unsigned one and BOOL zero extended, as their loads leave them. A store takes the low
bits. Shift counts are taken modulo the width, integer division by zero and ``INT_MIN / -1`` trap,
all as in WebAssembly.

**Places and their roots.** ``Place.root`` says which accesses may meet the same bytes. Root 0 is
memory whose address is known elsewhere (ADR, VAR_IN_OUT, references, globals): any access with
root 0 may meet any other with root 0, and any call may read and write it. Any other root is one
variable of the module, or of the function block whose body is running: it overlaps nothing with
another root, and no address of it is kept beyond the call or the copy it is handed to. So:

- an `AddressOf` with root n as an argument lets the callee touch root n during that call;
- a call of another function of this module touches the roots which that function, and what it
  calls, name; a call through an import touches root 0 and the roots of its arguments;
- `CopyBytes` and `FillBytes` touch the root of an `AddressOf` they are given, else root 0;
- helpers of `RUNTIME` touch the roots of their arguments only (root 0 for a computed address).

**Nesting.** Labels are unique in a function. `Break` leaves the `Block` or `Loop` of that label,
`Continue` starts the next pass of a `Loop`; a `Loop` without one of them goes on for ever.

Nodes have slots and no behaviour. They are never changed once made, and may be shared.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, ClassVar, Final, Literal, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

ValueType = Literal["i32", "i64", "f32", "f64"]
"""Type of a value on the stack."""

Width = Literal["s8", "u8", "s16", "u16", "w32", "w64", "f32", "f64"]
"""How a value lies in memory, little-endian; ``s`` and ``u`` say how a load extends to i32."""

VALUE_TYPE: Final[Mapping[Width, ValueType]] = {
    **dict.fromkeys(("s8", "u8", "s16", "u16", "w32"), "i32"),
    "w64": "i64",
    "f32": "f32",
    "f64": "f64",
}
"""What a load of each width gives."""

BYTES: Final[Mapping[Width, int]] = dict(zip(VALUE_TYPE, (1, 1, 2, 2, 4, 8, 4, 8), strict=True))
"""Bytes of each width. 8-byte values are aligned to 4 bytes only."""


@dataclass(slots=True, eq=False)
class Segment:
    """Bytes of the PLC memory with one start; their address is known when code is generated.

    Attributes:
        name: ``program`` for the variables of the task, ``global`` for those of the controller,
            others as their owner calls them; unique in the module.
        size: bytes; 0 where the owner decides it.
        alignment: bytes.
        data: initial bytes, written at each restart by whoever allocates the segment; None where
            the variables of the segment have initial values of their own.
    """

    name: str
    size: int = 0
    alignment: int = 4
    data: bytes | None = None


@dataclass(slots=True, eq=False)
class Place:
    """A place in memory: ``base + offset``.

    Attributes:
        base: a segment or an i32 expression.
        offset: bytes from there, not negative, below 2**31.
        root: 0, or the number of the only variable whose bytes are met here (see the module).
    """

    base: Segment | Expression
    offset: int
    root: int = 0


# Expressions. ``type`` is the type of the value.


@dataclass(slots=True, eq=False)
class Const:
    """A constant; an integer may be given signed or unsigned."""

    type: ValueType
    value: int | float


@dataclass(slots=True, eq=False)
class Load:
    """The value at a place."""

    type: ValueType
    width: Width
    place: Place


@dataclass(slots=True, eq=False)
class Local:
    """Parameter or local number ``index`` of the function, the parameters first."""

    type: ValueType
    index: int


@dataclass(slots=True, eq=False)
class AddressOf:
    """The address of a place."""

    place: Place
    type: ClassVar[ValueType] = "i32"


# fmt: off
UnaryOperator = Literal[
    # integers
    "clz", "ctz", "popcnt",
    # REAL, LREAL
    "neg", "abs", "sqrt", "floor", "ceil", "trunc", "nearest",
]
# fmt: on


@dataclass(slots=True, eq=False)
class Unary:
    """WebAssembly's ``type.operator``; operand and result are of ``type``."""

    type: ValueType
    operator: UnaryOperator
    operand: Expression


# fmt: off
BinaryOperator = Literal[
    # integers
    "add", "sub", "mul", "div_s", "div_u", "rem_s", "rem_u", "and", "or", "xor", "shl", "shr_s",
    "shr_u", "rotl", "rotr",
    # REAL, LREAL: add, sub, mul and
    "div", "min", "max", "copysign",
]
# fmt: on


@dataclass(slots=True, eq=False)
class Binary:
    """WebAssembly's ``type.operator``; both operands and the result are of ``type``."""

    type: ValueType
    operator: BinaryOperator
    left: Expression
    right: Expression


# fmt: off
CompareOperator = Literal[
    "eq", "ne",
    # integers
    "lt_s", "lt_u", "gt_s", "gt_u", "le_s", "le_u", "ge_s", "ge_u",
    # REAL, LREAL
    "lt", "gt", "le", "ge",
]
# fmt: on


@dataclass(slots=True, eq=False)
class Compare:
    """``operands.operator`` of WebAssembly: 1 or 0; ``operands`` is the type of both operands."""

    operands: ValueType
    operator: CompareOperator
    left: Expression
    right: Expression
    type: ClassVar[ValueType] = "i32"


# fmt: off
ConvertOperator = Literal[
    "extend8_s", "extend16_s",  # i32 -> i32
    "wrap_i64",  # i64 -> i32
    "extend_i32_s", "extend_i32_u",  # i32 -> i64
    # integer -> f32, f64
    "convert_i32_s", "convert_i32_u", "convert_i64_s", "convert_i64_u",
    "promote_f32", "demote_f64",
    "reinterpret_f32", "reinterpret_f64", "reinterpret_i32", "reinterpret_i64",
    # f32, f64 -> i32, i64: towards zero; NaN and what does not fit give the smallest integer, the
    # "integer indefinite" of Intel.
    "trunc_f32_s", "trunc_f64_s",
]
# fmt: on


@dataclass(slots=True, eq=False)
class Convert:
    """WebAssembly's ``type.operator``, but see ``trunc_...``; ``type`` is that of the result."""

    type: ValueType
    operator: ConvertOperator
    operand: Expression


@dataclass(slots=True, eq=False)
class Select:
    """``then`` where ``condition`` is not 0, else ``other``; all three are evaluated, in order.

    The order is ``then``, ``other``, ``condition``, as in WebAssembly.
    """

    type: ValueType
    condition: Expression
    then: Expression
    other: Expression


@dataclass(slots=True, eq=False)
class IfExpression:
    """``then`` where ``condition`` is not 0, else ``other``; only that one is evaluated."""

    type: ValueType
    condition: Expression
    then: Expression
    other: Expression


@dataclass(slots=True, eq=False)
class Call:
    """A call of a function of the module, of an import or of a helper of `RUNTIME`.

    ``type`` is None where it gives no value: then it stands in an `Evaluate` only. Arguments are
    evaluated in order.
    """

    type: ValueType | None
    function: str
    arguments: Sequence[Expression]


@dataclass(slots=True, eq=False)
class Checked:
    """``index`` where it is below ``count`` as an unsigned number, else a trap: array bounds."""

    index: Expression
    count: int
    type: ClassVar[ValueType] = "i32"


@dataclass(slots=True, eq=False)
class StatementExpression:
    """``value`` after ``statements``, which leave no block around them."""

    type: ValueType
    statements: Sequence[Statement]
    value: Expression


Expression = (
    Const
    | Load
    | Local
    | AddressOf
    | Unary
    | Binary
    | Compare
    | Convert
    | Select
    | IfExpression
    | Call
    | Checked
    | StatementExpression
)


# Statements. ``line`` is the line of the function's file that they belong to, from 1.


@dataclass(slots=True, eq=False)
class Store:
    """Store ``value`` at ``place``; the address is evaluated before the value."""

    line: int
    width: Width
    place: Place
    value: Expression


@dataclass(slots=True, eq=False)
class SetLocal:
    """Set a parameter or local of the function."""

    line: int
    index: int
    value: Expression


@dataclass(slots=True, eq=False)
class Evaluate:
    """Evaluate an expression and drop its value, if it has one."""

    line: int
    value: Expression


@dataclass(slots=True, eq=False)
class Arm:
    """One condition of an `If` and what follows from it."""

    line: int
    condition: Expression
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class If:
    """The body of the first arm whose condition is not 0, else ``other``."""

    line: int
    arms: Sequence[Arm]
    other: Sequence[Statement] = ()


@dataclass(slots=True, eq=False)
class Case:
    """Values of a `Switch`, each as (lowest, highest), signed, and what follows from them."""

    line: int
    ranges: Sequence[tuple[int, int]]
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class Switch:
    """The body of the case that holds the i32 ``selector`` (signed), else ``other``.

    Ranges do not overlap.
    """

    line: int
    selector: Expression
    cases: Sequence[Case]
    other: Sequence[Statement] = ()


@dataclass(slots=True, eq=False)
class Block:
    """A body that `Break` can leave."""

    line: int
    label: int
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class Loop:
    """A body that is repeated until something leaves it."""

    line: int
    label: int
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class Break:
    """Leave the `Block` or `Loop` with that label."""

    line: int
    label: int


@dataclass(slots=True, eq=False)
class Continue:
    """Start the next pass of the `Loop` with that label."""

    line: int
    label: int


@dataclass(slots=True, eq=False)
class Return:
    """Leave the function."""

    line: int
    value: Expression | None = None


@dataclass(slots=True, eq=False)
class CopyBytes:
    """Copy ``count`` bytes between two addresses; they may overlap, as memmove allows.

    Evaluated in the order target, source, count.
    """

    line: int
    target: Expression
    source: Expression
    count: Expression


@dataclass(slots=True, eq=False)
class FillBytes:
    """Set ``count`` bytes from an address on to the low byte of ``value``; order as written."""

    line: int
    target: Expression
    value: Expression
    count: Expression


Statement = (
    Store
    | SetLocal
    | Evaluate
    | If
    | Switch
    | Block
    | Loop
    | Break
    | Continue
    | Return
    | CopyBytes
    | FillBytes
)

FunctionKind = Literal["unit", "action", "block", "function", "method", "helper"]
"""``unit`` (INIT, CYCLIC, EXIT) takes nothing. ``block`` takes the address of its data block; its
own members are places based on local 0. ``action`` takes nothing, that of a block the same address.
``method`` takes it first, then what a ``function`` takes.
``helper`` is what the front makes."""


class StackFrame(NamedTuple):
    """Bytes of the stack of compiled programs that each call of a function has of its own.

    Attributes:
        size: bytes, a multiple of 16; 0 for none.
        local: holds their address while the function runs.
    """

    size: int
    local: int


NO_FRAME: Final = StackFrame(0, 0)


@dataclass(slots=True, eq=False)
class Function:
    """A function of the module.

    Attributes:
        name: unique in the module.
        kind: see `FunctionKind`.
        parameters: types, locals 0 and up.
        result: None for none.
        locals: types of further locals, 0 at the start.
        body: falls through to the end where ``result`` is None.
        file: number of its file in ``Module.files``.
        line: where it begins.
        exported: it can be called from outside.
        frame: what each call has on the stack; what is in it at the start is not known.
    """

    name: str
    kind: FunctionKind
    parameters: Sequence[ValueType]
    result: ValueType | None
    locals: Sequence[ValueType]
    body: Sequence[Statement]
    file: int = 0
    line: int = 1
    exported: bool = False
    frame: StackFrame = NO_FRAME


@dataclass(slots=True, eq=False)
class Signature:
    """Types of a function."""

    parameters: Sequence[ValueType]
    result: ValueType | None


@dataclass(slots=True, eq=False)
class Import:
    """A function that somebody else has.

    ``space`` is ``block`` for a function block (one parameter, the address of its data block; no
    result) and ``function`` for a FUNCTION; ``name`` as its library declares it. Strings and
    structures go as addresses; a STRING, STRUCT or ARRAY result is written to the address in the
    first parameter.
    """

    space: Literal["block", "function"]
    name: str
    signature: Signature


@dataclass(slots=True, eq=False)
class Module:
    """The code of one program or of one library.

    Attributes:
        name: of the program or library.
        functions: in any order.
        imports: by the name that `Call` uses; no function has the same.
        segments: all that places are based on.
        files: paths of the sources, for lines.
    """

    name: str
    functions: Sequence[Function]
    imports: Mapping[str, Import] = field(default_factory=dict)
    segments: Sequence[Segment] = ()
    files: Sequence[str] = ()


_ADDRESS: Final[ValueType] = "i32"

RUNTIME: Final[Mapping[str, Signature]] = {
    # Copy characters from source to target until a terminator or ``limit`` characters, then
    # terminate: (target, source, limit). The parts may overlap; copied from the front, one by one.
    "rt.string_assign": Signature((_ADDRESS, _ADDRESS, "i32"), None),
    "rt.wstring_assign": Signature((_ADDRESS, _ADDRESS, "i32"), None),
    # Below 0, 0, above 0, as strcmp on unsigned characters.
    "rt.string_compare": Signature((_ADDRESS, _ADDRESS), "i32"),
    "rt.wstring_compare": Signature((_ADDRESS, _ADDRESS), "i32"),
    # Mathematics, as the C library has it.
    **{
        f"rt.{name}": Signature(("f64",), "f64")
        for name in ("sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "log10")
    },
    "rt.atan2": Signature(("f64", "f64"), "f64"),
    "rt.pow": Signature(("f64", "f64"), "f64"),
    "rt.fmod": Signature(("f64", "f64"), "f64"),
}
"""Helpers that the back end brings along; `Call` names them as they stand here."""
