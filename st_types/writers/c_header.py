"""The C header of declarations, in the shape Automation Studio generates it.

Constants, then types in the order in which C needs them, then prototypes. STRUCTs keep their order,
data blocks have that of their layout, with the section of each group in a comment. The header needs
``bur/plctypes.h``: Automation Studio's own, or on a host the one in ``st_types/include``.

Names that C does not allow get an underscore at their end, and so do names that are taken already.
An ARRAY whose lower bound is not 0 starts at index 0 in C, as a comment beside it says; Automation
Studio leaves out types with such arrays.
"""

from __future__ import annotations

import math
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
    WStringType,
    is_digital,
    resolve_alias,
)
from st_types.types.elementary import DataType, ElementaryType

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from st_types.resolve.declared import Function, Variable
    from st_types.resolve.scope import Scope

C_TYPES = {
    "BOOL": "plcbit",
    "SINT": "signed char",
    "INT": "signed short",
    "DINT": "signed long",
    "LINT": "signed long long",
    "USINT": "unsigned char",
    "UINT": "unsigned short",
    "UDINT": "unsigned long",
    "ULINT": "unsigned long long",
    "BYTE": "plcbyte",
    "WORD": "plcword",
    "DWORD": "plcdword",
    "LWORD": "plclword",
    "REAL": "float",
    "LREAL": "double",
    "TIME": "plctime",
    "DATE": "plcdate",
    "TIME_OF_DAY": "plctod",
    "DATE_AND_TIME": "plcdt",
}
"""C type of each elementary type."""

C_KEYWORDS = frozenset(
    [
        *("auto", "break", "case", "char", "const", "continue", "default", "do", "double"),
        *("else", "enum", "extern", "float", "for", "goto", "if", "inline", "int", "long"),
        *("register", "restrict", "return", "short", "signed", "sizeof", "static", "struct"),
        *("switch", "typedef", "union", "unsigned", "void", "volatile", "while", "asm"),
        *("typeof", "bool", "class", "delete", "friend", "new", "operator", "private"),
        *("protected", "public", "template", "this", "throw", "true", "false", "try"),
        *("catch", "virtual", "using", "namespace", "linux", "unix", "i386"),
    ]
)
"""Words of C and C++, and macros of gcc, that cannot be names."""

_SECTIONS = {
    Section.INPUT: "VAR_INPUT",
    Section.OUTPUT: "VAR_OUTPUT",
    Section.IN_OUT: "VAR_IN_OUT",
    Section.INTERNAL: "VAR",
}


def c_header(
    scope: Scope,
    name: str,
    *,
    c_types: Mapping[str, str] = C_TYPES,
    variables: str = "",
    known: Sequence[Scope] = (),
) -> str:
    """Return the header of all types, constants and functions of ``scope``.

    Args:
        scope: the declarations; what has no layout is left out.
        name: of the library or program, for the guard.
        c_types: C type of each elementary type.
        variables: what stands before each variable that is no constant, such as ``_GLOBAL``; with
            "" there are none.
        known: scopes whose types have headers of their own, included before this one.
    """
    guard = f"_{''.join(c if c.isalnum() else '_' for c in name).upper()}_H_"
    head = f"/* {name}: written by plcsim types header */\n\n#ifndef {guard}\n#define {guard}\n"
    head += '\n#include <bur/plctypes.h>\n\n#ifdef __cplusplus\nextern "C" {\n#endif\n'
    tail = f"\n#ifdef __cplusplus\n}}\n#endif\n\n#endif /* {guard} */\n"
    header = Header(scope, c_types, known)
    lines = [*header.lines(), *(header.variables(variables) if variables else ())]
    return head + "".join(line + "\n" for line in lines) + tail


