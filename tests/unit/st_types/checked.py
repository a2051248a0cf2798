"""A scope of some files, everything in it resolved."""

from collections.abc import Sequence

from st_types.resolve.dialect import AUTOMATION_STUDIO, Dialect
from st_types.resolve.scope import Scope
from st_types.syntax.tree import DeclarationFile


def checked(
    files: Sequence[DeclarationFile],
    outer: Sequence[Scope] = (),
    *,
    strict: bool = False,
    dialect: Dialect = AUTOMATION_STUDIO,
) -> Scope:
    scope = Scope("test", files, outer, strict=strict, dialect=dialect)
    scope.check()
    return scope
