"""The same statements as a program of plcsim and as a bare Python loop over any object."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

from plcsim import Program
from st_types import BOOL, INT, REAL, UDINT, var

if TYPE_CHECKING:
    from collections.abc import Callable

_GROUP = (
    "self.count_{n} += 1",
    "self.level_{n} = self.level_{n} + self.rate_{n}",
    "self.full_{n} = self.level_{n} > 100.0",
    "if self.full_{n}: self.level_{n} = 0.0",
    "self.step_{n} = (self.step_{n} + 3) & 0x7F",
)
"""Five statements on five variables: a counter, a ramp, a comparison, a reset, a step."""

_VARIABLES = {
    "count": (UDINT, 0),
    "level": (REAL, 0.0),
    "rate": (REAL, 0.25),
    "full": (BOOL, False),
    "step": (INT, 0),
}


def variables_of(statements: int) -> dict[str, object]:
    """Return the variables of so many statements with their initial values."""
    return {f"{v}_{n}": x for n in _groups(statements) for v, (_, x) in _VARIABLES.items()}


def program_of(statements: int) -> type[Program]:
    """Return a program whose CYCLIC has so many statements, a multiple of five."""
    declared = {
        f"{v}_{n}": var(kind, x) for n in _groups(statements) for v, (kind, x) in _VARIABLES.items()
    }
    cyclic = _compiled(["def cyclic(self):", *_lines(statements, 1)], "cyclic")
    made: type[Program] = type(
        f"Statements{statements}", (Program,), {**declared, "cyclic": cyclic}
    )
    return made


def bare_loop(statements: int, variables: object) -> Callable[[int], None]:
    """Return a function that runs the statements on ``variables`` so many times."""
    head = ["def loop(self, turns):", " for _ in range(turns):"]
    return partial(_compiled([*head, *_lines(statements, 2)], "loop"), variables)


def _groups(statements: int) -> range:
    return range(statements // len(_GROUP))


def _lines(statements: int, indent: int) -> list[str]:
    lines = [line.format(n=n) for n in _groups(statements) for line in _GROUP]
    return [" " * indent + line for line in lines or ["pass"]]


def _compiled(lines: list[str], name: str) -> Any:
    names: dict[str, Any] = {}
    exec(compile("\n".join(lines), f"<{name}>", "exec"), names)
    return names[name]
