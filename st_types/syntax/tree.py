"""Syntax tree of .typ, .var and .fun files.

Nodes compare equal without regard to their place, their comments and their blanks. ``at`` of a node
is the number of a token; `DeclarationFile.location` turns it into file, line and column.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from st_types.syntax.expressions import Argument, Expression, Node

if TYPE_CHECKING:
    from collections.abc import Sequence

    from st_types.syntax.diagnostics import DiagnosticLog
    from st_types.syntax.lexer import Tokens
    from st_types.syntax.source import Location


@dataclass(slots=True)
class NamedType(Node):
    """A type by its name, elementary or not, STRING without a length included.

    ``given`` is what FB_init of the instances gets: ``Block(a := 1)`` has it once, for all, and
    ``ARRAY[0..1] OF Block[(a := 1), (a := 2)]`` for each element.
    """

    name: str
    given: Sequence[Sequence[Argument]] = ()


@dataclass(slots=True)
class StringSpecification(Node):
    """``STRING[length]`` or ``WSTRING[length]``; ``name`` is in capitals."""

    name: str
    length: Expression


@dataclass(slots=True)
class ArraySpecification(Node):
    """``ARRAY[low..high, ...] OF element``."""

    bounds: Sequence[tuple[Expression, Expression]]
    element: TypeSpecification


@dataclass(slots=True)
class OpenArraySpecification(Node):
    """``ARRAY[*, ...] OF element``: a parameter that takes arrays of any bounds."""

    dimensions: int
    element: TypeSpecification


@dataclass(slots=True)
class ReferenceSpecification(Node):
    """``REFERENCE TO target``; ``keyword`` is REFERENCE or, from others, POINTER or REF_TO."""

    target: TypeSpecification
    keyword: str = "REFERENCE"


@dataclass(slots=True)
class SubrangeSpecification(Node):
    """``base(low..high)``."""

    base: str
    low: Expression
    high: Expression


@dataclass(slots=True)
class EnumerationValue(Node):
    """One name of an enumeration, with its value if it is written.

    ``before`` and ``behind`` are the text around: comments and blanks.
    """

    name: str
    value: Expression | None = None
    before: str = field(default="", compare=False)
    behind: str = field(default="", compare=False)


@dataclass(slots=True)
class EnumerationSpecification(Node):
    """``(name, name := value, ...)``, ``base`` being the type written beside it, mostly none."""

    values: Sequence[EnumerationValue]
    base: str = ""


@dataclass(slots=True)
class StructSpecification(Node):
    """``STRUCT ... END_STRUCT``; ``behind`` is text after STRUCT, ``closing`` before the end.

    ``keyword`` is STRUCT or UNION; ``base`` is what the STRUCT EXTENDS, mostly nothing.
    """

    members: Sequence[Declaration]
    keyword: str = "STRUCT"
    base: str = ""
    behind: str = field(default="", compare=False)
    closing: str = field(default="", compare=False)


TypeSpecification = (
    NamedType
    | StringSpecification
    | ArraySpecification
    | OpenArraySpecification
    | ReferenceSpecification
    | SubrangeSpecification
    | EnumerationSpecification
    | StructSpecification
)


@dataclass(slots=True)
class ArrayInitial(Node):
    """``[item, item, ...]``."""

    items: Sequence[Initial]


@dataclass(slots=True)
class RepeatedInitial(Node):
    """``count(item, ...)`` inside an `ArrayInitial`."""

    count: Expression
    items: Sequence[Initial]


@dataclass(slots=True)
class StructInitial(Node):
    """``(name := value, ...)`` of a STRUCT or a function block; ``at`` of a member is its name."""

    members: Sequence[MemberInitial]


@dataclass(slots=True)
class MemberInitial(Node):
    """``name := value``."""

    name: str
    value: Initial


Initial = Expression | ArrayInitial | RepeatedInitial | StructInitial


@dataclass(slots=True)
class Declaration(Node):
    """A type, a variable, a member of a STRUCT: ``name : specification := initial;``.

    ``address`` is what follows AT. ``pragmas`` are those beside the name and the type, ``edge`` is
    R_EDGE or F_EDGE. ``before`` and ``behind`` are the text around: comments and blanks.
    """

    name: str
    specification: TypeSpecification
    initial: Initial | None = None
    address: str = ""
    pragmas: tuple[str, ...] = ()
    edge: str = ""
    before: str = field(default="", compare=False)
    behind: str = field(default="", compare=False)


@dataclass(slots=True)
class TypeBlock(Node):
    """``TYPE ... END_TYPE``."""

    declarations: Sequence[Declaration]
    before: str = field(default="", compare=False)
    closing: str = field(default="", compare=False)


@dataclass(slots=True)
class VariableBlock(Node):
    """``VAR ... END_VAR``.

    Attributes:
        section: VAR, VAR_INPUT, VAR_OUTPUT, VAR_IN_OUT, ... in capitals.
        qualifiers: CONSTANT, RETAIN, ... in capitals.
    """

    section: str
    qualifiers: tuple[str, ...]
    declarations: Sequence[Declaration]
    pragmas: tuple[str, ...] = ()
    before: str = field(default="", compare=False)
    closing: str = field(default="", compare=False)


@dataclass(slots=True)
class FunctionBlockDeclaration(Node):
    """``FUNCTION_BLOCK name ... END_FUNCTION_BLOCK``; ``behind`` is the text after the name.

    ``base`` is the function block that it EXTENDS, mostly none.
    """

    name: str
    blocks: Sequence[VariableBlock]
    pragmas: tuple[str, ...] = ()
    before: str = field(default="", compare=False)
    behind: str = field(default="", compare=False)
    closing: str = field(default="", compare=False)
    base: str = ""


@dataclass(slots=True)
class FunctionDeclaration(Node):
    """``FUNCTION name : result ... END_FUNCTION``; ``behind`` is the text after the result."""

    name: str
    result: TypeSpecification | None
    blocks: Sequence[VariableBlock]
    pragmas: tuple[str, ...] = ()
    before: str = field(default="", compare=False)
    behind: str = field(default="", compare=False)
    closing: str = field(default="", compare=False)


Item = TypeBlock | VariableBlock | FunctionBlockDeclaration | FunctionDeclaration


@dataclass(slots=True, repr=False)
class DeclarationFile:
    """A parsed file.

    Attributes:
        items: its blocks, functions and function blocks.
        closing: text behind the last of them.
        tokens: where the nodes' ``at`` lead.
        diagnostics: findings of the parser; later steps add theirs.
    """

    items: Sequence[Item]
    closing: str = field(compare=False)
    tokens: Tokens = field(compare=False, repr=False)
    diagnostics: DiagnosticLog = field(compare=False, repr=False)

    def __repr__(self) -> str:
        return f"<{self.path}>"

    @property
    def path(self) -> str:
        """The file, as the user named it."""
        return self.tokens.source.path

    def location(self, node: Node) -> Location:
        """Return the place of ``node``."""
        return self.tokens.location(node.at)

    def error(self, node: Node | int, message: str, hint: str = "") -> None:
        """Record an error at a node or a token."""
        at = node if isinstance(node, int) else node.at
        self.diagnostics.error(self.tokens.offset(at), message, hint)

    def warning(self, node: Node | int, message: str, hint: str = "") -> None:
        """Record a warning at a node or a token."""
        at = node if isinstance(node, int) else node.at
        self.diagnostics.warning(self.tokens.offset(at), message, hint)
