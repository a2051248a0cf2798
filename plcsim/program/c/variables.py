"""What a program in C and its project declare in .typ and .var files."""

from __future__ import annotations

from typing import TYPE_CHECKING

from plcsim.core.errors import ConfigurationError
from st_types.errors import Severity
from st_types.resolve.scope import Scope
from st_types.syntax.declarations import parse_declarations
from st_types.syntax.source import Source
from st_types.types.derived import Member, StructType

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

_SUFFIXES = (".fun", ".typ", ".var")


def scope_of(name: str, folder: Path, outer: Sequence[Scope] = (), *, strict: bool = True) -> Scope:
    """Return what the declaration files in a folder declare.

    Raises:
        ConfigurationError: there are errors in them; all are told.
    """
    found = sorted(file for file in folder.iterdir() if file.suffix.lower() in _SUFFIXES)
    files = [parse_declarations(Source.read(file)) for file in found]
    scope = Scope(name, files, outer, strict=strict)
    scope.check()
    findings = [
        str(d) for f in files for d in f.diagnostics.records if d.severity is Severity.ERROR
    ]
    if findings:
        raise ConfigurationError(*findings)
    return scope


def variables_of(scope: Scope, name: str) -> StructType[object]:
    """Return the variables of a scope as one STRUCT."""
    members = [
        Member(v.name, v.data_type, v.initial)
        for v in scope.variables
        if v.data_type is not None and not v.is_constant
    ]
    return StructType(name, members)
