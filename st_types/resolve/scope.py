"""Scopes: what a name means at a place.

A scope holds the declarations of one place, such as a library, the project, a package, a program or
a function block, and knows the scopes around it. A name means the declaration of this very scope,
else that of the next one in order: what is local hides what is global. So two programs may each
have a type ``Parameters``. In Automation Studio the order is: a program, the private packages
around it from the inside out, the project (the files of all other packages together), libraries.

Everything is resolved when it is first asked for, and kept: types are compared by identity, so a
scope is made once and shared. What cannot be is an error in the ``diagnostics`` of its file, at its
exact place; `Scope.check` finds all errors. A name that nothing declares is a warning, for it may
come from a library that is not here, or with ``strict`` an error; types that need it have no layout
then.
"""

from __future__ import annotations

import hashlib
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, cast

from st_types.resolve.constant_lookup import ConstantLookup
from st_types.resolve.constants import evaluate
from st_types.resolve.declared import (
    DeclaredFunction,
    DeclaredFunctionBlock,
    DeclaredType,
    DeclaredVariable,
)
from st_types.resolve.dialect import AUTOMATION_STUDIO
from st_types.resolve.file_resolver import FileResolver
from st_types.resolve.index import DONE, IndexEntry, PouEntry, ScopeIndex, TypeEntry, VariableEntry
from st_types.syntax.collector import collector_paused

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from st_types.resolve.dialect import Dialect
    from st_types.resolve.index import NameSpace
    from st_types.syntax.expressions import Expression
    from st_types.syntax.literals import Constant
    from st_types.syntax.tree import (
        DeclarationFile,
        FunctionBlockDeclaration,
        FunctionDeclaration,
    )
    from st_types.types.derived import DataBlockType
    from st_types.types.elementary import DataType


class Hit(NamedTuple):
    """A declaration that was found, and how its name is spelled there."""

    name: str
    entry: IndexEntry


