"""Objects in the modules of a project that programs may take for variables.

They are Python's: no tags, and a restart of the controller leaves them as they are. Only instances
of the project's own classes are told of: tables in lists and dicts are usual, and stay as they are.
"""

from __future__ import annotations

import ast
import dataclasses
import sys
from enum import Enum
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator


def kept_objects(package: str) -> list[str]:
    """Return a warning, with file and line, for each object that can change.

    Args:
        package: of the project, whose modules are imported.
    """
    return [
        f"{file}:{line}: warning: {name} is an object of Python's: it is no tag, and a restart "
        "leaves it as it is; what programs share is a global variable"
        for file, names in _modules(package)
        for name, line in _assigned(file)
        if name in names
    ]


def _modules(package: str) -> Iterator[tuple[Path, set[str]]]:
    """Iterate over the files of modules, each with the names of such objects in it."""
    inside = f"{package}."
    for name, module in sorted(sys.modules.items()):
        file = getattr(module, "__file__", None)
        if name.startswith(inside) and file:
            found = {key for key, value in vars(module).items() if _can_change(value, inside)}
            if found:
                yield Path(file), found


def _can_change(value: object, inside: str) -> bool:
    kind = type(value)
    if not kind.__module__.startswith(inside) or isinstance(value, Enum | tuple | type):
        return False
    parameters = getattr(kind, "__dataclass_params__", None)
    return not (dataclasses.is_dataclass(kind) and parameters is not None and parameters.frozen)


def _assigned(file: Path) -> Iterator[tuple[str, int]]:
    """Iterate over the names that a module assigns at its outermost level, with their lines."""
    for statement in ast.parse(file.read_bytes()).body:
        targets: list[ast.expr] = []
        if isinstance(statement, ast.AnnAssign):
            targets = [statement.target]
        elif isinstance(statement, ast.Assign):
            targets = statement.targets
        for target in targets:
            if isinstance(target, ast.Name):
                yield target.id, statement.lineno
