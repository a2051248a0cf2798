"""Finds in the methods of programs and blocks what Python would only notice when it gets there.

A name is looked up as Python will do it, in the class: the variables, the methods and ``__slots__``
are all there before the first cycle. What is stored in a variable is looked at as far as the source
tells what it is (`plcsim.program.python.value_check`).
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from typing import TYPE_CHECKING, Any

from plcsim.core.errors import ConfigurationError, Findings
from plcsim.core.function_block import FunctionBlock
from plcsim.core.suggestion import did_you_mean
from plcsim.program.python.shared import ConstantAttribute
from plcsim.program.python.value_check import ValueCheck
from st_types.types.derived import DataBlockType, Section, StructType
from st_types.types.views import view_class

if TYPE_CHECKING:
    from collections.abc import Iterator
    from types import FunctionType

    from st_types import Struct
    from st_types.types.elementary import DataType

_OTHER_SCOPES = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda, ast.ClassDef)

_DECLARED_AS = {bool: "BOOL", int: "DINT", float: "REAL", str: "STRING(80)"}


def check_methods(view: type[Struct], base: type[Struct]) -> None:
    """Check the methods of a class.

    Args:
        view: a program or a function block.
        base: whose own methods are right, as those of its bases.

    Raises:
        ConfigurationError: a method uses a name of ``self`` that is not there, gives a value to one
            that is no variable, or one that its variable cannot take; all findings are told, with
            file and line.
    """
    findings = Findings()
    for function in own_methods(view, base):
        for line, text in _Method(view, function).findings():
            location = f"{function.__code__.co_filename}:{line}"
            findings.add(ConfigurationError(f"{location}: {text}"))
    findings.check()


def own_methods(view: type[Struct], base: type[Struct]) -> Iterator[FunctionType]:
    """Iterate over the methods that a class and its bases below ``base`` define."""
    for each in view.__mro__[: view.__mro__.index(base)]:
        for value in vars(each).values():
            if inspect.isfunction(value) and inspect.isfunction(method := inspect.unwrap(value)):
                yield method


class _Method:
    """One method and what is wrong in it."""

    def __init__(self, view: type[Struct], function: FunctionType) -> None:
        self._view = view
        self._function = function
        self._is_open = hasattr(view, "__getattr__") or bool(view.__dictoffset__)

    def findings(self) -> Iterator[tuple[int, str]]:
        """Iterate over lines and what is wrong there."""
        try:
            lines, first = inspect.getsourcelines(self._function)
            (tree,) = ast.parse(textwrap.dedent("".join(lines))).body
        except (OSError, SyntaxError, ValueError):  # made by other means than a file
            return
        if not isinstance(tree, ast.FunctionDef) or not tree.args.args:
            return
        name = tree.args.args[0].arg
        values = ValueCheck(self._view, name, self._function.__globals__)
        for node in _own_nodes(tree):
            line = first + getattr(node, "lineno", 1) - 1
            for text in (*self._names(node, name, values), *values.findings(node)):
                yield line, text

    def _names(self, node: ast.AST, name: str, values: ValueCheck) -> Iterator[str]:
        """Look at the names in one node."""
        match node:
            case ast.Attribute(value=ast.Name(id=own)) if own == name:
                yield from self._attribute(node)
            case ast.Attribute(value=inner, attr=attribute):
                yield from _member(values.type_of(inner), attribute)
            case ast.Call():
                yield from _inputs(node, values)

    def _attribute(self, node: ast.Attribute) -> Iterator[str]:
        """Look at ``self.name``."""
        name, view = node.attr, self._view
        if name.startswith("__") or self._is_open:
            return
        if not hasattr(view, name):
            yield f"{view.__name__} has no {name}{did_you_mean(name, dir(view))}"
        elif isinstance(node.ctx, ast.Store):
            yield from _not_assigned(name, inspect.getattr_static(view, name))


def _not_assigned(name: str, value: object) -> Iterator[str]:
    """Tell why an attribute of a class takes no value."""
    if isinstance(value, ConstantAttribute):
        yield f"{name} is CONSTANT"
        return
    if hasattr(type(value), "__set__"):
        return
    if callable(value):
        yield f"{name} is a method and takes no value"
        return
    declared = _DECLARED_AS.get(type(value), "...")
    yield f"{name} is no variable; declare it: {name} = var({declared})"


def _member(data_type: DataType[Any] | None, name: str) -> Iterator[str]:
    """Look at a member of a STRUCT or a function block, ``self.timer.Q``."""
    if isinstance(data_type, StructType) and not hasattr(view_class(data_type), name):
        yield f"{data_type.name} has no {name}{did_you_mean(name, _from_outside(data_type))}"


def _from_outside(data_type: StructType[Any]) -> list[str]:
    """Return the names of the members that are meant for others."""
    is_block = isinstance(data_type, DataBlockType)
    return [m.name for m in data_type.members if not is_block or m.section is not Section.INTERNAL]


def _inputs(node: ast.Call, values: ValueCheck) -> Iterator[str]:
    """Look at the names in the call of a function block, ``self.timer(IN=True)``."""
    block = values.type_of(node.func)
    if not isinstance(block, DataBlockType):
        return
    if getattr(block.view, "__call__", None) is not FunctionBlock.__call__:  # noqa: B004  # which one it is
        return
    if node.args:
        first = next(iter(_from_outside(block)), "NAME")
        yield f"{block.name} takes its inputs by name, {first}=..."
    known = [member.name for member in block.members]
    for keyword in node.keywords:
        if keyword.arg is not None and keyword.arg not in known:
            hint = did_you_mean(keyword.arg, _from_outside(block))
            yield f"{block.name} has no {keyword.arg}{hint}"


def _own_nodes(tree: ast.AST) -> Iterator[ast.AST]:
    """Iterate over the nodes of a function in the order of the source, without functions in it."""
    for node in ast.iter_child_nodes(tree):
        if not isinstance(node, _OTHER_SCOPES):
            yield node
            yield from _own_nodes(node)
