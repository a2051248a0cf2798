"""A Python module of typed views from the declarations of a scope, for programs, editors and mypy.

Each STRUCT becomes a `Struct` class, each function block's data a `DataBlock` class, an enumeration
an IntEnum, a constant a module constant, the variables of VAR blocks a class ``Variables``. A
function block that something executes is that class, imported. What other scopes declare comes from
their modules. Apart from those the module imports only `st_types`, and it passes ``mypy --strict``.
"""

from __future__ import annotations

import keyword
import re
import textwrap
from enum import IntEnum
from typing import TYPE_CHECKING

from st_types.types.derived import (
    AliasType,
    ArrayType,
    DataBlockType,
    EnumerationType,
    Member,
    ReferenceType,
    Section,
    StringType,
    StructType,
    SubrangeType,
    UnionType,
    WStringType,
    resolve_alias,
)
from st_types.types.elementary import DINT, ELEMENTARY, DataType, ElementaryType
from st_types.types.values import decode, initial_image

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from st_types.resolve.declared import DeclaredVariable
    from st_types.resolve.scope import Scope

_MAKERS = {
    Section.INPUT: "var_input",
    Section.OUTPUT: "var_output",
    Section.IN_OUT: "var_in_out",
    Section.INTERNAL: "var",
}
_BASES: dict[type, str] = {DataBlockType: "DataBlock", UnionType: "Union"}
"""Base classes of views, where it is not Struct."""

_IMPORTED = frozenset(
    [
        *("ARRAY", "ENUM", "STRING", "WSTRING", "DataBlock", "Struct", "Union", *_MAKERS.values()),
        *("AliasType", "EnumerationType", "ReferenceType", "SubrangeType", *ELEMENTARY),
        *("Final", "IntEnum", "locals"),
    ]
)
"""Names that the module itself uses; a declaration of such a name gets another one."""

_RESERVED = frozenset([*dir(IntEnum), *keyword.kwlist, "name", "value", "mro"])
"""Names that an IntEnum cannot give to its members."""


_STANDARD_MODULES = frozenset(["enum", "typing"])

MAX_CONSTANT = 0x1_0000
"""Bytes of a constant without a value that is written out."""

_QUOTED = "'[^']*'"


def python_source(module: PythonModule, title: str) -> str:
    """Return the text of a module.

    Args:
        module: what it declares; what has no layout is left out.
        title: first line of the module's docstring.
    """
    body = "".join(f"\n\n{block}\n" for block in module.blocks())
    head = f'"""{_one_line(title)}"""\n\nfrom __future__ import annotations\n'
    return head + _imports(module.imports) + body


def _imports(used: set[tuple[str, str]]) -> str:
    """Return the import statements: the standard library's, others, the modules beside."""
    groups = {"": "", "_": "", ".": ""}
    for module in sorted({module for module, _ in used}):
        names = sorted(name for found, name in used if found == module)
        line = f"from {module} import {', '.join(names)}\n"
        if len(line) > 100:
            line = f"from {module} import (\n" + "".join(f"    {n},\n" for n in names) + ")\n"
        kind = "." if module.startswith(".") else "" if module in _STANDARD_MODULES else "_"
        groups[kind] += line
    return "".join("\n" + text for text in groups.values() if text)


def _one_line(text: str) -> str:
    return " ".join(text.split()).replace("\\", "\\\\").replace('"', "'").rstrip(".") + "."