class Header:
    """Writes C declarations.

    Attributes:
        names: typedef name of each type that is written.
    """

    def __init__(
        self,
        scope: Scope,
        c_types: Mapping[str, str] = C_TYPES,
        known: Sequence[Scope] = (),
    ) -> None:
        self._scope = scope
        self._c_types = c_types
        self._taken: set[str] = set(C_KEYWORDS)
        self.names: dict[DataType[object], str] = {}
        self._tags: dict[DataType[object], str] = {}
        self._written: set[DataType[object]] = set()
        self._complete: set[DataType[object]] = set()
        for data_type in (t for other in known for t in other.data_types()):
            self._name(data_type)
            self._written.add(data_type)
            self._complete.add(data_type)

    def lines(self) -> Iterator[str]:
        """Yield the lines between the head and the tail of the header."""
        types = list(self._scope.data_types())
        for data_type in types:
            self._name(data_type)
        constants = list(self._constants())
        yield from constants
        for data_type in types:
            yield from self._type(data_type)
        yield from self._prototypes(types)

    def variables(self, storage: str) -> Iterator[str]:
        """Yield the declarations of the variables that are no constants."""
        found = [v for v in self._scope.variables if not v.is_constant and v.data_type]
        if found:
            yield from ("", "/* Variables */")
        for variable in found:
            assert variable.data_type is not None
            yield f"{storage} {self._declarator(variable.data_type, self._free(variable.name))};"

    def _name(self, data_type: DataType[object]) -> str:
        if data_type not in self.names:
            is_block = isinstance(data_type, DataBlockType)
            tag = self._free(data_type.name)
            self._tags[data_type] = tag
            self.names[data_type] = self._free(tag + "_typ") if is_block else tag
        return self.names[data_type]

    def _free(self, name: str) -> str:
        while name in self._taken:
            name += "_"
        self._taken.add(name)
        return name

    def _constants(self) -> Iterator[str]:
        found = [v for v in self._scope.variables if v.is_constant]
        named = [(self._free(v.name), v) for v in found if _value(v) and v.data_type]
        if not named:
            return
        yield from ("", "/* Constants */", "#ifdef _REPLACE_CONST")
        yield from (f"#define {name} {_value(variable)}" for name, variable in named)
        yield "#else"
        for name, variable in named:
            if variable.data_type is not None:
                yield f"_GLOBAL_CONST {self._declarator(variable.data_type, name)};"
        yield "#endif"

    def _type(self, data_type: DataType[object]) -> Iterator[str]:
        """Yield the declaration of a named type, after those of the types that lie in it."""
        if data_type in self._written:
            return
        self._written.add(data_type)
        match data_type:
            case StructType():
                for member in data_type.members:
                    yield from self._needed(member.data_type)
                yield from self._struct(data_type)
                self._complete.add(data_type)
            case EnumerationType():
                yield from self._enumeration(data_type)
            case AliasType(target=target):
                yield from self._needed(target)
                yield from ("", f"typedef {self._declarator(target, self._name(data_type))};")
            case SubrangeType(base=base):
                yield from ("", f"typedef {self._declarator(base, self._name(data_type))};")

    def _needed(self, data_type: DataType[object]) -> Iterator[str]:
        """Yield what C has to know of a type before a member of it."""
        match data_type:
            case ArrayType(element=element):
                yield from self._needed(element)
            case ReferenceType(target=DataType() as target):
                inner = resolve_alias(target)
                if not isinstance(inner, StructType):
                    yield from self._needed(inner)
            case StructType() | EnumerationType() | AliasType():
                yield from self._type(data_type)
            case SubrangeType() if data_type in self.names:
                yield from self._type(data_type)

    def _enumeration(self, data_type: EnumerationType[object]) -> Iterator[str]:
        name = self._name(data_type)
        yield from ("", f"typedef enum {self._tags[data_type]} {{")
        for value_name, value in data_type.values.items():
            yield f"\t{self._free(value_name)} = {_integer(value)},"
        yield f"}} {name};"

    def _struct(self, data_type: StructType[object]) -> Iterator[str]:
        name = self._name(data_type)
        yield from ("", f"typedef struct {self._tags[data_type]} {{")
        taken = set(C_KEYWORDS)
        group = ""
        for _, member in sorted(
            zip(data_type.offsets, data_type.members, strict=True), key=_offset
        ):
            if isinstance(data_type, DataBlockType) and group != _group(member):
                group = _group(member)
                yield f"\t/* {group} */"
            member_name = member.name
            while member_name in taken:
                member_name += "_"
            taken.add(member_name)
            yield f"\t{self._declarator(member.data_type, member_name)};{_lower_bounds(member)}"
        if not data_type.members:
            yield "\tplcbit empty; /* a STRUCT without members takes one byte */"
        yield f"}} {name};"

    def _declarator(self, data_type: DataType[object], name: str) -> str:
        """Return the C declaration of ``name`` without its semicolon."""
        match data_type:
            case ElementaryType():
                return f"{self._c_types[data_type.name]} {name}"
            case StringType(length=length):
                return f"plcstring {name}[{length + 1}]"
            case WStringType(length=length):
                return f"plcwstring {name}[{length + 1}]"
            case ArrayType(element=element, bounds=bounds):
                lengths = "".join(f"[{high - low + 1}]" for low, high in bounds)
                return self._declarator(element, name + lengths)
            case SubrangeType(base=base) if data_type not in self.names:
                return self._declarator(base, name)
            case ReferenceType(target=target):
                return self._pointer(target, name)
            case AliasType() | SubrangeType():
                return f"{self._name(data_type)} {name}"
        keyword = "enum" if isinstance(data_type, EnumerationType) else "struct"
        self._name(data_type)
        return f"{keyword} {self._tags[data_type]} {name}"

    def _pointer(self, target: DataType[object] | None, name: str) -> str:
        match resolve_alias(target) if target is not None else None:
            case None:
                return f"void* {name}"
            case StringType():
                return f"plcstring* {name}"
            case WStringType():
                return f"plcwstring* {name}"
            case ArrayType() as array:
                inner = _innermost(array)
                if isinstance(inner, StructType) and inner not in self._complete:
                    return self._declarator(inner, f"*{name}")  # C wants complete elements
                return self._declarator(array, f"(*{name})")
            case other:
                return self._declarator(other, f"*{name}")

    def _prototypes(self, types: Sequence[DataType[object]]) -> Iterator[str]:
        blocks = [data_type for data_type in types if isinstance(data_type, DataBlockType)]
        functions = self._scope.functions
        if blocks or functions:
            yield from ("", "/* Prototypes */")
        for block in blocks:
            yield f"_BUR_PUBLIC void {self._tags[block]}(struct {self._tags[block]}* inst);"
        for function in functions:
            parameters = ", ".join(self._parameter(v) for v in _parameters(function)) or "void"
            name = self._free(function.name)
            yield f"_BUR_PUBLIC {self._result(function, f'{name}({parameters})')};"

    def _parameter(self, variable: Variable) -> str:
        data_type = variable.data_type
        name = variable.name + "_" if variable.name in C_KEYWORDS else variable.name
        if data_type is None:
            return f"unsigned long {name}"
        is_scalar = isinstance(resolve_alias(data_type), _SCALARS)
        if is_scalar and variable.block.section == "VAR_INPUT":
            return self._declarator(data_type, name)
        return self._pointer(data_type, name)

    def _result(self, function: Function, call: str) -> str:
        result = resolve_alias(function.result) if function.result is not None else None
        if result is None:
            return f"void {call}"
        return self._declarator(result, call) if isinstance(result, _SCALARS) else f"void* {call}"


