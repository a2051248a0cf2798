"""Finds in a program class what could only fail later: units that never run, misspelt names.

A name is looked up as Python will do it, in the class: the variables, the methods and ``__slots__``
of a program are all there before its first cycle.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from plcsim.core.suggestion import did_you_mean
from plcsim.core.task import Unit
from plcsim.program.python.program import Program

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path
    from types import FunctionType

    from st_types import Struct

_NOT_RUN_BY_A_CALL: tuple[Callable[[object], bool], ...] = (
    inspect.iscoroutinefunction,
    inspect.isgeneratorfunction,
    inspect.isasyncgenfunction,
)

_OTHER_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)


def check_program(program: type[Program], folder: Path) -> None:
    """Check the units and the names of a program.

    Args:
        program: its class.
        folder: where it lies, for what has no line.

    Raises:
        ConfigurationError: a unit would never run or fails at its call, or a method uses a name of
            ``self`` that is not there; file and line are named.
    """
    for unit in Unit:
        _check_unit(program, unit.value.lower(), folder)
    check_names(program, Program)


def check_names(view: type[Struct], base: type[Struct]) -> None:
    """Check the names of ``self`` that the methods of a class use.

    Args:
        view: a program or a function block.
        base: whose own methods are right, as those of its bases.

    Raises:
        ConfigurationError: one is not there; file and line are named.
    """
    if not hasattr(view, "__getattr__") and not view.__dictoffset__:
        for function in _methods(view, base):
            _check_names(view, function)


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


def _methods(view: type[Struct], base: type[Struct]) -> Iterator[FunctionType]:
    """Iterate over the methods that a class and its bases below ``base`` define."""
    for each in view.__mro__[: view.__mro__.index(base)]:
        for value in vars(each).values():
            if inspect.isfunction(value) and inspect.isfunction(method := inspect.unwrap(value)):
                yield method


def _check_names(view: type[Struct], function: FunctionType) -> None:
    try:
        lines, first = inspect.getsourcelines(function)
        (tree,) = ast.parse(textwrap.dedent("".join(lines))).body
    except (OSError, SyntaxError, ValueError):  # made by other means than a file
        return
    if not isinstance(tree, ast.FunctionDef) or not tree.args.args:
        return
    for node in _attributes_of(tree, tree.args.args[0].arg):
        if not node.attr.startswith("__") and not hasattr(view, node.attr):
            hint = did_you_mean(node.attr, dir(view))
            location = f"{function.__code__.co_filename}:{first + node.lineno - 1}"
            raise ConfigurationError(f"{location}: {view.__name__} has no {node.attr}{hint}")


def _attributes_of(tree: ast.AST, name: str) -> Iterator[ast.Attribute]:
    """Iterate over ``name.something`` in a function, not in functions inside it."""
    for node in ast.iter_child_nodes(tree):
        if isinstance(node, _OTHER_SCOPES):
            continue
        if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            if node.value.id == name:
                yield node
        else:
            yield from _attributes_of(node, name)
