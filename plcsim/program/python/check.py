"""Finds in a program class what could only fail later: units that never run, methods gone wrong."""

from __future__ import annotations

import inspect
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.suggestion import did_you_mean
from plcsim.core.task import Unit
from plcsim.program.python.method_check import check_methods, own_methods
from plcsim.program.python.program import Program

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

_NOT_RUN_BY_A_CALL: tuple[Callable[[object], bool], ...] = (
    inspect.iscoroutinefunction,
    inspect.isgeneratorfunction,
    inspect.isasyncgenfunction,
)

_UNITS = tuple(unit.value.lower() for unit in Unit)


def check_program(program: type[Program], folder: Path) -> None:
    """Check the units and the methods of a program.

    Args:
        program: its class.
        folder: where it lies, for what has no line.

    Raises:
        ConfigurationError: a unit would never run or fails at its call, methods stand there and no
            unit, or a method is wrong (`plcsim.program.python.method_check`); all findings are
            told, with file and line.
    """
    findings = Findings()
    for unit in _UNITS:
        with findings.gathered():
            _check_unit(program, unit, folder)
    if not findings:
        with findings.gathered():
            _check_any(program, folder)
    with findings.gathered():
        check_methods(program, Program)
    findings.check()


def _check_any(program: type[Program], folder: Path) -> None:
    """Refuse a program that has methods and would run none of them; it may have variables only."""
    methods = list(own_methods(program, Program))
    if not methods or any(getattr(program, unit) is not getattr(Program, unit) for unit in _UNITS):
        return
    near = {method: did_you_mean(method.__name__, _UNITS) for method in methods}
    method = next((m for m, hint in near.items() if hint), methods[0])
    raise ConfigurationError(
        f"{_location_of(method, folder)}: {method.__name__} is no unit, and {program.__name__} has "
        f"none of {', '.join(_UNITS)}{near[method]}"
    )


def _check_unit(program: type[Program], name: str, folder: Path) -> None:
    function = getattr(program, name)
    if function is getattr(Program, name):
        _check_misspelt(program, name, folder)
    if any(is_one(function) for is_one in _NOT_RUN_BY_A_CALL):
        raise ConfigurationError(
            f"{_location_of(function, folder)}: {name} neither awaits nor yields: a call of it is "
            "one whole run"
        )
    try:
        inspect.signature(function).bind(program)
    except TypeError:
        raise ConfigurationError(
            f"{_location_of(function, folder)}: {name} takes self and nothing else"
        ) from None


def _check_misspelt(program: type[Program], name: str, folder: Path) -> None:
    """Refuse a unit in other letters, such as ``Cyclic``: it would not run."""
    for other, function in inspect.getmembers(program, inspect.isfunction):
        if other != name and other.lower() == name:
            raise ConfigurationError(
                f"{_location_of(function, folder)}: the unit {other} is spelt {name}"
            )


def _location_of(function: object, folder: Path) -> str:
    code = getattr(inspect.unwrap(function), "__code__", None) if callable(function) else None
    return f"{code.co_filename}:{code.co_firstlineno}" if code else str(folder)
