"""Actions that the steps of a chart name with a qualifier (IEC 61131-3, 6.7.4).

The block ACTION_CONTROL of the norm, with the final scan: an action runs while its Q is TRUE and
once more when it has become FALSE; P0 and P1 run it once. A name that is no action of the unit is a
BOOL, which gets Q.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

from plcsim.program.structured_text.languages.nodes import NodeMaker

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from plcsim.program.structured_text.syntax.tree import ActionAssociation, Statement, StepUnit
    from st_types.syntax.expressions import Expression
    from st_types.syntax.tree import TypeSpecification

_STORED: Final = frozenset(["S", "SD", "DS", "SL"])
_STORED_WITH_TIME: Final = frozenset(["SD", "SL"])


class _Use(NamedTuple):
    """An association with its number, and its step with its number."""

    number: int
    association: ActionAssociation
    step: StepUnit
    step_number: int


class StepActions:
    """The actions that the steps of a chart name.

    Args:
        state: name of the variable that holds the state of the chart.
        steps: of the chart.
        actions: names of the actions of the unit.
    """

    def __init__(self, state: str, steps: Sequence[StepUnit], actions: Collection[str]) -> None:
        self._state = state
        self._known = actions
        self._uses: dict[str, list[_Use]] = {}
        number = 0
        for step_number, step in enumerate(steps):
            for each in step.associations:
                use = _Use(number, each, step, step_number)
                self._uses.setdefault(each.action, []).append(use)
                number += 1
        self._count = number

    def members(self, make: NodeMaker) -> dict[str, TypeSpecification]:
        """Return the members that the state of the chart has for them."""
        if not self._count:
            return {}
        return {
            "Stored": make.array(self._count, "BOOL"),
            "Time": make.array(self._count, "TIME"),
            "Reset": make.array(len(self._uses), "BOOL"),
            "Q": make.array(len(self._uses), "BOOL"),
            "WasQ": make.array(len(self._uses), "BOOL"),
        }

    def statements(self) -> Iterator[Statement]:
        """Yield what stores and times them, and then runs them, in the order of the text."""
        for number, uses in enumerate(self._uses.values()):
            make = _at(uses[0])
            resets = [_flag(use) for use in uses if use.association.qualifier == "R"]
            reset = self._of("Reset", number, make)
            if resets:
                yield make.assignment(reset, make.joined("OR", resets))
            for use in uses:
                if use.association.qualifier in _STORED:
                    yield from self._stored(use, reset)
        for number, (name, uses) in enumerate(self._uses.items()):
            yield from self._run(number, name, uses)

    def _stored(self, use: _Use, reset: Expression) -> Iterator[Statement]:
        """Yield what stores an action until it is reset, and counts the time since then."""
        make = _at(use)
        stored, time = self._of("Stored", use.number, make), self._of("Time", use.number, make)
        elapsed = make.member(self._state, "Elapsed")
        if use.association.qualifier in _STORED_WITH_TIME:
            goes_on = make.binary("AND", stored, self._is_before(time, use, make))
            later = make.binary("+", time, elapsed)
            yield make.condition(goes_on, [make.assignment(time, later)])
        begins = _flag(use)
        if use.association.qualifier == "DS":
            begins = make.binary("AND", begins, self._is_over(_time(use), use, make))
        begin = [
            make.assignment(stored, make.literal("TRUE")),
            make.assignment(time, make.literal("T#0s")),
        ]
        yield make.condition(make.binary("AND", begins, make.negated(stored)), begin)
        yield make.condition(reset, [make.assignment(stored, make.literal("FALSE"))])

    def _run(self, number: int, name: str, uses: Sequence[_Use]) -> Iterator[Statement]:
        make = _at(uses[0])
        q, was = self._of("Q", number, make), self._of("WasQ", number, make)
        false = make.literal("FALSE")
        lasting = [each for use in uses for each in self._lasting(use)]
        yield make.assignment(q, make.joined("OR", lasting) if lasting else false)
        pulses = [each for use in uses for each in self._pulse(use)]
        if name in self._known:
            runs = make.joined("OR", [q, was, *pulses])
            yield make.condition(runs, [make.statement(make.name(name))])
        else:
            yield make.assignment(make.name(name), make.joined("OR", [q, *pulses]))
        yield make.assignment(was, q)

    def _lasting(self, use: _Use) -> Iterator[Expression]:
        """Yield what an association adds to Q."""
        make, word = _at(use), use.association.qualifier
        stored, time = self._of("Stored", use.number, make), self._of("Time", use.number, make)
        if word == "N":
            yield _flag(use)
        elif word == "P":
            yield self._began(use)
        elif word == "L":
            yield make.binary("AND", _flag(use), self._is_before(_time(use), use, make))
        elif word == "D":
            yield make.binary("AND", _flag(use), self._is_over(_time(use), use, make))
        elif word in ("S", "DS"):
            yield stored
        elif word == "SD":
            yield make.binary("AND", stored, self._is_over(time, use, make))
        elif word == "SL":
            yield make.binary("AND", stored, self._is_before(time, use, make))

    def _pulse(self, use: _Use) -> Iterator[Expression]:
        """Yield what runs an action once, without a final scan."""
        if use.association.qualifier == "P1":
            yield self._began(use)
        elif use.association.qualifier == "P0":
            make = _at(use)
            yield make.binary("AND", self._was(use), make.negated(_flag(use)))

    def _began(self, use: _Use) -> Expression:
        make = _at(use)
        return make.binary("AND", _flag(use), make.negated(self._was(use)))

    def _was(self, use: _Use) -> Expression:
        return self._of("Was", use.step_number, _at(use))

    def _of(self, array: str, number: int, make: NodeMaker) -> Expression:
        return make.element(make.member(self._state, array), number)

    @staticmethod
    def _is_before(time: Expression, use: _Use, make: NodeMaker) -> Expression:
        limit = use.association.time
        return make.literal("TRUE") if limit is None else make.binary("<", time, limit)

    @staticmethod
    def _is_over(time: Expression, use: _Use, make: NodeMaker) -> Expression:
        limit = use.association.time
        return make.literal("TRUE") if limit is None else make.binary(">=", time, limit)


def _at(use: _Use) -> NodeMaker:
    return NodeMaker(use.association.at)


def _flag(use: _Use) -> Expression:
    return _at(use).member(use.step.name, "X")


def _time(use: _Use) -> Expression:
    return _at(use).member(use.step.name, "T")