_SCALARS = (ElementaryType, EnumerationType, SubrangeType, ReferenceType)


def _innermost(data_type: DataType[object]) -> DataType[object]:
    while isinstance(data_type, ArrayType):
        data_type = resolve_alias(data_type.element)
    return data_type


def _offset(pair: tuple[int, Member]) -> int:
    return pair[0]


def _group(member: Member) -> str:
    kind = "digital" if is_digital(member.data_type) else "analog"
    if member.section is Section.IN_OUT:
        kind = "analog and digital"  # references to either kind
    return f"{_SECTIONS[member.section]} ({kind})"


def _lower_bounds(member: Member) -> str:
    if not isinstance(member.data_type, ArrayType):
        return ""
    lows = [low for low, _ in member.data_type.bounds]
    return (
        f" /* index 0 here is {', '.join(map(str, lows))} in {member.name} */" if any(lows) else ""
    )


def _parameters(function: Function) -> list[Variable]:
    return [v for v in function.variables if v.block.section in ("VAR_INPUT", "VAR_IN_OUT")]


def _value(variable: Variable) -> str:
    """Return the value of a constant in C, empty where it has no simple one."""
    match variable.initial:
        case bool(value):
            return str(int(value))
        case int(value):
            return _integer(value)
        case float(value) if math.isfinite(value):
            return repr(value)
        case str(value):
            return _text(value)
    return ""


def _integer(value: int) -> str:
    if value in (-(2**31), -(2**63)):
        return f"({_integer(value + 1)} - 1)"
    suffix = "" if value < 2**31 else "U" if value < 2**32 else "LL" if value < 2**63 else "ULL"
    return f"{value}{suffix}" if value > -(2**31) else f"{value}LL"


def _text(value: str) -> str:
    data = value.encode("latin-1", "replace")
    return '"' + "".join(_character(byte) for byte in data) + '"'


def _character(byte: int) -> str:
    plain = 32 <= byte < 127 and chr(byte) not in '"\\?'
    return chr(byte) if plain else f"\\{byte:03o}"