class Scope:
    """The declarations of one place, and where to look next.

    Args:
        name: of the library, the project, the package, the program.
        files: its parsed files; findings go to their ``diagnostics``.
        outer: the scopes around it, the nearest first. It is read at the first lookup: scopes that
            see one another, as libraries do, may share one list that grows meanwhile.
        dialect: the rules of the files.
        strict: a name that nothing declares is an error, not a warning.
    """

    def __init__(
        self,
        name: str,
        files: Sequence[DeclarationFile],
        outer: Sequence[Scope] = (),
        *,
        dialect: Dialect = AUTOMATION_STUDIO,
        strict: bool = False,
    ) -> None:
        self.name = name
        self.files = tuple(files)
        self.outer = outer
        self.dialect = dialect
        self.strict = strict
        self._index: ScopeIndex | None = None

    @cached_property
    def resolvers(self) -> tuple[FileResolver, ...]:
        """What resolves each of the files."""
        return tuple(FileResolver(self, file) for file in self.files)

    @property
    def index(self) -> ScopeIndex:
        """The declarations of this very scope by name."""
        if self._index is None:
            self._index = ScopeIndex(self.resolvers)
        return self._index

    @cached_property
    def chain(self) -> tuple[Scope, ...]:
        """This scope and all around it, each once, in the order in which names are looked up."""
        found: dict[Scope, None] = {}
        waiting = [self]
        last: Sequence[Scope] = ()
        while waiting:
            scope = waiting.pop()
            if scope not in found:
                found[scope] = None
                if scope.outer and scope.outer is not last:  # what is left of the last waits next
                    waiting += reversed(scope.outer)
                    last = scope.outer
        return tuple(found)

    @cached_property
    def identity(self) -> bytes:
        """A hash of its name, and of the paths and texts of its files."""
        state = hashlib.blake2b(digest_size=16)
        sources = [file.tokens.source for file in self.files]
        for text in (self.name, *(part for one in sources for part in (one.path, one.text))):
            data = text.encode("utf-8", "surrogatepass")
            state.update(f"{len(data)} ".encode() + data)
        return state.digest()

    @cached_property
    def _names(self) -> ConstantLookup:
        return ConstantLookup(self)

    def inner(self, name: str, file: DeclarationFile, known: dict[str, IndexEntry | None]) -> Scope:
        """Return the scope of a function (block), ``file`` being its VAR blocks only.

        Args:
            name: of the function.
            file: the file it stands in, with no other items.
            known: types by the names that the file uses.
        """
        scope = Scope(name, (file,), (self,), dialect=self.dialect, strict=self.strict)
        scope.resolvers = (FileResolver(scope, file, known),)
        return scope

    # Lookup

    def lookup(self, space: NameSpace, name: str) -> Hit | None:
        """Return the declaration that ``name`` means here, None if there is none.

        In a case-sensitive dialect a name that is declared nowhere means the one that differs from
        it in case, if there is only one.
        """
        if not self.dialect.case_sensitive:
            return next(self._near(space, name), None)
        entry = self.exact(space, name)
        if entry is not None:
            return Hit(name, entry)
        near = {hit.name: hit for hit in reversed(list(self._near(space, name)))}
        return near.popitem()[1] if len(near) == 1 else None

    def exact(self, space: NameSpace, name: str) -> IndexEntry | None:
        """Return the declaration that is spelled exactly like this, None if there is none."""
        entry = self.index.names(space).get(name)
        if entry is not None or not self.outer:
            return entry
        if self._has_one_around:
            return self.outer[0].exact(space, name)
        around = self._around.setdefault(space, {})
        if name not in around:
            found = (scope.index.names(space).get(name) for scope in self.chain[1:])
            around[name] = next((entry for entry in found if entry is not None), None)
        return around[name]

    @cached_property
    def _has_one_around(self) -> bool:
        """Whether one scope knows all that is around this one: it sees it, and is not seen."""
        return len(self.outer) == 1 and self not in self.outer[0].chain

    @cached_property
    def _around(self) -> dict[NameSpace, dict[str, IndexEntry | None]]:
        """What names mean that were looked up in several scopes around this one."""
        return {}

    def _near(self, space: NameSpace, name: str) -> Iterator[Hit]:
        for scope in self.chain:
            for declared in scope.index.spellings(space).near(name):
                yield Hit(declared, scope.index.names(space)[declared])

    def hint(self, space: NameSpace, name: str) -> str:
        """Return a hint for a name that is not found: names that differ in case, else empty."""
        near = list(dict.fromkeys(hit.name for hit in self._near(space, name)))
        return f"declared are {' and '.join(near)}" if near else ""

    def spelling(self, name: str) -> str | None:
        """Return how the type, function or variable is declared that ``name`` means here.

        It differs from ``name`` where that is written in another case: worth a warning if the
        dialect is case-sensitive. None if there is no such declaration.
        """
        hit = self._any(name)
        return hit.name if hit is not None else None

    def owner_of(self, name: str) -> Scope | None:
        """Return the scope that declares the type, function or variable ``name``, None if none."""
        hit = self._any(name)
        return hit.entry.resolver.scope if hit is not None else None

    def _any(self, name: str) -> Hit | None:
        spaces: tuple[NameSpace, ...] = ("types", "functions", "variables")
        hits = [hit for space in spaces if (hit := self.lookup(space, name)) is not None]
        return next((hit for hit in hits if hit.name == name), hits[0] if hits else None)

    def find_type(self, name: str) -> DataType[object] | None:
        """Return the type or the data block of the function block ``name``.

        None if there is none, or if it has no layout.
        """
        simple = self.dialect.simple_types.get(name.upper())
        if simple is not None:
            return simple
        hit = self.lookup("types", name)
        return None if hit is None else _resolved(hit.entry).data_type

    def find_function_block(self, name: str) -> DeclaredFunctionBlock | None:
        """Return the function block ``name``, None if there is none."""
        hit = self.lookup("types", name)
        if hit is None or not isinstance(hit.entry, PouEntry):
            return None
        return _function_block(hit.entry)

    def find_function(self, name: str) -> DeclaredFunction | None:
        """Return the function ``name``, None if there is none."""
        hit = self.lookup("functions", name)
        return _function(hit.entry) if hit is not None and isinstance(hit.entry, PouEntry) else None

    def find_variable(self, name: str) -> DeclaredVariable | None:
        """Return the variable or the constant ``name``, None if there is none."""
        hit = self.lookup("variables", name)
        if hit is None or not isinstance(hit.entry, VariableEntry):
            return None
        return _variable(hit.entry)

    def constant(self, name: str) -> Constant | None:
        """Return the value of a VAR CONSTANT or of an enumeration, None if there is none.

        Args:
            name: a value of an enumeration may be qualified: ``Colour.red``, ``Colour#red``.

        Raises:
            UnknownValueError: it has no value that is known before the run.
        """
        return self._names.constant(name.replace("#", "."), 0)

    def evaluate(self, expression: Expression) -> Constant:
        """Return the value of a constant expression.

        Raises:
            EvaluationError: it is not constant, a name is unknown, or the value is out of range.
        """
        names = self._names
        names.level = 0
        return evaluate(expression, names)

    # What this very scope declares

    @cached_property
    def types(self) -> tuple[DeclaredType, ...]:
        """The types of TYPE blocks, in order."""
        return tuple(
            DeclaredType(entry.name, _resolved(entry).data_type, entry.node, entry.resolver.file)
            for entry in self.index.types
            if isinstance(entry, TypeEntry)
        )

    @cached_property
    def function_blocks(self) -> tuple[DeclaredFunctionBlock, ...]:
        """The function blocks, in order."""
        return tuple(
            _function_block(entry) for entry in self.index.types if isinstance(entry, PouEntry)
        )

    @cached_property
    def functions(self) -> tuple[DeclaredFunction, ...]:
        """The functions, in order."""
        return tuple(map(_function, self.index.functions))

    @cached_property
    def variables(self) -> tuple[DeclaredVariable, ...]:
        """The variables and constants of the VAR blocks that stand in no function, in order."""
        return tuple(map(_variable, self.index.variables))

    def data_types(self) -> Iterator[DataType[object]]:
        """Yield types and data blocks that have a layout, in the order of declaration."""
        for entry in self.index.types:
            data_type = _resolved(entry).data_type
            if data_type is not None:
                yield data_type

    def check(self) -> None:
        """Resolve everything that is declared here, so that all findings are recorded."""
        with collector_paused():
            self.index.report_duplicates(self.dialect)
            self._resolve_all()

    def _resolve_all(self) -> None:
        index = self.index
        for variable in index.variables:
            if variable.is_constant:
                variable.resolver.complete(variable)
        for entry in (*index.types, *index.functions):
            entry.resolver.resolved(entry)
        for variable in index.variables:
            if variable.state != DONE:
                variable.resolver.complete(variable)
        for entry in (*index.types, *index.functions):
            if isinstance(entry, PouEntry) and entry.scope is not None:
                entry.scope._resolve_all()
        for resolver in self.resolvers:
            resolver.resolve_references()


def _resolved(entry: IndexEntry) -> IndexEntry:
    return entry.resolver.resolved(entry)


def _variable(entry: VariableEntry) -> DeclaredVariable:
    if entry.made is None:
        node, file = entry.node, entry.resolver.file
        entry.resolver.complete(entry)
        entry.made = DeclaredVariable(
            node.name, entry.data_type, entry.value, entry.block, node, file
        )
    return entry.made


def _function(entry: PouEntry) -> DeclaredFunction:
    if entry.made is None:
        _resolved(entry)
        node = cast("FunctionDeclaration", entry.node)
        scope = cast("Scope", entry.scope)
        entry.made = DeclaredFunction(node.name, entry.data_type, scope, node, entry.resolver.file)
    return cast("DeclaredFunction", entry.made)


def _function_block(entry: PouEntry) -> DeclaredFunctionBlock:
    if entry.made is None:
        _resolved(entry)
        node = cast("FunctionBlockDeclaration", entry.node)
        scope = cast("Scope", entry.scope)
        data_type = cast("DataBlockType[object] | None", entry.data_type)
        entry.made = DeclaredFunctionBlock(node.name, data_type, scope, node, entry.resolver.file)
    return cast("DeclaredFunctionBlock", entry.made)
