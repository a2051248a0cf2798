"""Typed trees: what the checker makes of a syntax tree, and what `lower` compiles.

Names are resolved, references are followed, every value has a plain type (no alias, no subrange).
Conversions are not in it yet: how they are made, the dialect decides when it is lowered. Nodes that
are no statements may be shared.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Sequence

    from plcsim.program.structured_text.check.kinds import Type
    from st_types.resolve.declared import DeclaredFunction
    from st_types.resolve.scope import Scope
    from st_types.types.derived import ArrayType, DataBlockType

Storage = Literal["program", "global", "instance", "frame", "hidden", "direct"]
"""Where a variable lies: among those of the program or of the controller, in the data block of a
function block, in a call (of a function, or as VAR_TEMP), among those that only the code knows, at
a direct address."""


@dataclass(slots=True, eq=False)
class Symbol:
    """A variable.

    Attributes:
        name: as declared.
        type: plain; of a VAR_IN_OUT and of a parameter that is handed over by its address, the type
            of what lies there.
        storage: see `Storage`.
        scope: what declares it; None for a hidden one.
        by_address: an address lies there, not the value.
        is_constant: of a VAR CONSTANT.
        initial: value at the start of its unit or call, None for that of its type.
        has_address: its address is taken, and may be known to others.
        used: something names it.
        is_input: of a VAR_INPUT.
        written: a body assigns it, or takes its address.
    """

    name: str
    type: Type
    storage: Storage
    scope: Scope | None = None
    by_address: bool = False
    is_constant: bool = False
    initial: object = None
    has_address: bool = False
    used: bool = False
    is_input: bool = False
    written: bool = False


# Values. All have ``type``.


@dataclass(slots=True, eq=False)
class Constant:
    """A value that is known; of type `ANY_INT` or `ANY_REAL` where it takes any type."""

    type: Type
    value: int | float | str


@dataclass(slots=True, eq=False)
class Variable:
    """A variable, or what lies at the address in it."""

    type: Type
    symbol: Symbol


@dataclass(slots=True, eq=False)
class Member:
    """A member of a STRUCT or a data block, ``offset`` bytes from its start."""

    type: Type
    base: Value
    offset: int


@dataclass(slots=True, eq=False)
class Element:
    """An element of an array."""

    type: Type
    base: Value
    array: ArrayType[object]
    indices: Sequence[Value]


@dataclass(slots=True, eq=False)
class Target:
    """What lies at an address; ``pointer`` is the place or the value that holds it."""

    type: Type
    pointer: Value


@dataclass(slots=True, eq=False)
class Bit:
    """One bit of an integer; of type BOOL."""

    type: Type
    base: Value
    number: int


@dataclass(slots=True, eq=False)
class Address:
    """``ADR(place)``."""

    type: Type
    place: Value


@dataclass(slots=True, eq=False)
class Unary:
    """``-`` or ``NOT``."""

    type: Type
    operator: str
    operand: Value


@dataclass(slots=True, eq=False)
class Binary:
    """Arithmetic and AND, OR, XOR; both operands go into ``type``, the AND_THEN forms too."""

    type: Type
    operator: str
    left: Value
    right: Value


@dataclass(slots=True, eq=False)
class Compare:
    """A comparison of two values that both go into ``operands``; of type BOOL."""

    type: Type
    operator: str
    operands: Type
    left: Value
    right: Value


@dataclass(slots=True, eq=False)
class Convert:
    """A conversion function such as INT_TO_REAL, TRUNC; ``name`` in capitals."""

    type: Type
    name: str
    operand: Value


@dataclass(slots=True, eq=False)
class Builtin:
    """A built-in function; ``name`` in capitals. The operands that share a type have ``type``."""

    type: Type
    name: str
    arguments: Sequence[Value]


@dataclass(slots=True, eq=False)
class Edge:
    """EDGEPOS, EDGENEG or EDGE of ``operand``, with the memory of this place in the text."""

    type: Type
    name: str
    operand: Value
    memory: Value


@dataclass(slots=True, eq=False)
class Call:
    """A call of a function; ``arguments`` in the order of its parameters.

    None where the caller gives nothing: the parameter has its initial value then. ``outputs`` are
    assigned after the call.
    """

    type: Type
    function: DeclaredFunction
    arguments: Sequence[Value | None]


@dataclass(slots=True, eq=False)
class This:
    """The address of the data block that the body works on."""

    type: Type


@dataclass(slots=True, eq=False)
class MethodCall:
    """A call of a method of ``instance``; ``label`` names its body, the rest as in `Call`."""

    type: Type
    function: DeclaredFunction
    arguments: Sequence[Value | None]
    instance: Value
    label: str


@dataclass(slots=True, eq=False)
class Implementation:
    """What a variable of an interface holds: address and number of a function block, or nothing."""

    type: Type
    place: Value | None
    number: int


@dataclass(slots=True, eq=False)
class Dispatch:
    """A call of a method by an interface: of the function block whose number it holds."""

    type: Type
    number: Value
    calls: Sequence[tuple[int, MethodCall]]


Value = (
    Constant
    | Variable
    | Member
    | Element
    | Target
    | Bit
    | Address
    | Unary
    | Binary
    | Compare
    | Convert
    | Builtin
    | Edge
    | Call
    | This
    | MethodCall
    | Implementation
    | Dispatch
)

PLACES = (Variable, Member, Element, Target, Bit)
"""What can be assigned."""


# Statements. ``line`` counts from 1.


@dataclass(slots=True, eq=False)
class Assign:
    """``target := value``; the value converts to the type of the target."""

    line: int
    target: Value
    value: Value


@dataclass(slots=True, eq=False)
class Chain:
    """``a := b := c``: from the innermost on; the others take what the one before has stored."""

    line: int
    links: Sequence[Assign | SetAddress]


@dataclass(slots=True, eq=False)
class SetAddress:
    """``reference ACCESS address``: ``reference`` is the place that holds the address."""

    line: int
    reference: Value
    address: Value


@dataclass(slots=True, eq=False)
class Evaluate:
    """A function is called, its result is dropped."""

    line: int
    value: Value


@dataclass(slots=True, eq=False)
class CallBlock:
    """A call of a function block: ``before`` assigns its inputs, ``after`` takes its outputs."""

    line: int
    instance: Value
    block: str
    before: Sequence[Statement]
    after: Sequence[Statement]


@dataclass(slots=True, eq=False)
class CallAction:
    """A call of an action of the same program or block."""

    line: int
    name: str


@dataclass(slots=True, eq=False)
class Arm:
    """A condition and what follows from it."""

    line: int
    condition: Value
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class If:
    """The body of the first arm that holds, else ``other``."""

    line: int
    arms: Sequence[Arm]
    other: Sequence[Statement]


@dataclass(slots=True, eq=False)
class CaseElement:
    """Values as (lowest, highest), and what follows from them."""

    line: int
    ranges: Sequence[tuple[int, int]]
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class Case:
    """The body of the element that holds ``selector``, else ``other``."""

    line: int
    selector: Value
    elements: Sequence[CaseElement]
    other: Sequence[Statement]


@dataclass(slots=True, eq=False)
class For:
    """FOR; ``step`` is None for 1."""

    line: int
    variable: Value
    first: Value
    last: Value
    step: Value | None
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class While:
    """WHILE."""

    line: int
    condition: Value
    body: Sequence[Statement]


@dataclass(slots=True, eq=False)
class Repeat:
    """REPEAT; ``condition`` stands in line ``until``."""

    line: int
    body: Sequence[Statement]
    until: int
    condition: Value


@dataclass(slots=True, eq=False)
class Exit:
    """EXIT."""

    line: int


@dataclass(slots=True, eq=False)
class Continue:
    """CONTINUE."""

    line: int


@dataclass(slots=True, eq=False)
class Return:
    """RETURN."""

    line: int


@dataclass(slots=True, eq=False)
class Jump:
    """``JMP label``: to a `Label` of this list of statements or of one around it."""

    line: int
    label: str


@dataclass(slots=True, eq=False)
class Label:
    """``label:``."""

    line: int
    label: str


Statement = (
    Assign
    | Chain
    | SetAddress
    | Evaluate
    | CallBlock
    | CallAction
    | If
    | Case
    | For
    | While
    | Repeat
    | Exit
    | Continue
    | Return
    | Jump
    | Label
)

BodyKind = Literal["unit", "action", "block", "function", "method"]


@dataclass(slots=True, eq=False)
class CheckedBody:
    """A checked body.

    Attributes:
        name: of the unit (INIT, CYCLIC, EXIT), action, function block or function.
        kind: what it is.
        path: its file.
        line: where it begins.
        statements: what it does.
        block: data block of the function block that it is, or that an action or a method has.
        parameters: of a function, in order.
        locals: variables that live for one call: those of a function, VAR_TEMP.
        result: of a function, None for none; among the locals too.
        is_recursive: it may call itself, by whatever others.
    """

    name: str
    kind: BodyKind
    path: str
    line: int
    statements: Sequence[Statement]
    block: DataBlockType[object] | None = None
    parameters: Sequence[Symbol] = ()
    locals: Sequence[Symbol] = ()
    result: Symbol | None = None
    is_recursive: bool = False


@dataclass(slots=True, eq=False)
class CheckedProgram:
    """A checked program, or the Structured Text of a library.

    Attributes:
        name: of the program or library.
        bodies: units, actions, functions and function blocks.
        scopes: those whose variables lie with the program: its own, and of each PROGRAM with VAR
            blocks beside its body.
    """

    name: str
    bodies: Sequence[CheckedBody]
    scopes: Sequence[Scope]
