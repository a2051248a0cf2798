"""Sequential function charts as statements: what a cycle of a chart does.

IEC 61131-3, 6.7, has the rules. The initial steps become active in the first cycle. In every other
cycle all transitions are evaluated on the steps that the cycle before left active; of those from
one step the first whose condition is TRUE fires, by PRIORITY and then by its place in the text,
which in Automation Studio is left to right. Then they fire together: a step that a transition
leaves and another one enters stays active. Then run the exit actions of the steps that became
inactive, the entry actions of those that became active, the bodies of the active ones in the order
of the text, and the actions that steps name with a qualifier, each with its final scan.

A step is a variable of its name with the members X (active) and T (the time since it became
active); what else the chart keeps is one more variable, whose name begins with zzSfc.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Final

from plcsim.program.structured_text.codes import FindingCode
from plcsim.program.structured_text.languages.nodes import NodeMaker
from plcsim.program.structured_text.languages.step_actions import StepActions
from plcsim.program.structured_text.program_uses import UNITS
from plcsim.program.structured_text.syntax.tree import (
    ActionUnit,
    FunctionBlockUnit,
    MethodUnit,
    ProgramUnit,
    StepUnit,
    TransitionUnit,
)
from st_types.syntax.collector import collector_paused
from st_types.syntax.tree import VariableBlock

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from plcsim.program.structured_text.syntax.tree import (
        Part,
        Statement,
        StructuredTextFile,
        Unit,
    )
    from st_types.syntax.expressions import Expression, Name
    from st_types.syntax.tree import Declaration

STATE: Final = "zzSfc"
"""How the name of the variable begins that holds the state of a chart."""

CLOCK: Final = "clock_ms"
"""Function of the library AsTime: the time of the cycle."""


def with_charts(file: StructuredTextFile) -> StructuredTextFile:
    """Return a file in which steps and transitions have become statements.

    Findings go to its ``diagnostics``.
    """
    hidden = [*file.hidden]
    with collector_paused():
        units = [_without_chart(unit, file, hidden) for unit in file.units]
    return replace(file, units=units, hidden=hidden)


def _without_chart(unit: Unit, file: StructuredTextFile, hidden: list[VariableBlock]) -> Unit:
    if not isinstance(unit, ProgramUnit | FunctionBlockUnit):
        return unit
    steps = [part for part in unit.parts if isinstance(part, StepUnit)]
    transitions = [part for part in unit.parts if isinstance(part, TransitionUnit)]
    if not steps and not transitions:
        return unit
    kept = [part for part in unit.parts if isinstance(part, ActionUnit | MethodUnit)]
    name = unit.name if isinstance(unit, ProgramUnit) else ""
    _check(file, unit, steps, transitions)
    chart = Chart(f"{STATE}{name}", unit.at, steps, transitions, kept)
    body = [*unit.body, *chart.body()]
    parts: list[Part] = [*kept, *chart.actions()]
    block = VariableBlock(unit.at, "VAR", (), [*chart.variables()])
    if isinstance(unit, FunctionBlockUnit):
        declaration = replace(unit.declaration, blocks=[*unit.declaration.blocks, block])
        return replace(unit, declaration=declaration, body=body, parts=parts)
    if unit.blocks or name.upper() not in UNITS:
        return replace(unit, blocks=[*unit.blocks, block], body=body, parts=parts)
    hidden.append(block)  # a VAR block would make it a file of the norm
    return replace(unit, body=body, parts=parts)


def _check(
    file: StructuredTextFile,
    unit: ProgramUnit | FunctionBlockUnit,
    steps: Sequence[StepUnit],
    transitions: Sequence[TransitionUnit],
) -> None:
    """Tell what makes no chart of the steps and transitions of a unit."""

    def tell(at: int, message: str, hint: str = "") -> None:
        file.diagnostics.error(file.tokens.offset(at), message, hint, FindingCode.SYNTAX)

    known = dict[str, StepUnit]()
    for step in steps:
        if known.setdefault(step.name, step) is not step:
            tell(step.at, f"the step {step.name} is there twice")
    if not any(step.is_initial for step in steps):
        tell(unit.at, "the chart has no INITIAL_STEP")
    for transition in transitions:
        for step_name in (*transition.sources, *transition.targets):
            if step_name.name not in known:
                tell(step_name.at, f"there is no step {step_name.name}")


class Chart:
    """The steps and transitions of a unit.

    Args:
        state: name of the variable that holds what is no step.
        at: the token that names the unit.
        steps: in the order of the text.
        transitions: likewise.
        actions: of the unit; another name in an association is a variable.
    """

    def __init__(
        self,
        state: str,
        at: int,
        steps: Sequence[StepUnit],
        transitions: Sequence[TransitionUnit],
        actions: Sequence[ActionUnit | MethodUnit],
    ) -> None:
        self._state = state
        self._make = NodeMaker(at)
        self._steps = steps
        self._numbers = {step.name: number for number, step in reversed([*enumerate(steps)])}
        by_priority = sorted(transitions, key=lambda each: (each.priority is None, each.priority))
        known = [
            each
            for each in by_priority
            if each.sources
            and all(name.name in self._numbers for name in (*each.sources, *each.targets))
        ]
        self._transitions = known
        named = {each.name for each in actions if isinstance(each, ActionUnit)}
        self._actions = StepActions(state, steps, named)

    # What is declared.

    def variables(self) -> Iterator[Declaration]:
        """Yield the variables of the chart: its steps, and what else it keeps."""
        for step in self._steps:
            make = NodeMaker(step.at)
            yield make.declaration(step.name, make.struct(X=make.type("BOOL"), T=make.type("TIME")))
        make = self._make
        members = {
            "Started": make.type("BOOL"),
            "Now": make.type("TIME"),
            "Elapsed": make.type("TIME"),
            "Was": make.array(len(self._steps) or 1, "BOOL"),
            "Left": make.array(len(self._steps) or 1, "BOOL"),
            "Fires": make.array(len(self._transitions) or 1, "BOOL"),
            **self._actions.members(make),
        }
        yield make.declaration(self._state, make.struct(**members))

    def actions(self) -> Iterator[ActionUnit]:
        """Yield the statements of steps as actions: a RETURN leaves one of them, not the chart."""
        for step in self._steps:
            for title, body in _bodies(step):
                if body:
                    yield ActionUnit(step.at, title, body)

    # What a cycle does.

    def body(self) -> Iterator[Statement]:
        """Yield the statements of a cycle."""
        make, state = self._make, self._state
        now, elapsed = make.member(state, "Now"), make.member(state, "Elapsed")
        clock = make.call(CLOCK)
        yield make.assignment(elapsed, make.binary("-", clock, now))
        yield make.assignment(now, clock)
        started = make.member(state, "Started")
        begin = [make.assignment(started, make.literal("TRUE")), *self._initial()]
        yield make.condition(make.negated(started), begin, [*self._evolution()])
        yield from self._exits()
        yield from self._entries()
        yield from self._mains()
        yield from self._actions.statements()
        for number, step in enumerate(self._steps):
            yield NodeMaker(step.at).assignment(self._was(number), _flag(step))

    def _initial(self) -> Iterator[Statement]:
        for step in self._steps:
            if step.is_initial:
                make = NodeMaker(step.at)
                yield make.assignment(_flag(step), make.literal("TRUE"))

    def _evolution(self) -> Iterator[Statement]:
        """Yield what evaluates the transitions, and fires them together."""
        for number, step in enumerate(self._steps):
            make = NodeMaker(step.at)
            yield make.assignment(self._left(number, make), make.literal("FALSE"))
            time = make.member(step.name, "T")
            later = make.binary("+", time, make.member(self._state, "Elapsed"))
            yield make.condition(_flag(step), [make.assignment(time, later)])
        for number, each in enumerate(self._transitions):
            yield from self._evaluated(number, each)
        for number, each in enumerate(self._transitions):
            yield self._set(number, each, each.sources, "FALSE")
        for number, each in enumerate(self._transitions):
            yield self._set(number, each, each.targets, "TRUE")

    def _evaluated(self, number: int, transition: TransitionUnit) -> Iterator[Statement]:
        """Yield what evaluates a transition, if no earlier one leaves a step that it leaves."""
        make = NodeMaker(transition.at)
        names = [step.name for step in transition.sources]
        left = [self._left(self._numbers[name], make) for name in names]
        active = [make.member(name, "X") for name in names]
        free = [make.negated(each) for each in left]
        fires = self._fires(number, make)
        leave = [make.assignment(each, make.literal("TRUE")) for each in left]
        evaluate = [make.assignment(fires, transition.condition), make.condition(fires, leave)]
        yield make.assignment(fires, make.literal("FALSE"))
        yield make.condition(make.joined("AND", [*active, *free]), evaluate)

    def _set(
        self, number: int, transition: TransitionUnit, steps: Sequence[Name], value: str
    ) -> Statement:
        make = NodeMaker(transition.at)
        body = [make.assignment(make.member(step.name, "X"), make.literal(value)) for step in steps]
        return make.condition(self._fires(number, make), body)

    def _exits(self) -> Iterator[Statement]:
        for number, step in enumerate(self._steps):
            if step.exit:
                make = NodeMaker(step.at)
                left = make.binary("AND", self._was(number), make.negated(_flag(step)))
                yield make.condition(left, [_call(step, "exit")])

    def _entries(self) -> Iterator[Statement]:
        for number, step in enumerate(self._steps):
            make = NodeMaker(step.at)
            entered = make.binary("AND", _flag(step), make.negated(self._was(number)))
            begin = [make.assignment(make.member(step.name, "T"), make.literal("T#0s"))]
            if step.entry:
                begin.append(_call(step, "entry"))
            yield make.condition(entered, begin)

    def _mains(self) -> Iterator[Statement]:
        for step in self._steps:
            if step.body:
                yield NodeMaker(step.at).condition(_flag(step), [_call(step, "step")])

    def _was(self, number: int) -> Expression:
        """Return whether a step was active when the cycle before ended."""
        make = NodeMaker(self._steps[number].at)
        return make.element(make.member(self._state, "Was"), number)

    def _left(self, number: int, make: NodeMaker) -> Expression:
        """Return whether a transition leaves a step in this cycle."""
        return make.element(make.member(self._state, "Left"), number)

    def _fires(self, number: int, make: NodeMaker) -> Expression:
        return make.element(make.member(self._state, "Fires"), number)


def _bodies(step: StepUnit) -> Iterator[tuple[str, Sequence[Statement]]]:
    yield _title(step, "step"), step.body
    yield _title(step, "entry"), step.entry
    yield _title(step, "exit"), step.exit


def _title(step: StepUnit, part: str) -> str:
    """Return the name of the statements of a step, which no action in a text can have."""
    return f"{part} {step.name}"


def _call(step: StepUnit, part: str) -> Statement:
    make = NodeMaker(step.at)
    return make.statement(make.name(_title(step, part)))


def _flag(step: StepUnit) -> Expression:
    return NodeMaker(step.at).member(step.name, "X")
