"""Syntax tree of Structured Text: statements, program organisation units, files.

Expressions, declarations and types are those of `st_types.syntax`. ``at`` of a node is the number
of a token; `StructuredTextFile.location` turns it into file, line and column. Nodes compare equal
without regard to their place.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from st_types.syntax.expressions import Node
from st_types.syntax.tree import (
    FunctionBlockDeclaration,
    FunctionDeclaration,
    TypeBlock,
    VariableBlock,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from st_types.syntax.diagnostics import DiagnosticLog
    from st_types.syntax.expressions import Argument, Expression, Name
    from st_types.syntax.lexer import Tokens
    from st_types.syntax.source import Location


@dataclass(slots=True)
class Assignment(Node):
    """``target := value;``; ``value`` is an assignment itself in ``a := b := 0``.

    ``operator`` is ``:=``, ``ACCESS`` (B&R: sets the reference) or ``REF=`` (CODESYS: likewise),
    ``S=`` or ``R=`` (CODESYS: sets or resets a BOOL where the value is TRUE).
    """

    target: Expression
    value: Expression | Assignment
    operator: str = ":="


@dataclass(slots=True)
class ExpressionStatement(Node):
    """``expression;``: a call, or the bare name of an action or a function block."""

    expression: Expression


@dataclass(slots=True)
class Arm(Node):
    """A condition of an IF and what follows from it."""

    condition: Expression
    body: Sequence[Statement]


@dataclass(slots=True)
class IfStatement(Node):
    """``IF ... THEN ... ELSIF ... ELSE ... END_IF``; ``other`` is None without ELSE."""

    arms: Sequence[Arm]
    other: Sequence[Statement] | None


@dataclass(slots=True)
class CaseElement(Node):
    """``label, low..high: statements`` in a CASE; ``high`` None where the label is no range."""

    labels: Sequence[tuple[Expression, Expression | None]]
    body: Sequence[Statement]


@dataclass(slots=True)
class CaseStatement(Node):
    """``CASE selector OF ... ELSE ... END_CASE``; ``other`` is None without ELSE."""

    selector: Expression
    elements: Sequence[CaseElement]
    other: Sequence[Statement] | None


@dataclass(slots=True)
class ForStatement(Node):
    """``FOR variable := first TO last BY step DO ... END_FOR``."""

    variable: Expression
    first: Expression
    last: Expression
    step: Expression | None
    body: Sequence[Statement]


@dataclass(slots=True)
class WhileStatement(Node):
    """``WHILE condition DO ... END_WHILE``."""

    condition: Expression
    body: Sequence[Statement]


@dataclass(slots=True)
class RepeatStatement(Node):
    """``REPEAT ... UNTIL condition END_REPEAT``."""

    body: Sequence[Statement]
    condition: Expression


@dataclass(slots=True)
class ExitStatement(Node):
    """``EXIT``: leaves the innermost loop."""


@dataclass(slots=True)
class ContinueStatement(Node):
    """``CONTINUE``: starts the next pass of the innermost loop."""


@dataclass(slots=True)
class ReturnStatement(Node):
    """``RETURN``: leaves the unit, the action, the function or the block."""


@dataclass(slots=True)
class JumpStatement(Node):
    """``JMP label``, of CODESYS."""

    label: str


@dataclass(slots=True)
class LabelStatement(Node):
    """``label:``, the target of a jump."""

    label: str


@dataclass(slots=True)
class TemporaryStatement(Node):
    """Keeps a value for the rest of the call, under a name that no text can have.

    Languages are read into it whose connections have no names, such as the rungs of a ladder. The
    type of ``name`` is that of the value; a `Name` reads it in later statements.
    """

    name: str
    value: Expression


@dataclass(slots=True)
class BlockCall(Node):
    """``instance FUB TYPE(a, b)`` or ``TYPE(a, b)`` of Automation Basic.

    Arguments are the inputs and then the outputs of the function block in their order, or none.
    Without an instance each call in the text has one of its own; ``block`` may be a function then,
    or an action.
    """

    block: Name
    arguments: Sequence[Argument]
    instance: Expression | None = None


Statement = (
    Assignment
    | BlockCall
    | ExpressionStatement
    | IfStatement
    | CaseStatement
    | ForStatement
    | WhileStatement
    | RepeatStatement
    | ExitStatement
    | ContinueStatement
    | ReturnStatement
    | JumpStatement
    | LabelStatement
    | TemporaryStatement
)


@dataclass(slots=True)
class ActionUnit(Node):
    """``ACTION name: ... END_ACTION``; ``at`` is the name."""

    name: str
    body: Sequence[Statement]


@dataclass(slots=True)
class MethodUnit(Node):
    """A METHOD, or one accessor of a PROPERTY; ``words`` are PUBLIC, ABSTRACT, GET, ..."""

    declaration: FunctionDeclaration
    body: Sequence[Statement]
    words: tuple[str, ...] = ()


@dataclass(slots=True)
class ActionAssociation(Node):
    """``action(qualifier, time);`` in a STEP; ``at`` is the name of the action.

    ``qualifier`` is in capitals; ``time`` is None for those without.
    """

    action: str
    qualifier: str
    time: Expression | None = None


@dataclass(slots=True)
class StepUnit(Node):
    """``STEP name: ... END_STEP``; ``at`` is the name.

    ``body`` runs while the step is active, ``entry`` and ``exit`` (Automation Studio's ENTRY_ACTION
    and EXIT_ACTION behind END_STEP) once when it becomes active and inactive.
    """

    name: str
    is_initial: bool
    associations: Sequence[ActionAssociation]
    body: Sequence[Statement]
    entry: Sequence[Statement] = ()
    exit: Sequence[Statement] = ()


@dataclass(slots=True)
class TransitionUnit(Node):
    """``TRANSITION FROM (a, b) TO (c, d) := condition; END_TRANSITION``.

    ``sources`` and ``targets`` are names of steps. ``priority`` is the number that it is given
    among those from one step, the lowest first; None where its place in the text decides.
    """

    sources: Sequence[Name]
    targets: Sequence[Name]
    condition: Expression
    priority: int | None = None


@dataclass(slots=True)
class InterfaceUnit(Node):
    """``INTERFACE name ... END_INTERFACE``; ``bases`` are what it EXTENDS."""

    name: str
    bases: Sequence[str]
    parts: Sequence[Part]


@dataclass(slots=True)
class NamespaceUnit(Node):
    """``NAMESPACE name``; what it holds are units of the file, before this one."""

    name: str


@dataclass(slots=True)
class ProgramUnit(Node):
    """``PROGRAM name ... END_PROGRAM``; ``at`` is the name.

    Automation Studio calls them _INIT, _CYCLIC and _EXIT, in standard files the name is free.
    """

    name: str
    blocks: Sequence[VariableBlock]
    body: Sequence[Statement]
    parts: Sequence[Part] = ()


@dataclass(slots=True)
class FunctionUnit(Node):
    """``FUNCTION name ... END_FUNCTION`` with its body; the declaration may be in a .fun file."""

    declaration: FunctionDeclaration
    body: Sequence[Statement]


@dataclass(slots=True)
class FunctionBlockUnit(Node):
    """``FUNCTION_BLOCK name ... END_FUNCTION_BLOCK``, or a CLASS.

    ``words`` are FINAL, ABSTRACT, CLASS and the like; ``bases`` what it EXTENDS and IMPLEMENTS.
    """

    declaration: FunctionBlockDeclaration
    body: Sequence[Statement]
    parts: Sequence[Part] = ()
    words: tuple[str, ...] = ()
    bases: Sequence[str] = ()


Part = ActionUnit | MethodUnit | StepUnit | TransitionUnit
"""What stands inside a unit besides declarations and statements."""


@dataclass(slots=True)
class TaskConfiguration(Node):
    """``TASK name (INTERVAL := ..., PRIORITY := ...);``."""

    name: str
    arguments: Sequence[Argument]


@dataclass(slots=True)
class ProgramConfiguration(Node):
    """``PROGRAM name WITH task : type (...);``; ``task`` is empty without WITH."""

    name: str
    task: str
    type_name: str
    arguments: Sequence[Argument]


@dataclass(slots=True)
class Configuration(Node):
    """``CONFIGURATION name ... END_CONFIGURATION``, or a RESOURCE in it: ``processor`` its ON."""

    name: str
    blocks: Sequence[VariableBlock]
    tasks: Sequence[TaskConfiguration]
    programs: Sequence[ProgramConfiguration]
    resources: Sequence[Configuration] = ()
    processor: str = ""


@dataclass(slots=True)
class Include(Node):
    """``#include "path"`` between units."""

    path: str


Unit = (
    TypeBlock
    | VariableBlock
    | ProgramUnit
    | FunctionUnit
    | FunctionBlockUnit
    | ActionUnit
    | MethodUnit
    | Configuration
    | InterfaceUnit
    | NamespaceUnit
    | Include
)


@dataclass(slots=True)
class StructuredTextFile:
    """A parsed file.

    Attributes:
        units: in order; those of namespaces and packages of actions among the others.
        tokens: where the nodes' ``at`` lead.
        diagnostics: findings of the parser; later steps add theirs.
        hidden: variables of the program that its language needs and nobody wrote, such as the
            state of a chart.
        texts_are_addresses: ``strcpy(to, "text")`` gives the address of the text, as it does in
            Automation Basic.
    """

    units: Sequence[Unit]
    tokens: Tokens = field(compare=False, repr=False)
    diagnostics: DiagnosticLog = field(compare=False, repr=False)
    hidden: Sequence[VariableBlock] = ()
    texts_are_addresses: bool = False

    @property
    def path(self) -> str:
        """The file, as the user named it."""
        return self.tokens.source.path

    def location(self, node: Node) -> Location:
        """Return the place of ``node``."""
        return self.tokens.location(node.at)