class PythonModule:
    """Writes the blocks of a module and remembers what they import.

    Args:
        name: of the module.
        scope: the declarations.
        included: the modules of the scopes whose declarations these need.
        executed: where the class lies that executes a function block, as module and name, by the
            block's data type.

    Attributes:
        name: of the module.
        names: Python name of each type that is written here.
        imports: module and name of all that is imported.
    """

    def __init__(
        self,
        name: str,
        scope: Scope,
        included: Sequence[PythonModule] = (),
        executed: Mapping[DataType[object], tuple[str, str]] | None = None,
    ) -> None:
        self.name = name
        self._scope = scope
        self._included = included
        self._executed = executed or {}
        self._taken: set[str] = set(keyword.kwlist) | _IMPORTED
        self.imports: set[tuple[str, str]] = set()
        self._imported: dict[DataType[object], str] = {}
        self.names: dict[DataType[object], str] = {}
        self._constants = {
            v.name: (self._free(v.name), v)
            for v in scope.variables
            if v.is_constant and v.data_type is not None
        }
        self._own = {data_type: self._free(data_type.name) for data_type in scope.data_types()}

    def blocks(self) -> Iterator[str]:
        """Yield constants, then types in the order they need one another, then variables."""
        if lines := [self._constant(*pair) for pair in self._constants.values()]:
            yield "\n".join(lines)
        for data_type in list(self._own):
            yield from self._named(data_type)
        variables = [v for v in self._scope.variables if not v.is_constant]
        members = [Member(v.name, v.data_type, v.initial) for v in variables if v.data_type]
        for member in members:
            yield from self._needed(member.data_type)
        if members:
            doc = "Variables of the VAR blocks."
            yield self._class(self._free("Variables"), "Struct", doc, members)
        if self._scope.functions:
            names = ", ".join(function.name for function in self._scope.functions)
            yield textwrap.fill(
                f"Functions, which Python cannot call: {names}.",
                width=98,
                initial_indent="# ",
                subsequent_indent="# ",
            )

    def _use(self, name: str, module: str = "st_types") -> str:
        self.imports.add((module, name))
        return name

    def _free(self, name: str) -> str:
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        return name

    def _constant(self, name: str, variable: DeclaredVariable) -> str:
        assert variable.data_type is not None
        value = variable.initial
        if value is None and variable.data_type.size <= MAX_CONSTANT:
            value = decode(variable.data_type, initial_image(variable.data_type))
        return f"{name}: {self._use('Final', 'typing')} = {_literal(value)}"

    def _needed(self, data_type: DataType[object]) -> Iterator[str]:
        """Yield the types that must stand before a member of ``data_type``."""
        match data_type:
            case ArrayType(element=element):
                yield from self._needed(element)
            case StructType() | EnumerationType() | AliasType() | SubrangeType():
                yield from self._named(data_type)

    def _named(self, data_type: DataType[object]) -> Iterator[str]:
        """Yield the declaration of a type, after those that it needs."""
        if data_type in self.names or self._import(data_type):
            return
        match data_type:
            case DataBlockType() if data_type in self._executed:
                self._import_block(data_type)
            case StructType():
                for member in data_type.members:
                    yield from self._needed(member.data_type)
                name = self.names[data_type] = self._name(data_type)
                base = _BASES.get(type(data_type), "Struct")
                yield self._class(name, base, _description(data_type), data_type.members)
            case EnumerationType():
                yield self._enumeration(data_type)
            case AliasType(target=target):
                yield from self._needed(target)
                yield self._alias(data_type)
            case SubrangeType():
                yield self._assignment(data_type, self._subrange(data_type))

    def _name(self, data_type: DataType[object]) -> str:
        """Return the name a type gets here: its own, unless that is taken."""
        return self._own.get(data_type) or self._free(data_type.name)

    def _import(self, data_type: DataType[object]) -> bool:
        """Import a type from the module that declares it; False if there is none."""
        if data_type in self._imported:
            return True
        owner = next((each for each in self._included if data_type in each.names), None)
        if owner is None:
            return False
        name = owner.names[data_type]
        self._imported[data_type] = self._import_as(name, f".{owner.name}")
        return True

    def _import_as(self, name: str, module: str) -> str:
        here = self._free(name)
        self._use(name if here == name else f"{name} as {here}", module)
        return here

    def _import_block(self, data_type: DataType[object]) -> None:
        module, name = self._executed[data_type]
        here = self._name(data_type)
        self._use(f"{name} as {here}", module)  # "as" makes it a name of this module for mypy too
        self.names[data_type] = here

    def _assignment(self, data_type: DataType[object], value: str) -> str:
        name = self.names[data_type] = self._name(data_type)
        return f"{name} = {value}"

    def _enumeration(self, data_type: EnumerationType[object]) -> str:
        is_dint = data_type.base is DINT
        is_reserved = any(key in _RESERVED or key.startswith("_") for key in data_type.values)
        if is_reserved or not is_dint:
            made = self._use("EnumerationType", "st_types.types.derived")
            of = "" if is_dint else f", base={self._use(data_type.base.name)}"
            value = f"{made}[int]({data_type.name!r}, {dict(data_type.values)!r}{of})"
            return self._assignment(data_type, value)
        base = self._use("IntEnum", "enum")
        name = self._name(data_type)
        lines = [f"class {name}({base}):", f'    """Enumeration {data_type.name}."""', ""]
        lines += [f"    {key} = {value}" for key, value in data_type.values.items()]
        type_name = self.names[data_type] = self._free(f"{name}_TYPE")
        return "\n".join([*lines, "", "", f"{type_name} = {self._use('ENUM')}({name})"])

    def _alias(self, data_type: AliasType[object]) -> str:
        target = resolve_alias(data_type)
        if isinstance(target, StructType):
            return self._struct_alias(data_type, target)
        made = self._use("AliasType", "st_types.types.derived")
        initial = f", {_literal(data_type.initial)}" if data_type.initial is not None else ""
        text = f"{made}({data_type.name!r}, {self._type(data_type.target)}{initial})"
        return self._assignment(data_type, text)

    def _struct_alias(self, data_type: AliasType[object], target: StructType[object]) -> str:
        """Return a class of its own: views know no other name of a class."""
        given: dict[str, object] = {}
        link: DataType[object] = data_type
        while isinstance(link, AliasType):
            if isinstance(link.initial, dict):
                given = link.initial | given
            link = link.target
        members = [m._replace(initial=given.get(m.name, m.initial)) for m in target.members]
        name = self.names[data_type] = self._name(data_type)
        base = _BASES.get(type(target), "Struct")
        return self._class(name, base, f"{data_type.name}: as {target.name}.", members)

    def _class(self, name: str, base: str, doc: str, members: Sequence[Member]) -> str:
        types = [f"{self._use(_MAKERS[m.section])}({self._type(m.data_type)}" for m in members]
        used = set(re.findall(r"\w+", re.sub(_QUOTED, "", " ".join(types))))
        lines = []
        for hidden in sorted(used & {member.name for member in members}):
            # In a class body a member hides a type of its name from the members below it.
            alias = self._free(f"_{hidden}")
            lines.append(f"{alias} = {hidden}")
            types = [_renamed(text, hidden, alias) for text in types]
        lines += ["", ""] if lines else []
        lines += [f"class {name}({self._use(base)}):", f'    """{doc}"""']
        lines += [""] if members else []
        pairs = zip(members, types, strict=True)
        return "\n".join([*lines, *(f"    {self._member(*pair)}" for pair in pairs)])

    def _member(self, member: Member, made: str) -> str:
        initial = f", {_literal(member.initial)}" if member.initial is not None else ""
        value = f"{made}{initial})"
        if keyword.iskeyword(member.name) or member.name.startswith("__"):
            return f"locals()[{member.name!r}] = {value}"  # read it with getattr()
        return f"{member.name} = {value}"

    def _type(self, data_type: DataType[object]) -> str:
        """Return a Python expression for a type."""
        known = self.names.get(data_type) or self._imported.get(data_type)
        if known is not None:
            return known
        match data_type:
            case ElementaryType(name=name):
                return self._use(name)
            case StringType(length=length):
                return f"{self._use('STRING')}({length})"
            case WStringType(length=length):
                return f"{self._use('WSTRING')}({length})"
            case ArrayType(element=element, bounds=bounds):
                ranges = ", ".join(f"({low}, {high})" for low, high in bounds)
                return f"{self._use('ARRAY')}({self._type(element)}, {ranges})"
            case SubrangeType():
                return self._subrange(data_type)
            case ReferenceType():
                made = self._use("ReferenceType", "st_types.types.derived")
                return f"{made}(None, {data_type.name!r})"
        raise TypeError(f"{data_type} has no Python form.")

    def _subrange(self, data_type: SubrangeType) -> str:
        made = self._use("SubrangeType", "st_types.types.derived")
        bounds = f"{data_type.minimum}, {data_type.maximum}"
        return f"{made}({data_type.name!r}, {self._use(data_type.base.name)}, {bounds})"


def _description(data_type: StructType[object]) -> str:
    if isinstance(data_type, DataBlockType):
        return f"Data block of {data_type.name}; nothing executes it here: it cannot be called."
    return f"STRUCT {data_type.name}."


def _renamed(text: str, name: str, new_name: str) -> str:
    """Return Python code with another name for ``name``, strings left alone."""
    pattern = rf"({_QUOTED})|\b{name}\b"
    return re.sub(pattern, lambda match: match[1] or new_name, text)


def _literal(value: object) -> str:
    match value:
        case dict():
            return "{" + ", ".join(f"{key!r}: {_literal(v)}" for key, v in value.items()) + "}"
        case [first, _, *_] if all(other == first for other in value):
            return f"[{_literal(first)}] * {len(value)}"
        case list():
            return "[" + ", ".join(map(_literal, value)) + "]"
    return repr(value)
